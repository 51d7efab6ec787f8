#include "saca/base/formats/json_reader.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "saca/base/core/printable.h"

namespace saca::formats {

using nlohmann::json;

std::string JsonReader::shown(const json& value) {
  constexpr std::size_t longest = 40;
  std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
  if (text.size() > longest) {
    text.resize(longest);
    text += "...";
  }
  return text;
}

JsonReader::JsonReader(const json& node, std::string path, std::optional<Error>& problem,
                       std::string_view document)
    : node_(node), path_(std::move(path)), problem_(problem), document_(document) {
  if (!node.is_object()) {
    reject("", "want an object, got " + shown(node));
  }
}

double JsonReader::number(std::string_view key) {
  const json* value = find(key);
  if (value == nullptr) {
    return 0.0;
  }
  if (!value->is_number() || !std::isfinite(value->get<double>())) {
    reject(key, "want a finite number, got " + shown(*value));
    return 0.0;
  }
  return value->get<double>();
}

bool JsonReader::flag(std::string_view key) {
  const json* value = find(key);
  if (value != nullptr && !value->is_boolean()) {
    reject(key, "want true or false, got " + shown(*value));
  }
  return value != nullptr && value->is_boolean() && value->get<bool>();
}

std::string JsonReader::text(std::string_view key) {
  const json* value = find(key);
  if (value != nullptr && !value->is_string()) {
    reject(key, "want a text, got " + shown(*value));
  }
  return value != nullptr && value->is_string() ? value->get<std::string>() : std::string();
}

std::uint64_t JsonReader::integer(std::string_view key, std::uint64_t largest) {
  const json* value = find(key);
  // What was read is unsigned where it is not negative; what a program made may be signed.
  if (value == nullptr || (value->is_number_integer() &&
                           (value->is_number_unsigned() || value->get<std::int64_t>() >= 0) &&
                           value->get<std::uint64_t>() <= largest)) {
    return value == nullptr ? 0 : value->get<std::uint64_t>();
  }
  reject(key, "want an integer from 0 to " + std::to_string(largest) + ", got " + shown(*value));
  return 0;
}

bool JsonReader::has_value(std::string_view key) {
  const auto found = node_.find(key);
  if (found != node_.end() && !found->is_null()) {
    return true;
  }
  (void)find(key);
  return false;
}

JsonReader JsonReader::object(std::string_view key) {
  static const json nothing = json::object();
  const json* value = find(key);
  return {value == nullptr ? nothing : *value, name_of(key), problem_, document_};
}

const json* JsonReader::list(std::string_view key, std::size_t most) {
  const json* value = find(key);
  if (value == nullptr) {
    return nullptr;
  }
  if (!value->is_array()) {
    reject(key, "want an array, got " + shown(*value));
    return nullptr;
  }
  if (value->size() > most) {
    reject(key, "want at most " + std::to_string(most) + ", got " + std::to_string(value->size()));
    return nullptr;
  }
  return value;
}

JsonReader JsonReader::element(std::string_view key, const json& list, std::size_t i) const {
  return {list[i], name_of(key) + "[" + std::to_string(i) + "]", problem_, document_};
}

void JsonReader::numbers(std::string_view key, std::span<double> numbers) {
  const json* values = list(key);
  if (values != nullptr) {
    take_numbers(std::string(key), *values, numbers);
  }
}

void JsonReader::numbers(std::string_view key, const json& list, std::size_t i,
                         std::span<double> numbers) {
  take_numbers(std::string(key) + "[" + std::to_string(i) + "]", list[i], numbers);
}

void JsonReader::take_numbers(const std::string& key, const json& values,
                              std::span<double> numbers) {
  const auto is_finite = [](const json& value) {
    return value.is_number() && std::isfinite(value.get<double>());
  };
  if (!values.is_array() || values.size() != numbers.size() ||
      !std::all_of(values.begin(), values.end(), is_finite)) {
    reject(key, "want " + std::to_string(numbers.size()) + " finite numbers, got " + shown(values));
    return;
  }
  std::transform(values.begin(), values.end(), numbers.begin(),
                 [](const json& value) { return value.get<double>(); });
}

const json& JsonReader::any(std::string_view key) {
  static const json nothing;
  const json* value = find(key);
  return value == nullptr ? nothing : *value;
}

void JsonReader::schema(std::string_view wanted) {
  constexpr std::string_view key = "schema";
  const json* value = find(key);
  if (value != nullptr && *value != wanted) {
    reject(key, "want " + std::string(wanted) + ", got " + shown(*value));
  }
}

void JsonReader::reject(std::string_view key, const std::string& why) {
  if (!problem_) {
    const std::string name = one_line(name_of(key));
    problem_ =
        Error{Error::Code::malformed, (name.empty() ? std::string(document_) : name) + ": " + why};
  }
}

void JsonReader::refuse_others() {
  if (problem_ || node_.size() == asked_.size()) {
    return;
  }
  for (const auto& [key, value] : node_.items()) {
    if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) {
      reject(key, "is not known");
    }
  }
}

const json* JsonReader::find(std::string_view key) {
  if (problem_) {
    return nullptr;
  }
  asked_.emplace_back(key);
  const auto found = node_.find(asked_.back());
  if (found == node_.end()) {
    reject(key, "is missing");
    return nullptr;
  }
  return &*found;
}

std::string JsonReader::name_of(std::string_view key) const {
  return path_.empty() || key.empty() ? path_ + std::string(key) : path_ + "." + std::string(key);
}

}  // namespace saca::formats
