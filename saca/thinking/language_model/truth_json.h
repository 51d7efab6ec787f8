#pragma once

#include <nlohmann/json.hpp>

#include "saca/thinking/language_model/truth.h"

namespace saca::language_model {

/// As records and `saca reason --json` have it (docs/formats.md).
[[nodiscard]] inline nlohmann::json truth_json(const Truth& truth) {
  nlohmann::json wrong = nlohmann::json::array();
  for (const FalseStatement& each : truth.wrong) {
    wrong.push_back({{"text", each.text}, {"why", each.why}, {"load_bearing", each.load_bearing}});
  }
  const auto score = truth.score();
  return {{"checked", truth.num_checked},
          {"score", score ? nlohmann::json(*score) : nlohmann::json()},
          {"false", wrong}};
}

}  // namespace saca::language_model
