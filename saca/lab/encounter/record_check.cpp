#include "saca/lab/encounter/record_check.h"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "saca/base/core/printable.h"
#include "saca/lab/encounter/provenance.h"

namespace saca::encounter {
namespace {

using nlohmann::json;

constexpr std::size_t longest_words = 2'000;

/// One of a list of inputs; nullptr: there is none.
const json* input_called(const json& inputs, std::string_view what) {
  const auto found = std::find_if(inputs.begin(), inputs.end(),
                                  [&](const json& one) { return one.at("what") == what; });
  return found == inputs.end() ? nullptr : &*found;
}

Dependency dependency_of(const json& input, const InputsHere& here) {
  Dependency told{.what = input.at("what").get<std::string>(),
                  .name = input.at("name").get<std::string>(),
                  .recorded = input.at("digest"),
                  .here = nullptr,
                  .lacks = ""};
  if (told.what == "scenario") {
    const auto digest = here.digest_of(told.name);
    told.here = digest.has_value() ? json(digest.value()) : json(nullptr);
    told.lacks = digest.has_value() ? "" : digest.error().message;
  } else if (!here.inputs.has_value()) {
    told.lacks = here.inputs.error().message;
  } else if (const json* const same = input_called(here.inputs.value(), told.what)) {
    told.here = same->at("digest");
  }
  return told;
}

std::string recorded_content(const json& made) {
  return made.at("content").get<std::string>();
}

std::string state_text(const Dependency& one) {
  return one.is_same()        ? "the same here"
         : one.here.is_null() ? "not here: " + one.lacks
                              : "another one here";
}

}  // namespace

RecordedInputs recorded_inputs(const json& made) {
  (void)recorded_content(made);
  const json& inputs = made.at("inputs");
  const json* const car = input_called(inputs, "car");
  const json* const atlas = input_called(inputs, "atlas");
  return {.car = car == nullptr ? "" : car->at("name").get<std::string>(),
          .with_atlas = atlas != nullptr && !atlas->at("digest").is_null()};
}

bool RecordCheck::is_unchanged() const {
  return recorded_content(made) == content;
}

bool RecordCheck::is_same() const {
  return is_unchanged() && std::all_of(inputs.begin(), inputs.end(),
                                       [](const Dependency& one) { return one.is_same(); });
}

RecordCheck check_record(const json& record, const InputsHere& here) {
  RecordCheck check{.made = record.at("made"), .content = content_digest(record), .inputs = {}};
  for (const char* const key : {"program", "commit", "date", "command", "content"}) {
    (void)check.made.at(key).get<std::string>();
  }
  for (const json& one : check.made.at("inputs")) {
    check.inputs.push_back(dependency_of(one, here));
  }
  return check;
}

json json_of(const RecordCheck& check) {
  json inputs = json::array();
  for (const Dependency& one : check.inputs) {
    inputs.push_back({{"what", one.what},
                      {"name", one.name},
                      {"recorded", one.recorded},
                      {"here", one.here},
                      {"same", one.is_same()}});
  }
  return {{"schema", "saca.verification/1"},
          {"program", check.made.at("program")},
          {"commit", check.made.at("commit")},
          {"date", check.made.at("date")},
          {"command", check.made.at("command")},
          {"content", {{"recorded", recorded_content(check.made)}, {"here", check.content}}},
          {"inputs", inputs},
          {"same", check.is_same()}};
}

std::string text_of(const RecordCheck& check) {
  const auto words = [&](const char* key) {
    return one_line(check.made.at(key).get<std::string>(), longest_words);
  };
  std::string text = fmt::format("Made by {} ({}), {}:\n  {}\n", words("program"), words("commit"),
                                 words("date"), words("command"));
  text += fmt::format("  {:<12} {}\n", "content",
                      check.is_unchanged() ? "as it was written" : "has been changed since");
  for (const Dependency& one : check.inputs) {
    text += fmt::format("  {:<12} {}: {}\n", one.what, one_line(one.name),
                        one_line(state_text(one), longest_words));
  }
  return text;
}

}  // namespace saca::encounter
