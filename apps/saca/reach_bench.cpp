#include "apps/saca/reach_bench.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "saca/base/core/file.h"
#include "saca/base/core/parallel.h"
#include "saca/base/core/percentile.h"
#include "saca/base/formats/json_text.h"
#include "saca/lab/levelset/own_systems.h"
#include "saca/lab/levelset/solve.h"
#include "saca/lab/levelset/solver.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/danger/car_limits.h"
#include "saca/thinking/danger/danger_cases.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double bytes_per_mib = 1024.0 * 1024.0;
constexpr double dry_grip = 0.9;  // dry: the tables' and that of the figures

void note_progress(const std::string& what) {
  if (!settings().quiet) {
    app::print(stderr, "bench reach: {}\n", what);
  }
}

// --- air3D ---------------------------------------------------------------------------------------

constexpr int air3d_stages = 3;  // of a step

struct AirGrid {
  int x, y, heading;
};
constexpr AirGrid coarse_air{51, 40, 50};
constexpr AirGrid fine_air{101, 79, 100};

/// One solution of the game, and how long it took.
template <class Real>
struct Air3dRun {
  double seconds = 0.0;
  int steps = 0;
  std::vector<Real> values;
};

template <class Real>
Result<Air3dRun<Real>> air3d_run(const danger::Grid& grid, int threads, const Clock& clock) {
  constexpr double horizon = 2.8;
  const levelset::Air3d game;
  const auto h = danger::sampled<Real>(
      grid, [&](auto state) { return intrusion(game, state); }, threads);
  levelset::Solver<Real> solver(grid, levelset::own_flow<Real>(grid, game), h,
                                {.tube = levelset::Tube::tube, .threads = threads});
  Air3dRun<Real> run;
  const Clock::Time start = clock.now();
  for (; solver.time() < horizon; ++run.steps) {
    if (const auto taken = solver.step(horizon); !taken.has_value()) {
      return taken.error();
    }
  }
  run.seconds = to_seconds(clock.now() - start);
  run.values.assign(solver.values().begin(), solver.values().end());
  return run;
}

/// What hj_reachability has found, in doubles.
Result<json> air3d_reference(const fs::path& root, const AirGrid& size) {
  const fs::path path = root / "data" / "reference" / "air3d_hj_reachability.json";
  const auto text = read_file(path);
  if (!text.has_value()) {
    return text.error();
  }
  const auto read = formats::parse_json(text.value());
  const json all = read.has_value() ? read.value() : json();
  const json points{size.x, size.y, size.heading};
  for (const json& one : all.is_object() ? all.value("solutions", json::array()) : json()) {
    if (one.is_object() && one.value("points", json()) == points &&
        one.value("precision", "") == "double") {
      return one;
    }
  }
  return Error{Error::Code::malformed,
               fmt::format("{}: want a solution of {} points in doubles, got none", path.string(),
                           points.dump())};
}

template <class Real>
std::optional<Error> bench_one_air3d(const AirGrid& size, const json& reference, int repeats,
                                     const Clock& clock, json& figures) {
  const std::string name = fmt::format("{}x{}x{}", size.x, size.y, size.heading);
  const std::string after = sizeof(Real) == sizeof(double) ? ".double" : "";
  const danger::Grid grid = levelset::air3d_grid(size.x, size.y, size.heading);
  for (const int threads : {1, usual_threads()}) {
    note_progress(fmt::format("air3D {}, {}, threads: {}", name, after.empty() ? "float" : "double",
                              threads));
    double seconds = std::numeric_limits<double>::infinity();
    for (int repeat = 0; repeat < repeats; ++repeat) {
      const auto run = air3d_run<Real>(grid, threads, clock);
      if (!run.has_value()) {
        return run.error();
      }
      const std::vector<Real>& values = run.value().values;
      seconds = std::min(seconds, run.value().seconds);
      const double work = static_cast<double>(values.size()) * run.value().steps * air3d_stages;
      const auto figure = [&](const char* what, const std::string& by) -> json& {
        return figures[fmt::format("reach.air3d_{}.{}{}", name, what, by)];
      };
      const std::string by = fmt::format(".t{}{}", threads, after);
      figure("seconds", by) = seconds;
      figure("ns_per_point_stage", by) = 1e9 * seconds / work;
      const auto error = [&](double came, const char* key) {
        const double wanted = reference.at(key).get<double>();
        return std::abs(came - wanted) / std::abs(wanted);
      };
      const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
      figure("volume_error", after) =
          error(levelset::tube_volume<Real>(grid, values), "tube_volume_m2_rad");
      figure("least_value_error", after) = error(static_cast<double>(*least), "least_value_m");
      figure("greatest_value_error", after) =
          error(static_cast<double>(*greatest), "greatest_value_m");
    }
  }
  return std::nullopt;
}

