#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/scenario/scenario.h"

namespace saca::eval {

/// One number of a scenario that is varied, and through which values.
struct Axis {
  std::string what;  ///< e.g. "truck1.distance_m": as it is written in a message or on a picture
  std::string body;  ///< "ego", an actor's name, "" for the road and for a number of the file
  std::string key;
  std::string path;            ///< of a number of the file (config/toml_number.h); else empty
  std::vector<double> values;  ///< in the unit of the key; growing, at least one
};

/// Reads e.g. "truck.distance_m=10:20:0.25": from 10 to 20 in steps of 0.25.
///
/// Bodies and keys that are meant as they are when the policies begin:
///   ego.speed_mps, ego.offset_m      the ego's speed, and its place beside the middle of its lane
///   NAME.distance_m, NAME.offset_m   an actor's centre: along the lane from the ego's centre of
///                                    mass, and to the left of the middle of the ego's lane
///   NAME.speed_mps                   of an actor with a script: its speed along its heading before
///                                    it brakes or accelerates
///   grip                             of the road
/// Any other number of the scenario's file (scenarios/README.md), meant as it stands there:
///   road.left_edge_m, perception.latency_s, ego.start.s_m, ...
///   NAME.KEY, NAME.start.KEY         of an actor: truck1.mass_kg, truck1.start.brake_at_s; `start`
///                                    may be left out
///   LIST.N                           of a list, from 0: actors.0 is the first actor, whatever its
///                                    name; ego.recording.speed_mps.12
/// A name without a number means the only actor of that kind.
/// @return  Error::Code::malformed, naming what was wanted and got
[[nodiscard]] Result<Axis> parse_axis(std::string_view text, const scenario::Scenario& scenario);

/// The actor called so, or the only one of that kind; nullopt: none, or more than one.
[[nodiscard]] std::optional<std::size_t> actor_called(const scenario::Scenario& scenario,
                                                      std::string_view called);

}  // namespace saca::eval
