#pragma once

#include <span>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/eval/decision_point.h"
#include "saca/lab/eval/scenario_axis.h"

namespace saca::eval {

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