std::optional<Error> bench_air3d_on(const AirGrid& size, int repeats, const fs::path& root,
                                    const Clock& clock, json& figures) {
  const auto reference = air3d_reference(root, size);
  if (!reference.has_value()) {
    return reference.error();
  }
  if (auto problem = bench_one_air3d<float>(size, reference.value(), repeats, clock, figures)) {
    return problem;
  }
  return bench_one_air3d<double>(size, reference.value(), repeats, clock, figures);
}

// --- memory --------------------------------------------------------------------------------------

/// A line of /proc/self/status, in MiB; 0 where the system has none.
double own_memory(const std::string& wanted) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind(wanted + ":", 0) == 0) {
      return std::stod(line.substr(wanted.size() + 1)) / 1024.0;
    }
  }
  return 0.0;
}

/// From here on VmHWM is the peak since now, where the system lets us.
void forget_peak() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

/// Bytes per second that all threads move together: a = b + s c on arrays that no cache holds, two
/// read and one written (as STREAM counts them); the best of a few runs.
double memory_speed(int threads, const Clock& clock) {
  constexpr std::size_t size = std::size_t{1} << 25;  // 128 MiB each
  constexpr std::size_t parts = 64;
  std::vector<float> a(size, 0.0F), b(size, 1.0F), c(size, 2.0F);
  double best = 0.0;
  for (int run = 0; run < 6; ++run) {
    const Clock::Time start = clock.now();
    in_parallel(parts, threads, [&](std::size_t part) {
      float* const to = a.data();
      const float* const left = b.data();
      const float* const right = c.data();
      for (std::size_t i = size / parts * part; i < size / parts * (part + 1); ++i) {
        to[i] = left[i] + 3.0F * right[i];
      }
    });
    const double seconds = to_seconds(clock.now() - start);
    best = std::max(best, 3.0 * sizeof(float) * static_cast<double>(size) / seconds);
    std::swap(a, b);  // what was written is read: nothing is left out
  }
  return best;
}

// --- the avoidance problem -----------------------------------------------------------------------

/// Two stages, as in the tables of `saca run`.
constexpr int avoid4d_stages = 2;
constexpr double avoid4d_cfl = 0.9;

/// What a step must move of each point: values and h in and values out, and in its second stage
/// what it began with; neighbours are taken to be in a cache.
constexpr double numbers_per_stage = (3.0 + 4.0) / avoid4d_stages;

Result<danger::AvoidanceCase> parked_car_with_more_points(const fs::path& root) {
  auto found = danger::read_avoidance_case(root / "data" / "reach" / "parked_car.toml");
  if (!found.has_value()) {
    return found.error();
  }
  danger::AvoidanceCase parked = std::move(found).value();
  parked.times = {4.0};
  parked.system.grip = dry_grip;
  constexpr std::array points{60, 26, 48, 28};  // 2.1 million
  for (std::size_t d = 0; d < points.size(); ++d) {
    parked.grid.axes.at(d).points = points[d];
  }
  return parked;
}

