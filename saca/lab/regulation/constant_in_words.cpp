#include "saca/lab/regulation/constant_in_words.h"

#include <fmt/core.h>

#include <optional>

namespace saca::regulation {
namespace {

/// How one car fails a row: how often, and where worst.
std::string failures_of(const RegulationRun& run, std::size_t row, std::size_t car,
                        std::size_t method) {
  const PassCount sum = passed_by(run, {.method = method, .car = car, .row = row});
  if (sum.passed == sum.all) {
    return "";
  }
  std::optional<std::size_t> worst;
  for (std::size_t i = 0; i < run.cells.size(); ++i) {
    const bool failed = run.cells[i].row == row && !run.at(car, i, method).judged.passed();
    if (failed && (!worst || run.at(car, i, method).judged.impact_speed >=
                                 run.at(car, *worst, method).judged.impact_speed)) {
      worst = i;
    }
  }
  return fmt::format("{} fails {} of {}, worst at {}: {}", run.cars[car], sum.failed(), sum.all,
                     eval::label_of(run.cells[*worst]),
                     failure_of(run.at(car, *worst, method).judged));
}

std::string failed_in_words(const PassCount& sum) {
  return sum.failed() == 0
             ? fmt::format("passes all {} tests", sum.all)
             : fmt::format("fails {} of {} tests, at worst with an impact of {:.1f} m/s",
                           sum.failed(), sum.all, sum.worst);
}

/// Full braking at T1 on another surface, car by car.
std::string elsewhere_in_words(const RegulationRun& run) {
  const eval::TestSurface& surface = run.regulation.surfaces[run.regulation.surface];
  std::string cars;
  for (std::size_t k = 0; k < run.cars.size(); ++k) {
    const PassCount alone = passed_by(run, {.method = 0, .car = k, .manual_braking = false});
    cars += fmt::format("{}{} {}", k == 0 ? "" : "; ", run.cars[k], failed_in_words(alone));
  }
  return fmt::format(
      "On a surface with friction coefficient {} ({}), without the driver's brake: {}.",
      surface.grip, surface.source, cars);
}

}  // namespace

std::string failure_of(const eval::CellResult& judged) {
  using eval::TestVerdict;
  switch (judged.verdict) {
    case TestVerdict::passed:
      break;
    case TestVerdict::contact:
      return fmt::format("hits with {:.1f} m/s", judged.impact_speed);
    case TestVerdict::no_braking:
      return "steers and does not brake";
    case TestVerdict::false_reaction:
      return fmt::format("acts, decelerates by {:.1f} m/s2", judged.peak_deceleration);
    case TestVerdict::fault:
      return "could not be played";
  }
  return "";
}

std::vector<std::string> constant_in_words(const RegulationRun& run) {
  const auto method = index_of(run, "aeb");
  if (!method) {
    return {};
  }
  const PassCount alone = passed_by(run, {.method = *method, .manual_braking = false});
  const PassCount helped = passed_by(run, {.method = *method, .manual_braking = true});
  if (alone.failed() + helped.failed() == 0) {
    return {fmt::format("Full braking at the paper's T1 = 1.3 s passes all {} tests that were run.",
                        alone.all + helped.all)};
  }
  std::vector<std::string> lines{
      fmt::format("Full braking at the paper's T1 = 1.3 s would not be allowed on the road: it {}.",
                  failed_in_words(alone))};
  if (helped.all > 0) {
    lines.front() += fmt::format(
        " Where the driver brakes one second after a warning, it {}: nobody is warned before T1, "
        "and then the driver comes too late.",
        failed_in_words(helped));
  }
  for (std::size_t r = 0; r < run.regulation.rows.size(); ++r) {
    std::string cars;
    for (std::size_t k = 0; k < run.cars.size(); ++k) {
      const std::string failures = failures_of(run, r, k, *method);
      cars += (cars.empty() || failures.empty() ? "" : "; ") + failures;
    }
    if (!cars.empty()) {
      lines.push_back(fmt::format("{} ({}): {}.", run.regulation.rows[r].title,
                                  run.regulation.rows[r].paragraph, cars));
    }
  }
  for (const RegulationRun& other : run.elsewhere) {
    lines.push_back(elsewhere_in_words(other));
  }
  return lines;
}

}  // namespace saca::regulation
