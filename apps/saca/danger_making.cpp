#include "apps/saca/danger_making.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "apps/saca/danger_check.h"
#include "apps/saca/places.h"
#include "apps/saca/settings.h"
#include "saca/base/core/clock.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/learned_danger/learned.h"
#include "saca/lab/learned_danger/margins.h"
#include "saca/lab/learned_danger/network.h"
#include "saca/lab/levelset/solve.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/long_work/progress.h"
#include "saca/lab/sim/traffic.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/danger/car_limits.h"
#include "saca/thinking/danger/danger_cases.h"
#include "saca/thinking/danger/value_file.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using danger::Solution;

constexpr double table_grip = 0.9;  // dry: all others follow by scaling

/// Bodies of all actors, each with the highest speed that it has while the ego stands at its start.
std::vector<danger::ObstacleKind> to_be_judged(const scenario::Scenario& scenario,
                                               const world::Footprint& ego) {
  std::vector<danger::ObstacleKind> found;
  const auto note = [&](const world::Actor& actor) {
    found.push_back({actor.footprint, norm(actor.v_W)});
  };
  const Pose X_WB =
      std::holds_alternative<scenario::EgoStart>(scenario.ego)
          ? world::from_lane(scenario.road, std::get<scenario::EgoStart>(scenario.ego).pose)
          : std::get<scenario::Recording>(scenario.ego).front().X_WA;
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

/// While it lives, other programs that make tables in this folder wait. A folder that cannot be
/// opened is not held: nobody can keep anything there either.
class FolderHold {
 public:
  explicit FolderHold(const fs::path& folder)
      : folder_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (folder_ < 0 || ::flock(folder_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) {
      return;
    }
    complain(folder.string() + ": another program makes tables there; this one waits for it");
    while (::flock(folder_, LOCK_EX) != 0 && errno == EINTR) {
    }
  }
  ~FolderHold() {
    if (folder_ >= 0) {
      ::close(folder_);
    }
  }
  FolderHold(const FolderHold&) = delete;
  FolderHold& operator=(const FolderHold&) = delete;

 private:
  int folder_;
};

Result<Solution> solved_now(const danger::DangerCase& wanted) {
  const levelset::Problem problem = levelset::avoidance_problem(wanted.asked);
  SteadyClock clock;
  constexpr int permille = 1'000;
  long_work::ProgressLine line("danger of " + wanted.name, permille, clock, progress_display());
  return levelset::solve(
      problem, levelset::danger_scheme(usual_threads()), std::nullopt, {.step = [&](double tau) {
        line.show(static_cast<int>(permille * tau / problem.times.back()), 0, " per mille");
        return true;
      }});
}

}  // namespace

Result<std::vector<danger::DangerCase>> tables_for(
    const Inputs& inputs, double grip, const std::vector<danger::ObstacleKind>& bodies) {
  auto cases = danger::danger_cases(danger::avoidance_of(inputs.car, table_grip),
                                    manoeuvre::footprint(inputs.car), grip, bodies);
  if (!cases.has_value()) {
    return Error{cases.error().code, inputs.car_name + ": " + cases.error().message};
  }
  return cases;
}

Result<std::vector<danger::DangerCase>> needed_tables(const ScenarioInputs& inputs) {
  return tables_for(inputs, scenario::believed_grip(inputs.scenario),
                    to_be_judged(inputs.scenario, manoeuvre::footprint(inputs.car)));
}

Result<ReadyTable> ready_table(const Inputs& inputs, const danger::DangerCase& wanted) {
  const fs::path file = danger_place(inputs.places, inputs.car_name, wanted.name);
  if (auto kept = kept_table(file, wanted)) {
    return ReadyTable{.table = *std::move(kept), .file = file, .was_there = true};
  }
  auto not_kept = long_work::make_folder_of(file);
  const FolderHold hold(file.parent_path());
  if (auto kept = kept_table(file, wanted)) {  // while this program waited
    return ReadyTable{.table = *std::move(kept), .file = file, .was_there = true};
  }
  auto solved = solved_now(wanted);
  if (!solved.has_value()) {
    return solved.error();
  }
  if (!not_kept) {
    not_kept = danger::write_solved(file, solved.value());
  }
  return ReadyTable{
      .table = std::move(solved).value(), .file = file, .not_kept = std::move(not_kept)};
}