/// @return  the solution
Result<danger::Solution> bench_avoid4d(const danger::AvoidanceCase& parked, const Clock& clock,
                                       json& figures) {
  const levelset::Problem problem = levelset::avoidance_problem(parked);
  const levelset::Scheme scheme{
      .steps = levelset::Steps::tvd_rk2, .cfl = avoid4d_cfl, .threads = usual_threads()};
  const auto points = static_cast<double>(num_cells(problem.grid));
  note_progress(fmt::format("a parked car in four dimensions, {:.0f} points", points));
  int steps = 0;
  Clock::Time first, last;  // ends of steps on the fine grid
  double told = 0.0, reached = 0.0;
  forget_peak();
  const double memory_before = own_memory("VmRSS");
  const Clock::Time start = clock.now();
  auto solved =
      levelset::solve(problem, scheme, std::nullopt, {.step = [&](double tau) {
                        if (tau > reached) {  // else: on half as many points, for the error
                          reached = tau;
                          last = clock.now();
                          first = steps++ == 0 ? last : first;
                        }
                        if (tau >= told + 1.0) {
                          told = tau;
                          note_progress(fmt::format("{:.1f} of {:g} s", tau, problem.times.back()));
                        }
                        return true;
                      }});
  figures["reach.avoid4d.seconds"] = to_seconds(clock.now() - start);
  const double peak = own_memory("VmHWM");
  if (!solved.has_value()) {
    return solved.error();
  }
  const double march = to_seconds(last - first);
  figures["reach.avoid4d.points"] = points;
  figures["reach.avoid4d.steps"] = steps;
  figures["reach.avoid4d.ns_per_point_stage"] =
      1e9 * march / (points * (steps - 1) * avoid4d_stages);
  figures["reach.avoid4d.peak_mib"] = peak;
  figures["reach.avoid4d.foretold_mib"] =
      static_cast<double>(memory_needed(problem, scheme)) / bytes_per_mib;
  figures["reach.avoid4d.bytes_per_point"] = (peak - memory_before) * bytes_per_mib / points;
  return solved;
}

void bench_roofline(const Clock& clock, json& figures) {
  note_progress("the memory's speed");
  const double speed = memory_speed(usual_threads(), clock);
  const double seconds = 1e-9 * figures.at("reach.avoid4d.ns_per_point_stage").get<double>();
  figures["reach.memory_gb_per_s"] = 1e-9 * speed;
  figures["reach.bytes_per_point_stage"] = numbers_per_stage * sizeof(float);
  figures["reach.roofline_share"] = numbers_per_stage * sizeof(float) / speed / seconds;
}

// --- look-ups ------------------------------------------------------------------------------------

/// Percentiles of one call [us], each the mean of a few: the clock itself takes a while.
template <class Call>
void bench_calls(const std::string& name, const Call& call, const Clock& clock, json& figures,
                 std::size_t num_samples = 20'000) {
  constexpr int calls_per_sample = 16;
  std::vector<double> times;
  times.reserve(num_samples);
  double sum = 0.0;  // so that no call is left out
  for (std::size_t i = 0; times.size() < num_samples;) {
    const Clock::Time start = clock.now();
    for (int k = 0; k < calls_per_sample; ++k) {
      sum += call(i++);
    }
    times.push_back(1e6 * to_seconds(clock.now() - start) / calls_per_sample);
  }
  figures[name + ".p50"] = percentile(times, 0.5);
  figures[name + ".p99"] = percentile(times, 0.99);
  if (!std::isfinite(sum)) {
    figures[name + ".p50"] = sum;  // shown: something is no number
  }
}

/// Every call somewhere else: what the memory takes is in it.
constexpr std::size_t num_look_ups = std::size_t{1} << 16;

void bench_look_up(const danger::Solution& solved, const Clock& clock, json& figures) {
  note_progress("look-ups");
  const danger::ValueTable table(solved.grid, snapshot(solved, 0), solved.error);
  std::mt19937 rng(1);
  std::vector<danger::State> states(num_look_ups);
  for (danger::State& state : states) {
    for (std::size_t d = 0; d < solved.grid.axes.size(); ++d) {
      const danger::Axis& axis = solved.grid.axes[d];
      const double first = axis.edge == danger::Edge::mirrored ? -axis.last : axis.first;
      state[d] = std::uniform_real_distribution<double>(first, axis.last)(rng);
    }
  }
  bench_calls(
      "reach.lookup_us", [&](std::size_t i) { return table.at(states[i % num_look_ups]).value; },
      clock, figures);
}

