#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "saca/lab/forecast_study/forecast_figures.h"

namespace saca::forecast_study {

/// How a study was made.
struct StudyOrigin {
  std::string name;  ///< of the suite, family or folder
  std::string command;
  std::uint64_t seed = 1;
  std::string version;  ///< of the program
};

/// What `saca forecast eval --json` prints: figures whose names begin with "forecast." and the name
/// without folders, each mean with .lo, .hi and .n where somebody counts. Times are in
/// milliseconds, "500ms": keys have dots between their parts.
[[nodiscard]] nlohmann::json json_of(const StudyFigures& figures, const StudyOrigin& origin);

/// The same as tables for people, a column for each model.
/// @param notes  on where the encounters come from
[[nodiscard]] std::string text_of(const StudyFigures& figures, const std::string& name,
                                  const std::vector<std::string>& notes);

}  // namespace saca::forecast_study
