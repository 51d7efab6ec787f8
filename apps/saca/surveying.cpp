#include "apps/saca/surveying.h"

#include <fmt/core.h>

#include "apps/saca/settings.h"
#include "apps/saca/version.h"
#include "apps/saca/within.h"
#include "saca/lab/policy_study/interruptible_survey.h"
#include "saca/lab/policy_study/survey_inputs.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::app {

std::optional<Error> add_inputs(const Places& places, const std::string& car, Fnv& hash) {
  const auto car_file = find_car(places, car);
  if (!car_file.has_value()) {
    return car_file.error();
  }
  return policy_study::add_survey_inputs(places.root, car_file.value(), hash);
}

std::string command_line(const SurveyOptions& options, const std::string& command) {
  const std::string log = options.test_log.empty() ? "" : " --test-log " + options.test_log;
  return fmt::format("saca {} --suite {} --count {} --split {} --car {}{}", command, options.suite,
                     options.count, options.split, options.car, log);
}

Result<DrawnSuite> open_suite(const SurveyOptions& options, const std::string& command) {
  auto inputs = read_inputs(options.car);
  if (!inputs.has_value()) {
    return inputs.error();
  }
  const Places& places = inputs.value().places;
  Fnv hash;
  if (auto problem = add_inputs(places, options.car, hash)) {
    return *problem;
  }
  std::optional<families::TestLog> log;
  if (!options.test_log.empty()) {
    log = families::TestLog{options.test_log, command_line(options, command)};
  }
  auto source = eval::SuiteSource::open({.scenarios = places.root / "scenarios",
                                         .suite = options.suite,
                                         .split = *families::split_from(options.split),
                                         .test_log = std::move(log),
                                         .car = inputs.value().car_name,
                                         .footprint = manoeuvre::footprint(inputs.value().car),
                                         .other_names = options.other_names});
  if (!source.has_value()) {
    return source.error();
  }
  return DrawnSuite{.inputs = std::move(inputs).value(),
                    .source = std::move(source).value(),
                    .digest = hash.value()};
}

Result<std::optional<std::vector<eval::Finding>>> survey(const DrawnSuite& suite,
                                                         const SurveyOptions& options) {
  const std::string path = options.journal.empty() ? fmt::format("runs/survey-{}-{}.journal",
                                                                 options.suite, options.split)
                                                   : options.journal;
  return policy_study::interruptible_survey(
      {.source = &suite.source,
       .car = &suite.inputs.car,
       .harm = &suite.inputs.harm,
       .count = options.count,
       .threads = options.threads,
       .journal = path,
       .title = fmt::format("saca {} survey of {}, {} split, {} ({:016x})", version_text(),
                            options.suite, options.split, options.car, suite.digest)},
      options.suite, progress_display());
}

void add_draw_options(CLI::App& command, int& count, std::string& split, std::string& test_log,
                      std::string& car) {
  command.add_option("--count", count, "How many encounters")
      ->check(CLI::Range(1, 10'000'000))
      ->capture_default_str();
  command.add_option("--split", split, "Whose seed is used")
      ->check(one_of({"tuning", "calibration", "test"}))
      ->capture_default_str();
  command.add_option("--test-log", test_log,
                     "Where a use of the test split is noted; needed for it");
  command.add_option("--car", car, "A car's file, or the name of a shipped one")
      ->capture_default_str();
}

void add_survey_options(CLI::App& command, SurveyOptions& options) {
  command.add_option("--suite", options.suite, "Which mixture of families")->capture_default_str();
  add_draw_options(command, options.count, options.split, options.test_log, options.car);
  command.add_option("--journal", options.journal,
                     "What was found so far (default: runs/survey-SUITE-SPLIT.journal)");
  add_threads(command, options.threads);
}

}  // namespace saca::app
