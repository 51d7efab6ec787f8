#pragma once

#include "saca/lab/families/family_stage.h"

namespace saca::families {

// Kinds of encounters with one vehicle that crash records ask for (FamilyKind). Each adds it to the
// stage, so that without avoidance it is met when the approach is over.

/// It stands or drives in our lane, slower than we do by 4 m/s at least.
[[nodiscard]] Harmless slower_lead(Stage& stage);

/// It drives beside us and changes into our lane. `beside_ahead_m` is where its centre is ahead of
/// ours when it comes so near that bodies beside each other touch; where that would be ahead of our
/// front or behind our rear it is moved until a tenth of the shorter body overlaps.
[[nodiscard]] Harmless sideswipe(Stage& stage);

/// It comes from `from_deg` (the direction in which it heads: 180 is towards us, 90 from the right,
/// -90 from the left) and turns by `turn_deg` on an arc of `radius_m`. From towards us it turns out
/// of the lane to the left of ours; from a side into ours, or where it then heads towards us, into
/// that lane. When its centre first is in the middle of our lane our front has been there for
/// `late_s`.
[[nodiscard]] Harmless turning(Stage& stage);

}  // namespace saca::families
