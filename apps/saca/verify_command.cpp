#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/saca/atlas_making.h"
#include "apps/saca/commands.h"
#include "apps/saca/inputs.h"
#include "apps/saca/json_output.h"
#include "apps/saca/printing.h"
#include "saca/config/json_text.h"
#include "saca/core/file.h"
#include "saca/core/fnv.h"
#include "saca/core/printable.h"
#include "saca/loop/provenance.h"
#include "saca/report/explanation.h"
#include "saca/runtime/tape_header.h"

namespace saca::app {
namespace {

using nlohmann::json;

struct VerifyOptions {
  std::string record;
  bool as_json = false;
};

/// One thing that a record depends on: as it was recorded, and as it is here.
struct Compared {
  std::string what;
  std::string name;
  json recorded;
  json here;          ///< null: it is not here
  std::string lacks;  ///< why not
};

/// What the command would read now.
/// @param made  of a record
Result<std::vector<Compared>> compared(const json& made) {
  std::vector<Compared> all;
  for (const json& one : made.at("inputs")) {
    all.push_back({.what = one.at("what").get<std::string>(),
                   .name = one.at("name").get<std::string>(),
                   .recorded = one.at("digest"),
                   .here = nullptr,
                   .lacks = ""});
  }
  const auto places = find_places();
  if (!places.has_value()) {
    return places.error();
  }
  for (Compared& one : all) {
    if (one.what == "scenario") {
      const auto file = find_scenario(places.value(), one.name);
      Fnv hash;
      const auto problem =
          file.has_value()
              ? read_file(file.value(), [&](std::string_view bytes) { hash.add(bytes); })
              : std::optional(file.error());
      one.lacks = problem ? problem->message : "";
      one.here = problem ? json(nullptr) : json(runtime::digest_text(hash));
    }
  }
  const auto of = [&](std::string_view what) -> Compared* {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Compared& one) { return one.what == what; });
    return found == all.end() ? nullptr : &*found;
  };
  const Compared* const car = of("car");
  if (car == nullptr) {
    return all;
  }
  const auto inputs = read_inputs(car->name);
  const Compared* const told_atlas = of("atlas");
  const bool with_atlas = told_atlas != nullptr && !told_atlas->recorded.is_null();
  std::optional<manoeuvre::Atlas> atlas;
  std::optional<runtime::TapeHeader> here;
  if (inputs.has_value()) {
    if (with_atlas) {
      atlas = usual_atlas(inputs.value());
    }
    here = runtime::tape_header(
        {.forecast = {&inputs.value().car, &inputs.value().harm, atlas ? &*atlas : nullptr}},
        inputs.value().intent);
  }
  const auto note = [&](std::string_view what, const auto& digest) {
    if (Compared* const one = of(what)) {
      one->here = here ? json(digest(*here)) : json(nullptr);
      one->lacks = here ? "" : inputs.error().message;
    }
  };
  note("car", [](const runtime::TapeHeader& header) { return header.car_digest; });
  note("harm", [](const runtime::TapeHeader& header) { return header.harm_digest; });
  note("intentions", [](const runtime::TapeHeader& header) { return header.intent_digest; });
  if (with_atlas) {
    note("atlas", [](const runtime::TapeHeader& header) { return header.atlas.value_or(""); });
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
  const json record = config::parse_json(text.value()).value();
  const auto found = record.find("made");
  if (found == record.end() || found->is_null()) {
    return malformed("made: want who made the record by what, got none: it is older than that");
  }
  try {
    const json& made = *found;
    const auto recorded = made.at("content").get<std::string>();
    const std::string content = loop::content_digest(record);
    const auto all = compared(made);
    if (!all.has_value()) {
      return refused(all.error());
    }
    bool same = recorded == content;
    json inputs = json::array();
    for (const Compared& one : all.value()) {
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
    for (const Compared& one : all.value()) {
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
