#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/danger_study/data_set.h"
#include "saca/lab/reach_study/danger_tables.h"
#include "saca/lab/scenario/scenario.h"
#include "saca/thinking/danger/danger.h"

namespace saca::danger_study {

/// A car, and where what is known of its danger is kept.
struct DangerSources {
  prepare::NamedCar car;
  std::filesystem::path weights;  ///< safetensors file of learnt danger; may be missing
  reach_study::TableStore tables;
};

/// What was learnt of this car's danger; none where there is no such file, or it is of a car whose
/// numbers were changed since, which is noticed (TableStore::notice).
/// @return  an error naming the file, what was wanted and what came
[[nodiscard]] Result<danger::LearnedValue> learned_value_of(const DangerSources& sources);

/// With these tables, made ready, and nothing learnt.
/// @return  an error where the car's limits are beyond what can be solved
[[nodiscard]] Result<danger::DangerModel> model_by_tables(
    const DangerSources& sources, const std::vector<danger::DangerCase>& cases);

/// For the obstacles of data sets (learned_danger/draws.h): with the tables of their bodies, made
/// ready, or with none.
/// @return  likewise
[[nodiscard]] Result<danger::DangerModel> model_of_drawn(const DangerSources& sources,
                                                         TableUse tables);

/// By what was learnt of the car, and nothing that must be waited for; where tables are wanted,
/// with all that the scenario's actors need.
/// @return  as both; nullopt: no tables are wanted, and nothing was learnt of the car
[[nodiscard]] Result<std::optional<danger::DangerModel>> usual_model(
    const DangerSources& sources, const scenario::Scenario& scenario, TableUse tables);

}  // namespace saca::danger_study
