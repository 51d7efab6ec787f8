#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "saca/lab/eval/model_score.h"

namespace saca::model_trials {

/// Document of `saca model score --json`: schema saca.model_score/2 (docs/formats.md).
/// @param command  that asks for the same again
/// @param model    what it says that it is
[[nodiscard]] nlohmann::json model_score_json(const eval::ModelScore& score,
                                              const std::string& command, const std::string& model);

/// The same for readers: a table of all ways to choose, then what was said.
[[nodiscard]] std::string model_score_text(const eval::ModelScore& score, const std::string& model);

}  // namespace saca::model_trials
