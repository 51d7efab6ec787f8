#pragma once

#include <optional>

#include "saca/base/core/vec2.h"

namespace saca::forecast {

/// What comes of the ego on a way out of the atlas and somebody on a track, or an edge of the road.
struct ContactForecast {
  std::optional<double> contact;     ///< at the mean [s since the scene's time]
  double clearance = 0.0;            ///< smallest distance at the mean; 0 with contact [m]
  std::optional<double> nearest_at;  ///< when this one is at it; nullopt: it is never so near [s]
  double probability = 0.0;          ///< that they touch, its existence apart
  double touch = 0.0;  ///< when they typically touch, if they do but not at the mean [s]
  Vec2 brought_W;      ///< what brings the other to it then [m]; of an edge 0
};
/// Less than this is no probability.
constexpr double negligible = 1e-4;

}  // namespace saca::forecast
