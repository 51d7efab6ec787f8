#include "saca/lab/benchmarks/risk_times.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "saca/base/core/parallel.h"
#include "saca/lab/benchmarks/call_times.h"
#include "saca/lab/levelset/solve.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/danger/car_limits.h"
#include "saca/thinking/danger/danger_cases.h"
#include "saca/thinking/danger/value_table.h"

namespace saca::benchmarks {
namespace {

constexpr double meeting_grip = 0.9;  // the tables' and that of the figures

std::vector<danger::Meeting> drawn_meetings(const RiskTask& task) {
  std::mt19937 rng(1);
  const auto any = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(rng);
  };
  std::vector<danger::Meeting> meetings;
  for (std::size_t i = 0; i < task.num_meetings; ++i) {
    meetings.push_back({.ego = task.ego, .obstacle = task.other, .grip = meeting_grip});
    danger::Meeting& meeting = meetings.back();
    meeting.obstacle_speed = any(0.0, 5.0);
    meeting.state = {any(-50.0, 5.0), any(-10.0, 10.0), any(-0.5, 0.5), any(5.0, 28.0)};
  }
  return meetings;
}

}  // namespace

Result<danger::DangerModel> model_of_two_tables(const manoeuvre::Car& car,
                                                const world::Footprint& other, const Note& note) {
  const world::Footprint ego = manoeuvre::footprint(car);
  const danger::Avoidance limits = danger::avoidance_of(car, meeting_grip);
  const std::array wanted{danger::ObstacleKind{other, 5.0}};
  const auto cases = danger::danger_cases(limits, ego, meeting_grip, wanted);
  if (!cases.has_value()) {
    return cases.error();
  }
  std::vector<danger::DangerTable> tables;
  for (const danger::DangerCase& one : cases.value()) {
    note("a table of danger, " + one.name);
    levelset::Problem problem = levelset::avoidance_problem(one.asked);
    problem.times = {0.5};
    const auto solved =
        levelset::solve(problem, {.threads = usual_threads()}, std::nullopt, levelset::Onlooker{});
    if (!solved.has_value()) {
      return solved.error();
    }
    tables.push_back({*one.asked.obstacle, one.asked.system.obstacle_speed, one.asked.view,
                      std::make_shared<danger::ValueTable>(
                          problem.grid, snapshot(solved.value(), 0), solved.value().error)});
  }
  return danger::DangerModel(limits, ego, std::move(tables));
}

nlohmann::json risk_times(const danger::DangerModel& model, const RiskTask& task,
                          const Clock& clock, const Note& note) {
  std::vector<danger::Meeting> meetings = drawn_meetings(task);
  const auto exact = std::count_if(meetings.begin(), meetings.end(), [&](const auto& meeting) {
    return model.danger(meeting).exact;
  });
  note("dangers");
  // Apart, for one evasion that is driven pushes the tables out of the caches.
  const auto beyond = std::partition(meetings.begin(), meetings.end(), [&](const auto& meeting) {
    return model.exact(meeting).has_value();
  });
  const auto times = [&](const std::string& name, std::span<const danger::Meeting> some,
                         std::size_t num_samples) {
    return call_times(
        name, [&](std::size_t i) { return model.danger(some[i % some.size()]).value; }, clock,
        num_samples);
  };
  nlohmann::json figures = times("reach.risk_us", {meetings.begin(), beyond}, task.num_samples);
  figures.update(times("reach.risk_beyond_us", {beyond, meetings.end()}, task.num_beyond_samples));
  figures["reach.risk_us.exact_share"] =
      static_cast<double>(exact) / static_cast<double>(meetings.size());
  return figures;
}

}  // namespace saca::benchmarks
