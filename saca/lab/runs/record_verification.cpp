#include "saca/lab/runs/record_verification.h"

#include <optional>

#include "saca/base/core/file.h"
#include "saca/base/core/printable.h"
#include "saca/base/formats/json_text.h"
#include "saca/lab/encounter/provenance.h"
#include "saca/lab/installation/inputs.h"
#include "saca/lab/installation/shipped_files.h"
#include "saca/lab/report/record_in_words.h"
#include "saca/lab/vehicle_study/kept_atlas.h"

namespace saca::runs {

using installation::Installation;
using nlohmann::json;

namespace {

/// What the same run would read now; an error that says what of it is not here.
Result<json> read_now(const Installation& here, const encounter::RecordedInputs& recorded) {
  const auto inputs = installation::read_inputs(here, recorded.car);
  if (!inputs.has_value()) {
    return inputs.error();
  }
  std::optional<atlas::Atlas> atlas;
  if (recorded.with_atlas) {
    atlas = vehicle_study::usual_atlas(here, inputs.value());
  }
  return encounter::inputs_json({.car = &inputs.value().car,
                                 .harm = &inputs.value().harm,
                                 .atlas = atlas ? &*atlas : nullptr,
                                 .cues = &inputs.value().cues},
                                inputs.value().intent, recorded.car);
}

}  // namespace

Result<encounter::RecordCheck> verified(const Installation& here, const std::string& file) {
  const auto text = read_file(file, many_bytes);
  if (!text.has_value()) {
    return text.error();
  }
  if (const auto told = report::explanation(text.value(), file); !told.has_value()) {
    return told.error();  // no record, or not a whole one
  }
  const json record = formats::parse_json(text.value()).value();
  const auto made = record.find("made");
  if (made == record.end() || made->is_null()) {
    return Error{
        Error::Code::malformed,
        file + ": made: want who made the record by what, got none: it is older than that"};
  }
  try {
    return encounter::check_record(record,
                                   {.inputs = read_now(here, encounter::recorded_inputs(*made)),
                                    .digest_of = [&](const std::string& name) {
                                      return installation::scenario_digest(here, name);
                                    }});
  } catch (const json::exception& problem) {
    return Error{Error::Code::malformed,
                 file + ": made: want it whole, got: " + one_line(problem.what())};
  }
}

}  // namespace saca::runs