/// A car's two tables, at rest and at 5 m/s, as large as those of `saca run`; solved to 0.5 s only,
/// which the time of a look-up does not depend on.
Result<std::vector<danger::DangerTable>> two_tables(const danger::Avoidance& limits,
                                                    const world::Footprint& ego,
                                                    const world::Footprint& other) {
  std::vector<danger::DangerTable> tables;
  const std::array wanted{danger::ObstacleKind{other, 5.0}};
  const auto cases = danger::danger_cases(limits, ego, dry_grip, wanted);
  if (!cases.has_value()) {
    return cases.error();
  }
  for (const danger::DangerCase& one : cases.value()) {
    note_progress("a table of danger, " + one.name);
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
  return tables;
}

std::optional<Error> bench_risk(const manoeuvre::Car& car, const Clock& clock, json& figures) {
  const world::Footprint ego = manoeuvre::footprint(car);
  const world::Footprint other{.length = 4.5, .width = 1.8};
  const danger::Avoidance limits = danger::avoidance_of(car, dry_grip);
  auto tables = two_tables(limits, ego, other);
  if (!tables.has_value()) {
    return tables.error();
  }
  const danger::DangerModel model(limits, ego, std::move(tables).value());
  std::mt19937 rng(1);
  const auto any = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(rng);
  };
  std::vector<danger::Meeting> meetings;
  int exact = 0;
  for (std::size_t i = 0; i < num_look_ups; ++i) {
    meetings.push_back({.ego = ego, .obstacle = other, .grip = dry_grip});
    danger::Meeting& meeting = meetings.back();
    meeting.obstacle_speed = any(0.0, 5.0);
    meeting.state = {any(-50.0, 5.0), any(-10.0, 10.0), any(-0.5, 0.5), any(5.0, 28.0)};
    exact += model.danger(meeting).exact ? 1 : 0;
  }
  note_progress("dangers");
  // Apart, for one evasion that is driven pushes the tables out of the caches.
  const auto beyond = std::partition(meetings.begin(), meetings.end(), [&](const auto& meeting) {
    return model.exact(meeting).has_value();
  });
  const auto bench = [&](const std::string& name, std::span<const danger::Meeting> some,
                         std::size_t num_samples) {
    bench_calls(
        name, [&](std::size_t i) { return model.danger(some[i % some.size()]).value; }, clock,
        figures, num_samples);
  };
  bench("reach.risk_us", {meetings.begin(), beyond}, 20'000);
  bench("reach.risk_beyond_us", {beyond, meetings.end()}, 200);
  figures["reach.risk_us.exact_share"] = static_cast<double>(exact) / num_look_ups;
  return std::nullopt;
}

}  // namespace

std::optional<Error> bench_air3d(const fs::path& root, const Clock& clock, json& figures) {
  constexpr int repeats = 2;
  return bench_air3d_on(coarse_air, repeats, root, clock, figures);
}

std::optional<Error> bench_reach(const fs::path& root, const manoeuvre::Car& car,
                                 const Clock& clock, json& figures) {
  const auto parked = parked_car_with_more_points(root);
  if (!parked.has_value()) {
    return parked.error();
  }
  const auto solved = bench_avoid4d(parked.value(), clock, figures);
  if (!solved.has_value()) {
    return solved.error();
  }
  bench_roofline(clock, figures);
  bench_look_up(solved.value(), clock, figures);
  if (auto problem = bench_risk(car, clock, figures)) {
    return problem;
  }
  if (auto problem = bench_air3d(root, clock, figures)) {
    return problem;
  }
  return bench_air3d_on(fine_air, 1, root, clock, figures);
}

}  // namespace saca::app
