#pragma once

#include "saca/base/world/scene.h"
#include "saca/lab/importers/traffic_recording.h"

namespace saca::importers {

/// What a recorded body is taken for.
struct TrafficBody {
  world::ActorKind kind = world::ActorKind::car;
  double mass = 0.0;  ///< [kg]
};

/// Kind from the format's word and the body's size, mass from both: assumptions, the same as for
/// the 100-Car study (hundred_car_words.h). What is called a car or nothing at all is a truck from
/// 7 m on, a van from 5.5 m, a motorcycle below 3 m of length and 1.5 m of width: NGSIM's own files
/// tell the classes apart, CommonRoad's copies call all of them cars. A static obstacle that is no
/// vehicle is an obstacle that weighs as much as a truck.
[[nodiscard]] TrafficBody assumed_traffic_body(const recordings::Obstacle& obstacle);

/// Lower-case letters, digits and `_`: the benchmark's name, the ego's, and the time if not 0.
[[nodiscard]] std::string traffic_name(const recordings::CommonRoad& file,
                                       const TrafficRequest& request);

/// Fills the scenario's texts: name, title, source, licence, driver, notes, car.
void describe(scenario::Scenario& scenario, const recordings::CommonRoad& file,
              const TrafficRequest& request, const TrafficReport& report);

}  // namespace saca::importers