Result<danger::LearnedValue> learned_danger(const Inputs& inputs) {
  const fs::path file =
      inputs.places.root / "models" / "danger" / (inputs.car_name + ".safetensors");
  if (!fs::exists(file)) {
    return danger::LearnedValue();
  }
  auto network = read_danger_network(file);
  if (!network.has_value()) {
    return network.error();
  }
  const auto& words = network.value().words();
  const auto vehicle = words.find("vehicle");
  if (vehicle == words.end() || vehicle->second != learned_danger::vehicle_word(inputs.car)) {
    complain(
        fmt::format("{}: learnt of another {} than that of today; its risks are by a few "
                    "evasions (tools/danger.sh learns V_h anew)",
                    file.string(), inputs.car_name));
    return danger::LearnedValue();
  }
  const auto margins = learned_danger::Margins::from(words, file.string());
  if (!margins.has_value()) {
    return margins.error();
  }
  if (!margins.value()) {
    return Error{Error::Code::malformed,
                 file.string() + ": want margins (`saca danger margins`), got none"};
  }
  return learned_danger::learned_value(
      std::make_shared<const learned_danger::Network>(std::move(network).value()), *margins.value(),
      inputs.car);
}

namespace {

Result<std::vector<danger::DangerTable>> ready_tables(
    const Inputs& inputs, const std::vector<danger::DangerCase>& cases) {
  std::vector<danger::DangerTable> tables;
  for (const danger::DangerCase& wanted : cases) {
    const auto ready = ready_table(inputs, wanted);
    if (!ready.has_value()) {
      return ready.error();
    }
    if (const auto& problem = ready.value().not_kept) {
      complain(problem->message + "; the table is used, and solved again next time");
    }
    const Solution& solved = ready.value().table;
    tables.push_back({*wanted.asked.obstacle, wanted.asked.system.obstacle_speed, wanted.asked.view,
                      std::make_shared<danger::ValueTable>(
                          solved.grid, snapshot(solved, solved.times.size() - 1), solved.error)});
  }
  return tables;
}

danger::DangerModel model_of(const Inputs& inputs, std::vector<danger::DangerTable> tables,
                             danger::LearnedValue learned) {
  return {danger::avoidance_of(inputs.car, table_grip), manoeuvre::footprint(inputs.car),
          std::move(tables), std::move(learned)};
}

}  // namespace

Result<danger::DangerModel> danger_by(const Inputs& inputs,
                                      const std::vector<danger::DangerCase>& cases) {
  auto tables = ready_tables(inputs, cases);
  return tables.has_value() ? model_of(inputs, std::move(tables).value(), {})
                            : Result<danger::DangerModel>(tables.error());
}

Result<danger::DangerModel> danger_of_drawn(const Inputs& inputs, bool with_tables) {
  constexpr double most_grip = 0.9;
  const auto box = [](double length, double width) {
    return world::Footprint{.length = length, .width = width};
  };
  std::vector<danger::ObstacleKind> bodies;  // with the speeds that tables reach
  if (with_tables) {
    bodies = {{box(0.5, 0.5), 4.0},
              {box(4.5, 1.8), 30.0},
              {box(9.0, 2.5), 25.0},
              {box(16.5, 2.55), 25.0}};
  }
  const auto cases = tables_for(inputs, most_grip, bodies);
  return cases.has_value() ? danger_by(inputs, cases.value())
                           : Result<danger::DangerModel>(cases.error());
}

Result<std::optional<danger::DangerModel>> usual_danger(const ScenarioInputs& inputs,
                                                        bool with_tables) {
  using Model = std::optional<danger::DangerModel>;
  auto learned = learned_danger(inputs);
  if (!learned.has_value()) {
    return learned.error();
  }
  if (!with_tables) {
    return learned.value() ? Model(model_of(inputs, {}, std::move(learned).value())) : Model();
  }
  const auto needed = needed_tables(inputs);
  if (!needed.has_value()) {
    return needed.error();
  }
  auto tables = ready_tables(inputs, needed.value());
  return tables.has_value()
             ? Model(model_of(inputs, std::move(tables).value(), std::move(learned).value()))
             : Result<Model>(tables.error());
}

}  // namespace saca::app
