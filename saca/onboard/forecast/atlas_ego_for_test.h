#pragma once

#include "saca/base/world/track.h"
#include "saca/onboard/forecast/atlas_ego.h"

namespace saca::forecast {

/// The same way as poses every 5 ms, for the exact search that other tests hold to brute force.
inline world::Track sampled(const AtlasEgo& ego, double until) {
  world::Track track{.start = ego.scene().time, .step = 0.005, .X_WA = {}};
  for (int k = 0; k * track.step <= until; ++k) {
    track.X_WA.push_back(ego.at(k * track.step).X_WB);
  }
  return track;
}

}  // namespace saca::forecast
