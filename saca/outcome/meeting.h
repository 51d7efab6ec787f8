#pragma once

#include <optional>

#include "saca/core/vec2.h"

namespace saca::outcome {

/// What comes of the ego on a way out of the atlas and somebody on a track, or an edge of the road.
struct Meeting {
  std::optional<double> contact;  ///< at the mean [s since the scene's time]
  double clearance = 0.0;         ///< smallest distance at the mean; 0 with contact [m]
  double probability = 0.0;       ///< that they touch, its existence apart
  double nearest = 0.0;           ///< when contact is likeliest [s]
  double gap = 0.0;               ///< between them then, negative when they overlap [m]
  Vec2 n_W;                       ///< then, from the ego to the other
};
/// Less than this is no probability.
constexpr double negligible = 1e-4;

}  // namespace saca::outcome
