#include <memory>
#include <string>
#include <vector>

#include "apps/saca/json_output.h"
#include "apps/saca/memory_commands.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "apps/saca/within.h"
#include "saca/base/core/clock.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/banks/recall_calibration.h"
#include "saca/lab/banks/recall_chart.h"
#include "saca/lab/banks/scale_calibration.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/long_work/progress.h"

namespace saca::app {
namespace {

struct CalibrateOptions {
  std::string cases;
  std::vector<std::string> checks;
  std::string svg;
  bool fit = false;
  int fit_scenes = 2'000;
  std::uint64_t seed = 1;
  int threads = usual_threads();
  bool as_json = false;
};

/// Fits what makes a difference, and holds it against other cases.
int fit_scales(const CalibrateOptions& options, const banks::CalibrationCases& cases) {
  long_work::watch_for_interrupt();
  SteadyClock clock;
  long_work::ProgressLine progress("scales", 0, clock, progress_display());
  const auto scales = banks::calibrate_scales(
      cases, {.scenes = options.fit_scenes, .threads = options.threads}, progress);
  if (!scales.has_value()) {
    return refused(scales.error());
  }
  if (options.as_json) {
    app::print_json(json_of(scales.value(), SACA_VERSION));
  } else {
    app::print("{}", text_of(scales.value()));
  }
  if (!scales.value().fit.is_done) {
    complain("interrupted: the scales are the best so far");
    return was_interrupted;
  }
  return success;
}

/// How often what is recalled holds.
int calibrate_recalls(const CalibrateOptions& options, const banks::CalibrationCases& cases) {
  const banks::RecallCalibration recalls =
      banks::calibrate_recalls(cases, options.seed, options.threads);
  if (!options.as_json) {
    app::print("{}", text_of(recalls));
  }
  if (!options.svg.empty()) {
    if (const auto problem = long_work::write_output(options.svg, banks::recall_chart(recalls))) {
      return refused(*problem);
    }
  }
  if (options.as_json) {
    app::print_json(json_of(recalls, SACA_VERSION));
  }
  return success;
}

int calibrate(const CalibrateOptions& options) {
  if (const auto problem = long_work::why_outputs_unwritable({options.svg})) {
    return refused(*problem);
  }
  const auto cases = banks::read_calibration_cases(options.cases, options.checks);
  if (!cases.has_value()) {
    return refused(cases.error());
  }
  return options.fit ? fit_scales(options, cases.value())
                     : calibrate_recalls(options, cases.value());
}

}  // namespace

void add_memory_calibrate(CLI::App& memory, int& exit_code) {
  CLI::App* const command = memory.add_subcommand(
      "calibrate", "How often what cases speak for is as good as the best, by its confidence");
  const auto options = std::make_shared<CalibrateOptions>();
  command->add_option("cases", options->cases, "What `build` or `export` wrote")->required();
  command->add_option("--check", options->checks, "Other cases, that are held against them");
  command->add_option("--svg", options->svg,
                      "The curve as a picture, of --check where it is given");
  command->add_flag("--fit", options->fit,
                    "Fits the scales of what makes a difference between scenes instead");
  command->add_option("--fit-scenes", options->fit_scenes, "How many are predicted in each try")
      ->check(CLI::Range(10, 1'000'000))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Of what is drawn")->capture_default_str();
  add_threads(*command, options->threads);
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = calibrate(*options); });
}

}  // namespace saca::app
