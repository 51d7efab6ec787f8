#include "saca/lab/benchmarks/avoidance_times.h"

#include <fmt/core.h>

#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "saca/base/core/parallel.h"
#include "saca/lab/benchmarks/process_memory.h"
#include "saca/lab/levelset/solve.h"
#include "saca/thinking/danger/grid.h"

namespace saca::benchmarks {
namespace {

constexpr double bytes_per_mib = 1024.0 * 1024.0;
constexpr double parked_grip = 0.9;  // the tables'

/// As in the tables of `saca run`.
constexpr int avoidance_stages = 2;
constexpr double table_cfl = 0.9;

/// When the steps on the fine grid ended.
struct Steps {
  int count = 0;
  Clock::Time first, last;
};

/// Solves it, and tells every second of its time how far it is.
Result<danger::Solution> solved_and_timed(const levelset::Problem& problem,
                                          const levelset::Scheme& scheme, const Clock& clock,
                                          const Note& note, Steps& steps) {
  double told = 0.0, reached = 0.0;
  return levelset::solve(problem, scheme, std::nullopt, {.step = [&](double tau) {
                           if (tau > reached) {  // else: on half as many points, for the error
                             reached = tau;
                             steps.last = clock.now();
                             steps.first = steps.count++ == 0 ? steps.last : steps.first;
                           }
                           if (tau >= told + 1.0) {
                             told = tau;
                             note(fmt::format("{:.1f} of {:g} s", tau, problem.times.back()));
                           }
                           return true;
                         }});
}

}  // namespace

Result<danger::AvoidanceCase> parked_car_with_more_points(const std::filesystem::path& file) {
  auto found = danger::read_avoidance_case(file);
  if (!found.has_value()) {
    return found.error();
  }
  danger::AvoidanceCase parked = std::move(found).value();
  parked.times = {4.0};
  parked.system.grip = parked_grip;
  constexpr std::array points{60, 26, 48, 28};  // 2.1 million
  for (std::size_t d = 0; d < points.size(); ++d) {
    parked.grid.axes.at(d).points = points[d];
  }
  return parked;
}

Result<AvoidanceTimes> avoidance_times(const danger::AvoidanceCase& parked, const Clock& clock,
                                       const Note& note) {
  const levelset::Problem problem = levelset::avoidance_problem(parked);
  const levelset::Scheme scheme{
      .steps = levelset::Steps::tvd_rk2, .cfl = table_cfl, .threads = usual_threads()};
  const auto points = static_cast<double>(danger::num_cells(problem.grid));
  note(fmt::format("a parked car in four dimensions, {:.0f} points", points));
  Steps steps;
  forget_memory_peak();
  const double memory_before = process_memory("VmRSS");
  const Clock::Time start = clock.now();
  auto solved = solved_and_timed(problem, scheme, clock, note, steps);
  const double seconds = to_seconds(clock.now() - start);
  const double peak = process_memory("VmHWM");
  if (!solved.has_value()) {
    return solved.error();
  }
  const double march = to_seconds(steps.last - steps.first);
  nlohmann::json figures{
      {"reach.avoid4d.seconds", seconds},
      {"reach.avoid4d.points", points},
      {"reach.avoid4d.steps", steps.count},
      {"reach.avoid4d.ns_per_point_stage",
       1e9 * march / (points * (steps.count - 1) * avoidance_stages)},
      {"reach.avoid4d.peak_mib", peak},
      {"reach.avoid4d.foretold_mib",
       static_cast<double>(memory_needed(problem, scheme)) / bytes_per_mib},
      {"reach.avoid4d.bytes_per_point", (peak - memory_before) * bytes_per_mib / points}};
  return AvoidanceTimes{std::move(figures), std::move(solved).value()};
}

}  // namespace saca::benchmarks
