#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "apps/saca/inputs.h"
#include "saca/base/core/result.h"
#include "saca/lab/levelset/solve.h"
#include "saca/thinking/danger/danger.h"
#include "saca/thinking/danger/danger_cases.h"

namespace saca::app {

/// The tables that these bodies need on this grip or more.
/// @return  an error naming the car where it is beyond what a table may hold
[[nodiscard]] Result<std::vector<danger::DangerCase>> tables_for(
    const Inputs& inputs, double grip, const std::vector<danger::ObstacleKind>& bodies);

/// The tables that the scenario's actors need.
/// @return  an error naming the car where it is beyond what a table may hold
[[nodiscard]] Result<std::vector<danger::DangerCase>> needed_tables(const ScenarioInputs& inputs);

struct ReadyTable {
  danger::Solution table;
  std::filesystem::path file;     ///< its `danger_place`
  bool was_there = false;         ///< and right for this car; else it was solved
  std::optional<Error> not_kept;  ///< why it could not be written
};

/// Reads a table; solves it, in seconds, with progress on the error stream, where it is not there.
/// A program that already makes tables of this car is waited for.
/// @return  an error where a car's limits are beyond what can be solved
[[nodiscard]] Result<ReadyTable> ready_table(const Inputs& inputs,
                                             const danger::DangerCase& wanted);

/// What was learnt of this car's danger, models/danger/CAR.safetensors; none where there is no such
/// file, or it is of a car whose numbers were changed since, which is said.
/// @return  an error naming the file, what was wanted and what came
[[nodiscard]] Result<danger::LearnedValue> learned_danger(const Inputs& inputs);

/// With these tables, made ready, and nothing learnt.
/// @return  likewise
[[nodiscard]] Result<danger::DangerModel> danger_by(const Inputs& inputs,
                                                    const std::vector<danger::DangerCase>& cases);

/// For the obstacles of data sets (learned_danger/draws.h): with the tables of their bodies, made
/// ready, or with none.
/// @return  likewise
[[nodiscard]] Result<danger::DangerModel> danger_of_drawn(const Inputs& inputs, bool with_tables);

/// By what was learnt of the car, and nothing that must be waited for; where tables are wanted,
/// with all that the scenario's actors need.
/// @return  likewise; nullopt: no tables are wanted, and nothing was learnt of the car
[[nodiscard]] Result<std::optional<danger::DangerModel>> usual_danger(const ScenarioInputs& inputs,
                                                                      bool with_tables);

}  // namespace saca::app
