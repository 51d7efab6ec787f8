#include "saca/lab/cases/case_build.h"

#include <fmt/core.h>

#include <utility>

namespace saca::cases {

std::string command_text(const CaseBuildRequest& request) {
  const CaseMakingOptions& making = request.making;
  return fmt::format("cases build --car {} --seed {} --draws {} --told-draws {} --tries {}{}",
                     request.car, making.seed, making.judging.draws, making.judging.told_draws,
                     making.tries, request.count ? fmt::format(" --count {}", *request.count) : "");
}

Result<std::optional<CaseBuild>> build_cases(const installation::Installation& here,
                                             const CaseBuildRequest& request) {
  auto inputs = installation::read_inputs(here, request.car);
  if (!inputs.has_value()) {
    return inputs.error();
  }
  auto sources = open_case_sources(here.root, request.folders, request.hundred_car, request.count);
  if (!sources.has_value()) {
    return sources.error();
  }
  const auto planes = vehicle_study::open_planes(here, std::move(inputs).value());
  if (!planes.has_value()) {
    return planes.error();
  }
  const CaseMaking making(request.making, sources.value(), tools_of(*planes.value()));
  auto gathered = case_rows(
      making,
      {.journal = request.journal.empty() ? request.outputs.cases + ".journal" : request.journal,
       .title = fmt::format("saca {} {}", installation::version_text(here), command_text(request)),
       .display = here.display,
       .threads = request.threads});
  if (!gathered.has_value()) {
    return gathered.error();
  }
  if (!gathered.value()) {
    return std::optional<CaseBuild>();
  }
  std::vector<CaseRow> rows = *std::move(gathered).value();
  FamilyTallies tallies = family_tallies(sources.value(), rows);
  return std::optional(CaseBuild{.sources = std::move(sources).value(),
                                 .tallies = std::move(tallies),
                                 .set = case_set(std::move(rows))});
}

CaseTools tools_of(const vehicle_study::PlanesOfCar& planes) {
  return {.car_name = planes.inputs.car_name,
          .forecast = planes.setup.forecast,
          .intent = &planes.inputs.intent};
}

}  // namespace saca::cases
