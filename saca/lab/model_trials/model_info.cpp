#include "saca/lab/model_trials/model_info.h"

#include <fmt/core.h>

namespace saca::model_trials {

nlohmann::json model_info(const language_model::protocol::Info& info,
                          const language_model::ChildModelFigures& figures) {
  constexpr double mebi = 1024.0 * 1024.0;
  return {{"description", info.description},
          {"file", info.file},
          {"weights_mib", static_cast<double>(info.weight_bytes) / mebi},
          {"resident_mib", static_cast<double>(info.resident_bytes) / mebi},
          {"threads", info.threads},
          {"load_s", figures.load_time},
          {"system_tokens", figures.system_tokens}};
}

nlohmann::json model_info_json(nlohmann::json info) {
  info["schema"] = "saca.model_info/1";
  return info;
}

std::string model_info_text(const nlohmann::json& info) {
  std::string text;
  for (const auto& [key, value] : info.items()) {
    text +=
        fmt::format("{:14} {}\n", key, value.is_string() ? value.get<std::string>() : value.dump());
  }
  return text;
}

}  // namespace saca::model_trials
