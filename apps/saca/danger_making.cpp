#include "apps/saca/danger_making.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "apps/saca/places.h"
#include "apps/saca/progress.h"
#include "saca/core/clock.h"
#include "saca/core/parallel.h"
#include "saca/manoeuvre/ego.h"
#include "saca/reach/car_limits.h"
#include "saca/reach/danger_set.h"
#include "saca/reach/solve.h"
#include "saca/reach/value_file.h"
#include "saca/sim/traffic.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using reach::Solved;

constexpr double table_grip = 0.9;  // dry: all others follow by scaling

/// Bodies of all actors, each with the highest speed that it has while the ego stands at its start.
std::vector<reach::ToBeJudged> to_be_judged(const sim::Scenario& scenario,
                                            const world::Footprint& ego) {
  std::vector<reach::ToBeJudged> found;
  const auto note = [&](const world::Actor& actor) {
    found.push_back({actor.footprint, norm(actor.v_W)});
  };
  const Pose X_WB =
      std::holds_alternative<sim::EgoStart>(scenario.ego)
          ? world::from_lane(scenario.road, std::get<sim::EgoStart>(scenario.ego).pose)
          : std::get<sim::Recording>(scenario.ego).front().X_WA;
  sim::Traffic traffic(scenario);
  for (int k = 0; traffic.time() <= scenario.duration; ++k) {
    if (k % 10 == 0) {
      for (const world::Actor& actor : traffic.actors()) {
        note(actor);
      }
      for (const world::Actor& ghost : traffic.ghosts()) {
        note(ghost);
      }
    }
    traffic.advance(X_WB, {}, ego);
  }
  return found;
}

std::optional<Solved> kept_table(const fs::path& file, const reach::DangerCase& wanted) {
  auto there = reach::read_solved(file);
  if (!there.has_value() || !there.value().complete || there.value().problem != wanted.asked.text) {
    return std::nullopt;
  }
  return std::move(there).value();
}

Result<Solved> solved_table(const fs::path& file, const reach::DangerCase& wanted) {
  const reach::Problem problem = reach::avoidance_problem(wanted.asked);
  SteadyClock clock;
  constexpr int permille = 1'000;
  ProgressLine line("danger of " + wanted.name, permille, clock);
  auto solved = reach::solve(
      problem, {.steps = reach::Steps::tvd_rk2, .cfl = 0.9, .threads = usual_threads()},
      std::nullopt, {.step = [&](double tau) {
        line.show(static_cast<int>(permille * tau / problem.times.back()), 0, " per mille");
        return true;
      }});
  if (!solved.has_value()) {
    return solved.error();
  }
  auto not_kept = make_folder_of(file);
  if (!not_kept) {
    not_kept = reach::write_solved(file, solved.value());
  }
  if (not_kept) {
    complain(not_kept->message + "; the table is used, and solved again next time");
  }
  return solved;
}

}  // namespace

Result<reach::DangerModel> usual_danger(const ScenarioInputs& inputs) {
  const world::Footprint ego = manoeuvre::footprint(inputs.car);
  const reach::Avoidance limits = reach::avoidance_of(inputs.car, table_grip);
  std::vector<reach::DangerTable> tables;
  for (const reach::DangerCase& wanted : reach::danger_cases(
           limits, ego, sim::believed_grip(inputs.scenario), to_be_judged(inputs.scenario, ego))) {
    const fs::path file = danger_place(inputs.places, inputs.car_name, wanted.name);
    std::optional<Solved> solved = kept_table(file, wanted);
    if (!solved) {
      auto made = solved_table(file, wanted);
      if (!made.has_value()) {
        return made.error();
      }
      solved = std::move(made).value();
    }
    const std::vector<float> values = snapshot(*solved, solved->times.size() - 1);
    tables.push_back({*wanted.asked.obstacle, wanted.asked.system.obstacle_speed, wanted.asked.view,
                      std::make_shared<reach::ValueTable>(solved->grid, values, solved->error)});
  }
  return reach::DangerModel(limits, ego, std::move(tables));
}

}  // namespace saca::app
