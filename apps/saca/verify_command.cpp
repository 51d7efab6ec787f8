#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/saca/atlas_making.h"
#include "apps/saca/commands.h"
#include "apps/saca/inputs.h"
#include "apps/saca/json_output.h"
#include "apps/saca/printing.h"
#include "saca/base/core/file.h"
#include "saca/base/core/printable.h"
#include "saca/base/formats/json_text.h"
#include "saca/lab/encounter/provenance.h"
#include "saca/lab/report/record_in_words.h"

namespace saca::app {
namespace {

using nlohmann::json;

struct VerifyOptions {
  std::string record;
  bool as_json = false;
};

/// One thing that a record depends on: as it was recorded, and as it is here.
struct Dependency {
  std::string what;
  std::string name;
  json recorded;
  json here;          ///< null: it is not here
  std::string lacks;  ///< why not
};

/// What the same run would read now; an error that says what of it is not here.
Result<json> read_now(const std::string& car, bool with_atlas) {
  const auto inputs = read_inputs(car);
  if (!inputs.has_value()) {
    return inputs.error();
  }
  std::optional<atlas::Atlas> atlas;
  if (with_atlas) {
    atlas = usual_atlas(inputs.value());
  }
  return encounter::inputs_json({.car = &inputs.value().car,
                                 .harm = &inputs.value().harm,
                                 .atlas = atlas ? &*atlas : nullptr,
                                 .cues = &inputs.value().cues},
                                inputs.value().intent, car);
}

/// One of a list of inputs; nullptr: there is none.
const json* input_called(const json& inputs, std::string_view what) {
  const auto found = std::find_if(inputs.begin(), inputs.end(),
                                  [&](const json& one) { return one.at("what") == what; });
  return found == inputs.end() ? nullptr : &*found;
}

/// @param made  of a record
Result<std::vector<Dependency>> compared(const json& made) {
  const auto places = find_places();
  if (!places.has_value()) {
    return places.error();
  }
  const json& inputs = made.at("inputs");
  const json* const car = input_called(inputs, "car");
  const json* const atlas = input_called(inputs, "atlas");
  const auto now = read_now(car == nullptr ? "" : car->at("name").get<std::string>(),
                            atlas != nullptr && !atlas->at("digest").is_null());
  std::vector<Dependency> all;
  for (const json& one : inputs) {
    Dependency& told = all.emplace_back(Dependency{.what = one.at("what").get<std::string>(),
                                                   .name = one.at("name").get<std::string>(),
                                                   .recorded = one.at("digest"),
                                                   .here = nullptr,
                                                   .lacks = ""});
    if (told.what == "scenario") {
      const auto digest = scenario_digest(places.value(), told.name);
      told.here = digest.has_value() ? json(digest.value()) : json(nullptr);
      told.lacks = digest.has_value() ? "" : digest.error().message;
    } else if (!now.has_value()) {
      told.lacks = now.error().message;
    } else if (const json* const same = input_called(now.value(), told.what)) {
      told.here = same->at("digest");
    }
  }
  return all;
}

int verify(const VerifyOptions& options) {
  const auto malformed = [&](const std::string& what) {
    return refused({Error::Code::malformed, options.record + ": " + what});
  };
  const auto text = read_file(options.record, many_bytes);
  if (!text.has_value()) {
    return refused(text.error());
  }
  if (const auto told = report::explanation(text.value(), options.record); !told.has_value()) {
    return refused(told.error());  // no record, or not a whole one
  }
  const json record = formats::parse_json(text.value()).value();
  const auto found = record.find("made");
  if (found == record.end() || found->is_null()) {
    return malformed("made: want who made the record by what, got none: it is older than that");
  }
  try {
    const json& made = *found;
    const auto recorded = made.at("content").get<std::string>();
    const std::string content = encounter::content_digest(record);
    const auto all = compared(made);
    if (!all.has_value()) {
      return refused(all.error());
    }
    bool same = recorded == content;
    json inputs = json::array();
    for (const Dependency& one : all.value()) {
      same = same && one.recorded == one.here;
      inputs.push_back({{"what", one.what},
                        {"name", one.name},
                        {"recorded", one.recorded},
                        {"here", one.here},
                        {"same", one.recorded == one.here}});
    }
    if (options.as_json) {
      print_json(json{{"schema", "saca.verification/1"},
                      {"program", made.at("program")},
                      {"commit", made.at("commit")},
                      {"date", made.at("date")},
                      {"command", made.at("command")},
                      {"content", {{"recorded", recorded}, {"here", content}}},
                      {"inputs", inputs},
                      {"same", same}});
      return same ? success : not_the_same;
    }
    const auto words = [&](const char* key) {
      return one_line(made.at(key).get<std::string>(), 2'000);
    };
    app::print("Made by {} ({}), {}:\n  {}\n", words("program"), words("commit"), words("date"),
               words("command"));
    app::print("  {:<12} {}\n", "content",
               recorded == content ? "as it was written" : "has been changed since");
    for (const Dependency& one : all.value()) {
      const std::string state = one.recorded == one.here ? "the same here"
                                : one.here.is_null()     ? "not here: " + one.lacks
                                                         : "another one here";
      app::print("  {:<12} {}: {}\n", one.what, one_line(one.name), one_line(state, 2'000));
    }
    return same ? success : not_the_same;
  } catch (const json::exception& problem) {
    return malformed(std::string("made: want it whole, got: ") + one_line(problem.what()));
  }
}

}  // namespace

void add_verify(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand(
      "verify", "Check that a record is as it was written, and that what it was made from is here");
  const auto options = std::make_shared<VerifyOptions>();
  command->add_option("record", options->record, "A record.json that `saca run` left")->required();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = verify(*options); });
}

}  // namespace saca::app
