#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "saca/lab/recordings/recorded_set.h"

namespace saca::intention_study {

/// A vehicle in the middle of a lane at 20 m/s that after 3 s brakes for 2 s.
/// @param braking  its deceleration then [m/s^2]
inline recordings::RecordedVehicle recorded_vehicle(std::size_t samples, double braking) {
  recordings::RecordedVehicle vehicle{.id = 7, .type = "car", .length = 4.5, .width = 1.8};
  double x = 0.0;
  double speed = 20.0;
  for (std::size_t i = 0; i < samples; ++i) {
    recordings::Sample sample;
    sample.X_WA = {{x, 0.0}, 0.0};
    sample.speed = speed;
    sample.offset = 0.0;
    sample.heading = 0.0;
    sample.lane_width = 3.5;
    sample.curvature = 0.0;
    sample.gap = std::numeric_limits<double>::infinity();
    vehicle.samples.push_back(sample);
    x += 0.1 * speed;
    speed -= i >= 30 && i < 50 ? 0.1 * braking : 0.0;
  }
  return vehicle;
}

inline recordings::RecordedSet recorded_at(const std::string& site,
                                           recordings::RecordedVehicle vehicle) {
  return {.recordings = {{.name = site + ".xml",
                          .site = site,
                          .group = site,
                          .step = 0.1,
                          .vehicles = {std::move(vehicle)}}},
          .skipped = {}};
}

}  // namespace saca::intention_study
