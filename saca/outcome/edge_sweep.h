#pragma once

#include "saca/outcome/atlas_ego.h"
#include "saca/outcome/edge.h"
#include "saca/outcome/meeting.h"

namespace saca::outcome {

/// The ego on a way out of the atlas and one edge of the road: when it is crossed; `gap` is the
/// room to it. Looked at where the atlas has samples.
/// @param of_interest  larger clearances are not told apart [m]
[[nodiscard]] Meeting edge_meeting(const AtlasEgo& ego, Side side, double of_interest) noexcept;

}  // namespace saca::outcome
