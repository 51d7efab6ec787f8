#include "saca/lab/model_access/local_choice.h"

#include <nlohmann/json.hpp>
#include <string>
#include <system_error>

#include "saca/base/core/file.h"
#include "saca/base/formats/json_text.h"

namespace saca::model_access {

LocalChoice local_choice(const std::filesystem::path& file) {
  const auto text = read_file(file);
  if (!text.has_value()) {
    return {};
  }
  const auto parsed = formats::parse_json(text.value());
  if (!parsed.has_value() || !parsed.value().is_object()) {
    return {};
  }
  LocalChoice choice;
  const auto name = parsed.value().find("weights");
  if (name != parsed.value().end() && name->is_string()) {
    const std::filesystem::path weights = file.parent_path() / name->get<std::string>();
    std::error_code problem;
    choice.weights =
        std::filesystem::exists(weights, problem) ? std::optional(weights) : std::nullopt;
  }
  const auto flash = parsed.value().find("flash_attention");
  choice.flash_attention = flash != parsed.value().end() && flash->is_boolean() && *flash == true;
  return choice;
}

}  // namespace saca::model_access
