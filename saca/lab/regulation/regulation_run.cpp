#include "saca/lab/regulation/regulation_run.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "saca/base/core/clock.h"
#include "saca/base/core/parallel.h"
#include "saca/base/core/suggestion.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::regulation {
namespace {

constexpr std::size_t cells_per_thread = 4;  // between two looks at the signals

/// One per method.
std::vector<RegulationResult> results_of(const RegulationRun& run, std::size_t index,
                                         const TestedCar& car, const eval::Imitators* imitators) {
  const eval::RegulationCell& cell = run.cells[index];
  const eval::SuiteEncounter encounter{
      .number = index,
      .family = run.row_of(index).name,
      .scenario = eval::scenario_of(run.regulation, cell, manoeuvre::footprint(*car.car)),
      .twin = {}};
  const eval::SuiteRow row = eval::run_encounter(
      encounter, {.methods = run.methods, .seed = 1, .imitators = imitators, .exact = true},
      *car.setup, *car.intent);
  std::vector<RegulationResult> results(run.methods.size());
  for (std::size_t m = 0; m < results.size(); ++m) {
    RegulationResult& result = results[m];
    if (!row.fault.empty()) {
      result.judged.verdict = eval::TestVerdict::fault;
      result.fault = row.fault;
      continue;
    }
    const eval::MethodRun& played = row.risk.runs[m];
    result = {.judged = eval::judged(run.regulation, cell, played),
              .plan = played.plan,
              .acted_at = played.acted_at,
              .fault = played.fault};
  }
  return results;
}

/// Plays every cell with every car.
/// @param go_on  told how many are done; false: no further
/// @return       were all played?
bool play(RegulationRun& run, std::span<const TestedCar> cars, const PlayOptions& options,
          const std::function<bool(std::size_t done)>& go_on) {
  const std::size_t count = cars.size() * run.cells.size();
  const std::size_t batch = cells_per_thread * static_cast<std::size_t>(options.threads);
  for (std::size_t first = 0; first < count; first += batch) {
    const std::size_t now = std::min(batch, count - first);
    in_parallel(now, options.threads, [&](std::size_t i) {
      const std::size_t at = first + i;
      auto results = results_of(run, at % run.cells.size(), cars[at / run.cells.size()],
                                options.imitators.get());
      std::move(results.begin(), results.end(),
                run.results.begin() + static_cast<std::ptrdiff_t>(at * run.methods.size()));
    });
    if (!go_on(first + now)) {
      return false;
    }
  }
  return true;
}

/// "aeb" alone on each further surface.
std::vector<RegulationRun> on_further_surfaces(const RegulationRun& run) {
  std::vector<RegulationRun> further;
  for (std::size_t k = 1; k < run.regulation.surfaces.size(); ++k) {
    RegulationRun other = run;
    other.regulation.surface = k;
    other.methods = {"aeb"};
    other.results.resize(run.cars.size() * run.cells.size());
    further.push_back(std::move(other));
  }
  return further;
}

}  // namespace

PassCount passed_by(const RegulationRun& run, const TestSelection& chosen) {
  PassCount sum;
  for (std::size_t k = 0; k < run.cars.size(); ++k) {
    for (std::size_t i = 0; i < run.cells.size(); ++i) {
      if (k != chosen.car.value_or(k) ||
          run.cells[i].row != chosen.row.value_or(run.cells[i].row) ||
          run.row_of(i).manual_braking !=
              chosen.manual_braking.value_or(run.row_of(i).manual_braking)) {
        continue;
      }
      const eval::CellResult& judged = run.at(k, i, chosen.method).judged;
      ++sum.all;
      sum.passed += judged.passed() ? 1 : 0;
      sum.faults += judged.verdict == eval::TestVerdict::fault ? 1 : 0;
      sum.worst = std::max(sum.worst, judged.passed() ? 0.0 : judged.impact_speed);
    }
  }
  return sum;
}

bool has_faults(const RegulationRun& run) {
  for (std::size_t m = 0; m < run.methods.size(); ++m) {
    if (passed_by(run, {.method = m}).faults > 0) {
      return true;
    }
  }
  return false;
}

std::optional<std::size_t> index_of(const RegulationRun& run, const std::string& method) {
  const auto found = std::find(run.methods.begin(), run.methods.end(), method);
  return found == run.methods.end()
             ? std::nullopt
             : std::optional(static_cast<std::size_t>(found - run.methods.begin()));
}

Result<eval::Regulation> with_rows(eval::Regulation regulation,
                                   const std::vector<std::string>& names) {
  if (names.empty()) {
    return regulation;
  }
  std::vector<std::string> known;
  for (const eval::RegulationRow& row : regulation.rows) {
    known.push_back(row.name);
  }
  std::vector<eval::RegulationRow> chosen;
  for (const std::string& name : names) {
    const auto found = std::find_if(regulation.rows.begin(), regulation.rows.end(),
                                    [&](const auto& row) { return row.name == name; });
    if (found == regulation.rows.end()) {
      return Error{Error::Code::out_of_range,
                   "no row is called " + name + "; " + suggestion(name, known)};
    }
    chosen.push_back(*found);
  }
  regulation.rows = std::move(chosen);
  return regulation;
}

RegulationRun tests_of(eval::Regulation regulation, std::vector<std::string> cars,
                       std::vector<std::string> methods) {
  RegulationRun run{.regulation = std::move(regulation),
                    .cells = {},
                    .cars = std::move(cars),
                    .methods = std::move(methods),
                    .results = {},
                    .meta = {},
                    .elsewhere = {}};
  run.cells = eval::cells_of(run.regulation);
  run.results.resize(run.cars.size() * run.cells.size() * run.methods.size());
  return run;
}

std::optional<RegulationRun> played(RegulationRun run, std::span<const TestedCar> cars,
                                    const PlayOptions& options) {
  if (index_of(run, "aeb")) {
    run.elsewhere = on_further_surfaces(run);
  }
  long_work::watch_for_interrupt();
  SteadyClock clock;
  const std::size_t count = cars.size() * run.cells.size();
  long_work::ProgressLine progress("suite " + run.regulation.name,
                                   static_cast<int>(count * (1 + run.elsewhere.size())), clock,
                                   options.display);
  std::size_t before = 0;
  const auto go_on = [&](std::size_t done) {
    progress.show(static_cast<int>(before + done), 0, " tests");
    return !long_work::interrupted();
  };
  bool all = play(run, cars, options, go_on);
  for (RegulationRun& other : run.elsewhere) {
    before += count;
    all = all && play(other, cars, options, go_on);
  }
  return all ? std::optional(std::move(run)) : std::nullopt;
}

}  // namespace saca::regulation
