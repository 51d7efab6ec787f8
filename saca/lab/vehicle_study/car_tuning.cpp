#include "saca/lab/vehicle_study/car_tuning.h"

#include <fmt/core.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "saca/base/core/clock.h"
#include "saca/base/core/fnv.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/prepare/tuning_file.h"
#include "saca/lab/prepare/vehicle_file.h"
#include "saca/lab/tune/minimise.h"
#include "saca/lab/tune/trials.h"

namespace saca::vehicle_study {

namespace fs = std::filesystem;
using manoeuvre::Car;

namespace {

/// Of the car's parameters: with others, costs that were worked out before are worth nothing.
std::uint64_t digest(const vehicle::Vehicle& car) {
  Fnv hash;
  hash.add_doubles(car);
  return hash.value();
}

/// One law of a car, and what it must be good at.
template <class Law>
struct LawTask {
  std::string what;
  Law manoeuvre::Tuning::*law;
  std::vector<tune::Trial> trials;
  double (*cost)(const Car&, const tune::Trial&);
  int evaluations = 0;
  fs::path journal;
};

/// Makes one law good at its trials.
/// @return  its cost; nullopt: interrupted
template <class Law, std::size_t n>
Result<std::optional<double>> tune_law(const TuningWork& work, const LawTask<Law>& task,
                                       const std::array<manoeuvre::Number<Law>, n>& numbers,
                                       Car& car) {
  const auto with = [&](const std::vector<double>& x) {
    Car changed = car;
    for (std::size_t i = 0; i < n; ++i) {
      changed.tuning.*task.law.*numbers[i].member = x[i];
    }
    return changed;
  };
  tune::Problem problem{
      .name = fmt::format("{}: {} of {} ({:016x})", work.program, task.what, work.car, digest(car)),
      .cost = [&](const std::vector<double>& x) {
        return tune::total_cost(with(x), task.trials, task.cost, work.threads);
      }};
  for (const auto& number : numbers) {
    problem.low.push_back(number.min);
    problem.high.push_back(number.max);
    problem.start.push_back(car.tuning.*task.law.*number.member);
  }
  SteadyClock clock;
  long_work::ProgressLine line(task.what, task.evaluations, clock, work.display);
  int remembered = 0;
  const auto found = tune::minimise(
      problem, {task.evaluations, work.seed}, task.journal, [&](const tune::Progress& progress) {
        remembered += progress.remembered ? 1 : 0;
        line.show(progress.evaluations, remembered,
                  fmt::format(" evaluations, best {:.4f}", progress.best));
        return !long_work::interrupted();
      });
  if (!found.has_value()) {
    return found.error();
  }
  if (!found.value()) {
    return std::optional<double>();
  }
  car = with(found.value()->at);
  return std::optional(found.value()->cost);
}

fs::path swerve_journal(const TuningWork& work) {
  return work.output.string() + ".swerve.journal";
}

fs::path drift_journal(const TuningWork& work) {
  return work.output.string() + ".drift.journal";
}

}  // namespace

Result<std::optional<LawCosts>> tune_laws(const TuningWork& work, Car& car) {
  long_work::watch_for_interrupt();
  const LawTask<manoeuvre::SwerveLaw> swerve_task{
      "lane change",     &manoeuvre::Tuning::swerve, tune::swerve_trials(work.seed),
      tune::swerve_cost, work.swerve_evaluations,    swerve_journal(work)};
  const auto swerve = tune_law(work, swerve_task, manoeuvre::swerve_numbers, car);
  if (!swerve.has_value()) {
    return swerve.error();
  }
  if (!swerve.value()) {
    return std::optional<LawCosts>();
  }
  const LawTask<manoeuvre::DriftLaw> drift_task{
      "T-drift",        &manoeuvre::Tuning::drift, tune::drift_trials(work.seed),
      tune::drift_cost, work.drift_evaluations,    drift_journal(work)};
  const auto drift = tune_law(work, drift_task, manoeuvre::drift_numbers, car);
  if (!drift.has_value()) {
    return drift.error();
  }
  if (!drift.value()) {
    return std::optional<LawCosts>();
  }
  return std::optional(LawCosts{*swerve.value(), *drift.value()});
}

Result<std::optional<LawCosts>> tune_car(const TuningWork& work, int draws, Car& car) {
  auto costs = tune_laws(work, car);
  if (!costs.has_value() || !costs.value()) {
    return costs;
  }
  if (work.display == long_work::ProgressDisplay::shown) {
    std::fputs(
        fmt::format("domain of the T-drift: {} draws at each speed and grip\n", draws).c_str(),
        stderr);
  }
  const auto domain = tune::find_domain(car, draws, work.seed + 1, work.threads,
                                        [] { return !long_work::interrupted(); });
  if (!domain) {
    return std::optional<LawCosts>();
  }
  car.tuning.domain = *domain;
  return costs;
}

void remove_journals(const TuningWork& work) {
  fs::remove(swerve_journal(work));
  fs::remove(drift_journal(work));
}

Result<Car> read_start(const fs::path& car_file, const fs::path& tuning_file) {
  const auto parameters = prepare::read_vehicle(car_file);
  if (!parameters.has_value()) {
    return parameters.error();
  }
  const auto tuning = prepare::read_tuning(tuning_file);
  if (!tuning.has_value()) {
    return tuning.error();
  }
  return Car{parameters.value(), tuning.value()};
}

}  // namespace saca::vehicle_study
