#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/eval/suite.h"

namespace saca::suites {

/// What was run, and how it went.
struct SuiteRun {
  std::vector<std::string> methods;
  std::vector<eval::SuiteRow> rows;  ///< in the order of their numbers
  double seconds = 0.0;              ///< that this call worked, by the clock
  int worked = 0;                    ///< encounters of this call
  nlohmann::json meta;               ///< "meta.command", "meta.seed" and so on
  std::vector<std::string> notes;    ///< on where the encounters come from, in sentences
  /// Encounter `number` again.
  std::function<Result<eval::SuiteEncounter>(std::uint64_t number)> encounter_at;
  /// eval::tried_in with what the suite was run with.
  std::function<std::optional<eval::TriedScene>(const eval::SuiteEncounter&)> tried_in;
};

/// How it was made, for the foot of a page: what "meta...." holds.
[[nodiscard]] std::vector<std::string> footnotes_of(const nlohmann::json& meta);

}  // namespace saca::suites
