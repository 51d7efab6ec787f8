#include "saca/lab/reach_study/danger_tables.h"

#include <memory>
#include <utility>

#include "saca/base/core/clock.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/levelset/solve.h"
#include "saca/lab/long_work/folder_hold.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/danger/car_limits.h"
#include "saca/thinking/danger/value_table.h"

namespace saca::reach_study {
namespace {

namespace fs = std::filesystem;
using danger::Solution;

std::optional<Solution> kept_table(const fs::path& file, const danger::DangerCase& wanted) {
  auto there = danger::read_solved(file);
  if (!there.has_value()) {
    return std::nullopt;
  }
  const Solution& kept = there.value();
  const bool right = kept.complete && !kept.error.empty() && kept.problem == wanted.asked.text &&
                     kept.scheme == levelset::described(levelset::danger_scheme(usual_threads()));
  return right ? std::optional(std::move(there).value()) : std::nullopt;
}

Result<Solution> solved_now(const danger::DangerCase& wanted, long_work::ProgressDisplay display) {
  const levelset::Problem problem = levelset::avoidance_problem(wanted.asked);
  SteadyClock clock;
  constexpr int permille = 1'000;
  long_work::ProgressLine line("danger of " + wanted.name, permille, clock, display);
  return levelset::solve(
      problem, levelset::danger_scheme(usual_threads()), std::nullopt, {.step = [&](double tau) {
        line.show(static_cast<int>(permille * tau / problem.times.back()), 0, " per mille");
        return true;
      }});
}

}  // namespace

Result<std::vector<danger::DangerCase>> tables_for(
    const prepare::NamedCar& car, double grip, const std::vector<danger::ObstacleKind>& bodies) {
  auto cases = danger::danger_cases(danger::avoidance_of(car.car, table_grip),
                                    manoeuvre::footprint(car.car), grip, bodies);
  if (!cases.has_value()) {
    return Error{cases.error().code, car.name + ": " + cases.error().message};
  }
  return cases;
}

Result<ReadyTable> ready_table(const danger::DangerCase& wanted, const TableStore& store) {
  const fs::path file = store.place(wanted.name);
  if (auto kept = kept_table(file, wanted)) {
    return ReadyTable{.table = *std::move(kept), .file = file, .was_there = true};
  }
  auto not_kept = long_work::make_folder_of(file);
  const fs::path folder = file.parent_path();
  const long_work::FolderHold hold(folder, [&] {
    store.notice(folder.string() + ": another program makes tables there; this one waits for it");
  });
  if (auto kept = kept_table(file, wanted)) {  // while this program waited
    return ReadyTable{.table = *std::move(kept), .file = file, .was_there = true};
  }
  auto solved = solved_now(wanted, store.display);
  if (!solved.has_value()) {
    return solved.error();
  }
  if (!not_kept) {
    not_kept = danger::write_solved(file, solved.value());
  }
  return ReadyTable{
      .table = std::move(solved).value(), .file = file, .not_kept = std::move(not_kept)};
}

Result<std::vector<danger::DangerTable>> ready_tables(const std::vector<danger::DangerCase>& cases,
                                                      const TableStore& store) {
  std::vector<danger::DangerTable> tables;
  for (const danger::DangerCase& wanted : cases) {
    const auto ready = ready_table(wanted, store);
    if (!ready.has_value()) {
      return ready.error();
    }
    if (const auto& problem = ready.value().not_kept) {
      store.notice(problem->message + "; the table is used, and solved again next time");
    }
    const Solution& solved = ready.value().table;
    tables.push_back({*wanted.asked.obstacle, wanted.asked.system.obstacle_speed, wanted.asked.view,
                      std::make_shared<danger::ValueTable>(
                          solved.grid, snapshot(solved, solved.times.size() - 1), solved.error)});
  }
  return tables;
}

}  // namespace saca::reach_study
