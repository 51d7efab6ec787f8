#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/eval/decision_point.h"

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

/// The scenario with one number changed so that at `time` it has the value, while everything else
/// is at that instant where it was.
/// (Everybody begins elsewhere for that, within 1 cm; who reacts to others keeps its law.)
/// A number of the file is changed there, and everybody begins where they began.
/// @return  Error::Code::out_of_range when that cannot be: a recorded ego's speed, a value out of
///          range, bodies that would touch at the start
[[nodiscard]] Result<scenario::Scenario> varied(const scenario::Scenario& scenario,
                                                const manoeuvre::Car& car, double time,
                                                const Axis& axis, double value);

/// The number as the scenario has it at `time`; nullopt: the body is not there.
[[nodiscard]] std::optional<double> nominal(const scenario::Scenario& scenario,
                                            const manoeuvre::Car& car, double time,
                                            const Axis& axis);

/// What is best at one place of the map.
struct Cell {
  bool possible = true;  ///< false: bodies would overlap; the rest then means nothing
  manoeuvre::PolicyId best = manoeuvre::PolicyId::no_intervention;
  bool alone = false;    ///< it does less harm than every other
  double margin = 0.0;   ///< harm of the second best above that of the best, >= 0
  bool contact = false;  ///< even the best
  std::array<std::optional<double>, manoeuvre::num_policies> harms;
};

/// All eight tried at each place; nullopt is not possible. One does not depend on the others.
/// @param time     when the policies begin [s]
/// @param threads  >= 1; they do not change the result
[[nodiscard]] std::vector<Cell> try_cells(
    std::span<const std::optional<scenario::Scenario>> scenarios, const manoeuvre::Car& car,
    const collision::HarmModel& harm, double time, int threads);

}  // namespace saca::eval
