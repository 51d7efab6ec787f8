#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/danger_check.h"
#include "apps/saca/danger_making.h"
#include "apps/saca/inputs.h"
#include "apps/saca/json_output.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "saca/base/core/clock.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/learned_danger/coverage.h"
#include "saca/lab/learned_danger/transition_file.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/progress.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/danger/car_limits.h"

namespace saca::app {
namespace {

using learned_danger::Coverage;
using learned_danger::CoverageSurvey;
using nlohmann::json;

struct CoverageOptions {
  std::string folder;
  int states = 200;
  int others = 20'000;
  int threads = usual_threads();
  bool as_json = false;
};

/// The parts that follow the first one.
/// @return  an error: a part cannot be used, or nobody wanted to wait
std::optional<Error> read_rest(CoverageSurvey& survey, const std::string& car,
                               const std::vector<std::filesystem::path>& files) {
  SteadyClock clock;
  long_work::ProgressLine line("danger coverage", static_cast<int>(files.size()), clock,
                               progress_display());
  for (std::size_t i = 1; i < files.size() && !survey.is_full(); ++i) {
    if (long_work::interrupted()) {
      return Error{Error::Code::too_late, "interrupted"};
    }
    const auto part = learned_danger::read_part_of(files[i], car);
    if (!part.has_value()) {
      return part.error();
    }
    survey.add(part.value().transitions);
    line.show(static_cast<int>(i) + 1, 0, " parts");
  }
  return std::nullopt;
}

void tell(const CoverageOptions& options, const std::string& car,
          const std::vector<Coverage>& all) {
  if (options.as_json) {
    json figures{{"meta.car", car}, {"meta.threads", options.threads}};
    for (const Coverage& one : all) {
      const std::string name = fmt::format("danger.coverage.from_{:.0f}_mps.grip_from_{:.1f}.",
                                           one.slowest, one.least_grip);
      figures[name + "median"] = one.median;
      figures[name + "p90"] = one.p90;
      figures[name + "states"] = one.states;
      figures[name + "others"] = one.others;
    }
    print_json(figures);
    return;
  }
  app::print(
      "from the exact best demand to the nearest of what was done in the {} states most alike, on "
      "the unit disc of demands\n{:>10}  {:>9}  {:>7}  {:>7}  {:>6}  {:>6}\n",
      CoverageSurvey::num_alike, "m/s", "grip", "median", "90 %", "states", "among");
  for (const Coverage& one : all) {
    app::print("{:>10}  {:>9}  {:>7.3f}  {:>7.3f}  {:>6}  {:>6}\n",
               fmt::format("{:.0f} to {:.0f}", one.slowest, one.fastest),
               fmt::format("{:.1f} to {:.1f}", one.least_grip, one.most_grip), one.median, one.p90,
               one.states, one.others);
  }
}

int tell_coverage(const CoverageOptions& options) {
  long_work::watch_for_interrupt();
  const auto files = learned_danger::part_files(options.folder);
  if (!files.has_value()) {
    return refused(files.error());
  }
  const auto first = learned_danger::read_part(files.value().front());
  if (!first.has_value()) {
    return refused(first.error());
  }
  const auto inputs = read_inputs(first.value().car);
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  const auto model = danger_of_drawn(inputs.value(), true);
  if (!model.has_value()) {
    return refused(model.error());
  }
  CoverageSurvey survey(danger::avoidance_of(inputs.value().car, 1.0),
                        manoeuvre::footprint(inputs.value().car), model.value(),
                        static_cast<std::size_t>(options.states),
                        static_cast<std::size_t>(options.others));
  survey.add(first.value().transitions);
  if (const auto problem = read_rest(survey, first.value().car, files.value())) {
    const int code = refused(*problem);
    return problem->code == Error::Code::too_late ? static_cast<int>(was_interrupted) : code;
  }
  const auto all = survey.figures(options.threads);
  if (all.empty()) {
    return refused({Error::Code::out_of_range,
                    options.folder +
                        ": want states near the boundary beside one obstacle that keeps its "
                        "velocity, as larger data sets have them, got none that a table knows"});
  }
  tell(options, inputs.value().car_name, all);
  return success;
}

}  // namespace

void add_danger_coverage(CLI::App& danger, int& exit_code) {
  const auto options = std::make_shared<CoverageOptions>();
  CLI::App* const command = danger.add_subcommand(
      "coverage",
      "How near the inputs of a data set come to the exact best ones, by speed and grip");
  command->add_option("FOLDER", options->folder, "Of the parts that `saca danger dataset` made")
      ->required();
  command
      ->add_option("--states", options->states,
                   "Of each bin, whose best inputs are looked for, at most")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  command->add_option("--among", options->others, "Likewise, among which they are looked for")
      ->check(CLI::Range(static_cast<int>(CoverageSurvey::num_alike), 10'000'000))
      ->capture_default_str();
  command->add_option("--threads", options->threads, "They do not change the figures")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = tell_coverage(*options); });
}

}  // namespace saca::app
