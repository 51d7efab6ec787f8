#include "saca/lab/danger_study/coverage_report.h"

#include <fmt/core.h>

#include <optional>

#include "saca/base/core/clock.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/danger/car_limits.h"

namespace saca::danger_study {
namespace {

using learned_danger::Coverage;
using learned_danger::CoverageSurvey;
using learned_danger::Part;

/// The parts that follow the first one.
std::optional<Error> read_rest(CoverageSurvey& survey, const std::string& car,
                               const std::vector<std::filesystem::path>& files,
                               long_work::ProgressDisplay display) {
  SteadyClock clock;
  long_work::ProgressLine line("danger coverage", static_cast<int>(files.size()), clock, display);
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

}  // namespace

Result<std::vector<Coverage>> coverage_of(const Part& first,
                                          const std::vector<std::filesystem::path>& files,
                                          const manoeuvre::Car& car,
                                          const danger::DangerModel& model,
                                          const CoverageTask& task) {
  CoverageSurvey survey(danger::avoidance_of(car, 1.0), manoeuvre::footprint(car), model,
                        task.states, task.others);
  survey.add(first.transitions);
  if (auto problem = read_rest(survey, first.car, files, task.display)) {
    return *problem;
  }
  auto all = survey.figures(task.threads);
  if (all.empty()) {
    return Error{Error::Code::out_of_range,
                 task.folder +
                     ": want states near the boundary beside one obstacle that keeps its "
                     "velocity, as larger data sets have them, got none that a table knows"};
  }
  return all;
}

nlohmann::json json_of(const std::vector<Coverage>& all) {
  nlohmann::json figures;
  for (const Coverage& one : all) {
    const std::string name = fmt::format("danger.coverage.from_{:.0f}_mps.grip_from_{:.1f}.",
                                         one.slowest, one.least_grip);
    figures[name + "median"] = one.median;
    figures[name + "p90"] = one.p90;
    figures[name + "states"] = one.states;
    figures[name + "others"] = one.others;
  }
  return figures;
}

std::string text_of(const std::vector<Coverage>& all) {
  std::string text = fmt::format(
      "from the exact best demand to the nearest of what was done in the {} states most alike, on "
      "the unit disc of demands\n{:>10}  {:>9}  {:>7}  {:>7}  {:>6}  {:>6}\n",
      CoverageSurvey::num_alike, "m/s", "grip", "median", "90 %", "states", "among");
  for (const Coverage& one : all) {
    text += fmt::format("{:>10}  {:>9}  {:>7.3f}  {:>7.3f}  {:>6}  {:>6}\n",
                        fmt::format("{:.0f} to {:.0f}", one.slowest, one.fastest),
                        fmt::format("{:.1f} to {:.1f}", one.least_grip, one.most_grip), one.median,
                        one.p90, one.states, one.others);
  }
  return text;
}

}  // namespace saca::danger_study
