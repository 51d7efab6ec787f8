#include "saca/lab/banks/suite_cases.h"

#include <fmt/core.h>

#include <utility>

#include "saca/lab/suites/opened_suite.h"

namespace saca::banks {

std::string command_text(const SuiteCasesRequest& request) {
  const suites::SuiteRequest& from = request.from;
  return fmt::format("memory build {} --split {} --car {} --seed {} --draws {}{}{}", from.name,
                     from.split, from.car, from.seed, request.draws, from.exact ? " --exact" : "",
                     request.no_twins ? " --no-twins" : "");
}

CaseTools case_tools(const vehicle_study::PlanesOfCar& planes, std::size_t draws) {
  return {planes.setup.forecast, &planes.inputs.intent, vehicle_study::made_with(planes), draws};
}

Result<std::optional<CaseBuild>> suite_cases(const installation::Installation& here,
                                             const SuiteCasesRequest& request) {
  const suites::SuiteRequest& from = request.from;
  const std::string command = command_text(request);
  auto opened = suites::open_encounters(here, from, command);
  if (!opened.has_value()) {
    return opened.error();
  }
  suites::SuiteEncounters encounters = std::move(opened).value();
  const auto planes = vehicle_study::open_planes(here, std::move(encounters.inputs));
  if (!planes.has_value()) {
    return planes.error();
  }
  return build_cases({.at = encounters.at,
                      .count = static_cast<std::size_t>(encounters.count),
                      .play = {.seed = from.seed, .exact = from.exact},
                      .twins = request.no_twins ? TwinCases::left_out : TwinCases::made},
                     case_tools(*planes.value(), request.draws),
                     {.journal = from.journal.empty() ? from.output + ".journal" : from.journal,
                      .title = fmt::format("saca {} {} of {}", installation::version_text(here),
                                           command, encounters.what),
                      .progress = "memory of " + from.name,
                      .threads = from.threads,
                      .display = here.display});
}

}  // namespace saca::banks
