#include "apps/saca/regulation_running.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <sstream>

#include "apps/saca/planes_making.h"
#include "apps/saca/settings.h"
#include "apps/saca/suite_running.h"
#include "saca/base/core/suggestion.h"
#include "saca/lab/eval/suite.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/progress.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using eval::Regulation;

constexpr std::size_t cells_per_thread = 4;  // between two looks at the signals

std::vector<std::string> words_of(const std::string& list) {
  std::vector<std::string> words;
  std::istringstream stream(list);
  for (std::string word; std::getline(stream, word, ',');) {
    words.push_back(word);
  }
  return words;
}

/// Only the rows that were asked for.
std::optional<Error> choose_rows(Regulation& regulation, const std::string& list) {
  if (list.empty()) {
    return std::nullopt;
  }
  std::vector<std::string> known;
  for (const eval::RegulationRow& row : regulation.rows) {
    known.push_back(row.name);
  }
  std::vector<eval::RegulationRow> chosen;
  for (const std::string& word : words_of(list)) {
    const auto found = std::find_if(regulation.rows.begin(), regulation.rows.end(),
                                    [&](const auto& row) { return row.name == word; });
    if (found == regulation.rows.end()) {
      return Error{Error::Code::out_of_range,
                   fmt::format("--rows: no row is called {}; {}", word, suggestion(word, known))};
    }
    chosen.push_back(*found);
  }
  regulation.rows = std::move(chosen);
  return std::nullopt;
}

/// One per method.
std::vector<RegulationResult> results_of(const RegulationRun& run, std::size_t index,
                                         const PlanesOfCar& car) {
  const eval::RegulationCell& cell = run.cells[index];
  const eval::SuiteEncounter encounter{
      .number = index,
      .family = run.row_of(index).name,
      .scenario = eval::scenario_of(run.regulation, cell, manoeuvre::footprint(car.inputs.car)),
      .twin = {}};
  const eval::SuiteRow row = eval::run_encounter(
      encounter,
      {.methods = run.methods, .seed = 1, .imitators = run.imitators.get(), .exact = true},
      car.setup, car.inputs.intent);
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
bool play(RegulationRun& run, const std::vector<std::unique_ptr<const PlanesOfCar>>& cars,
          int threads, const std::function<bool(std::size_t done)>& go_on) {
  const std::size_t count = cars.size() * run.cells.size();
  const std::size_t batch = cells_per_thread * static_cast<std::size_t>(threads);
  for (std::size_t first = 0; first < count; first += batch) {
    const std::size_t now = std::min(batch, count - first);
    in_parallel(now, threads, [&](std::size_t i) {
      const std::size_t at = first + i;
      auto results = results_of(run, at % run.cells.size(), *cars[at / run.cells.size()]);
      std::move(results.begin(), results.end(),
                run.results.begin() + static_cast<std::ptrdiff_t>(at * run.methods.size()));
    });
    if (!go_on(first + now)) {
      return false;
    }
  }
  return true;
}

Result<RegulationRun> prepare(const RegulationOptions& options,
                              const std::vector<std::string>& methods) {
  const auto places = find_places();
  if (!places.has_value()) {
    return places.error();
  }
  auto regulation = eval::load_regulation(regulation_path(places.value(), options.name));
  if (!regulation.has_value()) {
    return regulation.error();
  }
  RegulationRun run{.regulation = std::move(regulation).value(),
                    .cells = {},
                    .cars = words_of(options.cars),
                    .methods = methods,
                    .results = {},
                    .meta = {}};
  auto imitators = suites::imitators_of(methods, places.value().root / "models");
  if (!imitators.has_value()) {
    return imitators.error();
  }
  run.imitators = std::move(imitators).value();
  if (auto problem = choose_rows(run.regulation, options.rows)) {
    return *problem;
  }
  run.cells = eval::cells_of(run.regulation);
  run.results.resize(run.cars.size() * run.cells.size() * run.methods.size());
  run.meta = {{"meta.command",
               fmt::format("saca suite {} --methods {} --car {}{}", options.name, options.methods,
                           options.cars, options.rows.empty() ? "" : " --rows " + options.rows)},
              {"meta.n", std::to_string(run.cars.size() * run.cells.size())},
              {"meta.source", run.regulation.source},
              {"meta.version", SACA_VERSION}};
  return run;
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

fs::path regulation_path(const Places& places, const std::string& name) {
  return places.root / "data" / "protocols" / (name + ".toml");
}

std::optional<std::size_t> index_of(const RegulationRun& run, const std::string& method) {
  return index_of(run.methods, method);
}

Result<std::optional<RegulationRun>> run_cells(const RegulationOptions& options,
                                               const std::vector<std::string>& methods) {
  auto prepared = prepare(options, methods);
  if (!prepared.has_value()) {
    return prepared.error();
  }
  RegulationRun run = std::move(prepared).value();
  std::vector<std::unique_ptr<const PlanesOfCar>> cars;
  for (const std::string& name : run.cars) {
    auto car = open_planes(name);
    if (!car.has_value()) {
      return car.error();
    }
    cars.push_back(std::move(car).value());
  }
  if (index_of(run, "aeb")) {
    for (std::size_t k = 1; k < run.regulation.surfaces.size(); ++k) {
      RegulationRun other = run;
      other.regulation.surface = k;
      other.methods = {"aeb"};
      other.results.resize(cars.size() * run.cells.size());
      run.elsewhere.push_back(std::move(other));
    }
  }
  long_work::watch_for_interrupt();
  SteadyClock clock;
  const std::size_t count = cars.size() * run.cells.size();
  long_work::ProgressLine progress("suite " + run.regulation.name,
                                   static_cast<int>(count * (1 + run.elsewhere.size())), clock,
                                   progress_display());
  std::size_t before = 0;
  const auto go_on = [&](std::size_t done) {
    progress.show(static_cast<int>(before + done), 0, " tests");
    return !long_work::interrupted();
  };
  bool all = play(run, cars, options.threads, go_on);
  for (RegulationRun& other : run.elsewhere) {
    before += count;
    all = all && play(other, cars, options.threads, go_on);
  }
  return all ? std::optional(std::move(run)) : std::optional<RegulationRun>();
}

}  // namespace saca::app
