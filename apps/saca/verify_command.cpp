#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/saca/atlas_making.h"
#include "apps/saca/commands.h"
#include "apps/saca/inputs.h"
#include "apps/saca/json_output.h"
#include "apps/saca/printing.h"
#include "saca/base/core/file.h"
#include "saca/base/core/printable.h"
#include "saca/base/formats/json_text.h"
#include "saca/lab/encounter/provenance.h"
#include "saca/lab/encounter/record_check.h"
#include "saca/lab/report/record_in_words.h"

namespace saca::app {
namespace {

using nlohmann::json;

struct VerifyOptions {
  std::string record;
  bool as_json = false;
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

/// What a record's `made` names, as it is here.
encounter::InputsHere inputs_here(const Places& places, const json& made) {
  const encounter::RecordedInputs recorded = encounter::recorded_inputs(made);
  return {.inputs = read_now(recorded.car, recorded.with_atlas),
          .digest_of = [&](const std::string& name) { return scenario_digest(places, name); }};
}

int check_and_tell(const VerifyOptions& options, const json& record) {
  const auto places = find_places();
  if (!places.has_value()) {
    return refused(places.error());
  }
  const encounter::RecordCheck check =
      encounter::check_record(record, inputs_here(places.value(), record.at("made")));
  if (options.as_json) {
    app::print_json(encounter::json_of(check));
  } else {
    app::print("{}", encounter::text_of(check));
  }
  return check.is_same() ? success : not_the_same;
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
    return check_and_tell(options, record);
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
