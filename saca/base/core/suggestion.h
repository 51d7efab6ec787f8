#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace saca {

/// How many letters must be typed otherwise for one word to become the other: letters that are
/// inserted, left out, replaced, or change places with their neighbour. Capitals are as small
/// letters, and `-` is as `_`.
///
/// Optimal string alignment distance (G. Navarro, A guided tour to approximate string matching,
/// 2001, section 2.1). O(length times length).
[[nodiscard]] std::size_t typing_distance(std::string_view a, std::string_view b);

/// The word that was most likely meant: the nearest of `known` that differs from what was typed in
/// at most a third of its letters, at least one; else the only one that goes on where `typed` ends
/// with `_` or `-` ("duration" for "duration_s"), or that differs from it in nothing but its last
/// part, the unit ("speed_kmh" for "speed_mps"). nullopt: none is near, or several are such.
[[nodiscard]] std::optional<std::string> likely_meant(std::string_view typed,
                                                      std::span<const std::string> known);

/// What to say behind "unknown": "did you mean 'duration_s'?", or "want one of a, b, c" where
/// nothing is near.
/// @param known  in the order in which they are listed
[[nodiscard]] std::string suggestion(std::string_view typed, std::span<const std::string> known);

}  // namespace saca
