#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/places.h"
#include "saca/core/file.h"
#include "saca/sim/hundred_car.h"

namespace saca::app {
namespace {

struct ImportOptions {
  std::string path;
  sim::HundredCarRequest request;
  std::string output;
};

int import_hundred_car(const ImportOptions& options) {
  const auto imported = sim::import_hundred_car(options.path, options.request);
  if (!imported.has_value()) {
    complain(imported.error().message);
    return bad_input;
  }
  const std::string text = sim::write_scenario(imported.value().scenario);
  if (options.output.empty()) {
    fmt::print("{}", text);
    return success;
  }
  if (const auto problem = write_file(options.output, text)) {
    complain(problem->message);
    return cannot_write;
  }
  const sim::HundredCarReport& report = imported.value().report;
  fmt::print("{}: event {}, rows {} to {}; lead seen in {} rows, {} gaps bridged, {} outliers\n",
             options.output, options.request.event, report.first_row, report.last_row,
             report.lead.num_seen, report.lead.num_gaps, report.lead.num_outliers);
  return success;
}

}  // namespace

void add_import(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand("import", "Make a scenario of a recording");
  command->require_subcommand(1);
  CLI::App* const study = command->add_subcommand(
      "100car", "A rear-end conflict of the 100-Car study: ego, lead and follower");
  const auto options = std::make_shared<ImportOptions>();
  study
      ->add_option("path", options->path,
                   "Folder of the release (timeseries/ and meta/), or one time-series file")
      ->required();
  study->add_option("--event", options->request.event, "Event id")->required();
  study->add_option("--before_s", options->request.before, "Kept before the conflict")
      ->check(CLI::Range(1.0, 60.0))
      ->capture_default_str();
  study->add_option("--after_s", options->request.after, "Kept after the last evasive manoeuvre")
      ->check(CLI::Range(0.0, 60.0))
      ->capture_default_str();
  study->add_option("--narrative", options->request.narrative, "The study's own words, quoted");
  study->add_option("--output", options->output, "The scenario file; without it, to the terminal");
  study->callback([options, &exit_code] { exit_code = import_hundred_car(*options); });
}

}  // namespace saca::app
