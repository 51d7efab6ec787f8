#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "saca/lab/model_trials/forecast_reply.h"

namespace saca::model_trials {

/// What was asked: of which scenario, which model, how.
struct ReasonRequest {
  std::string scenario;  ///< its name
  std::string model;     ///< what it says that it is
  int deadline = 0;      ///< [ms]
  std::string system;    ///< the prompts' fixed part
};

/// Document of `saca reason --json`: schema saca.reason/1 (docs/formats.md).
[[nodiscard]] nlohmann::json reason_json(const ReasonRequest& request,
                                         const std::vector<ForecastReply>& replies);

/// What is asked: of each preview its prompt.
[[nodiscard]] std::string question_text(const std::vector<arbitration::Preview>& previews);

/// Whether people are told the text of a reply, or saw it while it came.
enum class ReasoningText : std::uint8_t { told, seen };

/// What was said of each forecast, how far it is true, and what was chosen.
[[nodiscard]] std::string replies_text(const std::vector<ForecastReply>& replies,
                                       ReasoningText reasoning);

}  // namespace saca::model_trials
