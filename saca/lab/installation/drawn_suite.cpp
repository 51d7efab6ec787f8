#include "saca/lab/installation/drawn_suite.h"

#include <fmt/core.h>

#include <utility>

#include "saca/lab/installation/shipped_files.h"
#include "saca/lab/policy_study/interruptible_survey.h"
#include "saca/lab/policy_study/survey_inputs.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::installation {

namespace {

std::string line_of(const std::string& suite, const DrawRequest& draw, const std::string& command) {
  const std::string log = draw.test_log.empty() ? "" : " --test-log " + draw.test_log;
  return fmt::format("saca {} --suite {} --count {} --split {} --car {}{}", command, suite,
                     draw.count, draw.split, draw.car, log);
}

}  // namespace

std::string command_line(const SurveyRequest& request, const std::string& command) {
  return line_of(request.suite, request.draw, command);
}

std::optional<Error> add_inputs(const Installation& here, const std::string& car, Fnv& hash) {
  const auto file = find_car(here, car);
  return file.has_value() ? policy_study::add_survey_inputs(here.root, file.value(), hash)
                          : std::optional(file.error());
}

Result<DrawnSuite> open_suite(const Installation& here, const std::string& suite,
                              const DrawRequest& draw, const std::string& command,
                              std::vector<std::string> other_names) {
  auto inputs = read_inputs(here, draw.car);
  if (!inputs.has_value()) {
    return inputs.error();
  }
  Fnv hash;
  if (auto problem = add_inputs(here, draw.car, hash)) {
    return *problem;
  }
  std::optional<families::TestLog> log;
  if (!draw.test_log.empty()) {
    log = families::TestLog{draw.test_log, line_of(suite, draw, command)};
  }
  auto source = eval::SuiteSource::open({.scenarios = here.root / "scenarios",
                                         .suite = suite,
                                         .split = *families::split_from(draw.split),
                                         .test_log = std::move(log),
                                         .car = inputs.value().car_name,
                                         .footprint = manoeuvre::footprint(inputs.value().car),
                                         .other_names = std::move(other_names)});
  if (!source.has_value()) {
    return source.error();
  }
  return DrawnSuite{.inputs = std::move(inputs).value(),
                    .source = std::move(source).value(),
                    .digest = hash.value()};
}

Result<DrawnSuite> open_suite(const Installation& here, const SurveyRequest& request,
                              const std::string& command) {
  return open_suite(here, request.suite, request.draw, command);
}

Result<std::optional<std::vector<eval::Finding>>> survey(const Installation& here,
                                                         const DrawnSuite& suite,
                                                         const SurveyRequest& request) {
  const std::string& split = request.draw.split;
  return policy_study::interruptible_survey(
      {.source = &suite.source,
       .car = &suite.inputs.car,
       .harm = &suite.inputs.harm,
       .count = request.draw.count,
       .threads = request.threads,
       .journal = request.journal.empty()
                      ? fmt::format("runs/survey-{}-{}.journal", request.suite, split)
                      : request.journal,
       .title = fmt::format("saca {} survey of {}, {} split, {} ({:016x})", version_text(here),
                            request.suite, split, request.draw.car, suite.digest)},
      request.suite, here.display);
}

}  // namespace saca::installation
