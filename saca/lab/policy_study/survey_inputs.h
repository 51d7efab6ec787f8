#pragma once

#include <filesystem>
#include <optional>

#include "saca/base/core/fnv.h"
#include "saca/base/core/result.h"

namespace saca::policy_study {

/// Adds all files that change what is found in given encounters: the car with its tuning, the data,
/// the families, and the program itself. Their order is that of their names.
/// @param root      holds data/ and scenarios/
/// @param car_file  its tuning lies beside it
/// @return          nullopt, else what cannot be read
[[nodiscard]] std::optional<Error> add_survey_inputs(const std::filesystem::path& root,
                                                     const std::filesystem::path& car_file,
                                                     Fnv& hash);

}  // namespace saca::policy_study
