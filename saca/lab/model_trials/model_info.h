#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "saca/thinking/language_model/child_model.h"

namespace saca::model_trials {

/// What `saca model info` tells of a model in its own process; memory in MiB.
/// @param figures  with how long it took to load
[[nodiscard]] nlohmann::json model_info(const language_model::protocol::Info& info,
                                        const language_model::ChildModelFigures& figures);

/// The same as a document: schema saca.model_info/1.
[[nodiscard]] nlohmann::json model_info_json(nlohmann::json info);
/// The same, a line each.
[[nodiscard]] std::string model_info_text(const nlohmann::json& info);

}  // namespace saca::model_trials
