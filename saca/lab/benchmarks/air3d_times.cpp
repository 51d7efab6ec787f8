#include "saca/lab/benchmarks/air3d_times.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "saca/base/core/file.h"
#include "saca/base/core/parallel.h"
#include "saca/base/formats/json_text.h"
#include "saca/lab/levelset/air3d.h"
#include "saca/lab/levelset/own_systems.h"
#include "saca/lab/levelset/solver.h"
#include "saca/thinking/danger/grid.h"

namespace saca::benchmarks {
namespace {

using nlohmann::json;

constexpr int game_stages = 3;  // of a step

/// One solution of the game, and how long it took.
template <class Real>
struct GameRun {
  double seconds = 0.0;
  int steps = 0;
  std::vector<Real> values;
};

template <class Real>
Result<GameRun<Real>> game_run(const danger::Grid& grid, int threads, const Clock& clock) {
  constexpr double horizon = 2.8;
  const levelset::Air3d game;
  const auto h = danger::sampled<Real>(
      grid, [&](auto state) { return intrusion(game, state); }, threads);
  levelset::Solver<Real> solver(grid, levelset::own_flow<Real>(grid, game), h,
                                {.tube = levelset::Tube::tube, .threads = threads});
  GameRun<Real> run;
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

/// By how much the values differ from the reference, as shares of it.
template <class Real>
json errors_json(const std::string& place, const std::string& after, const danger::Grid& grid,
                 const std::vector<Real>& values, const json& reference) {
  const auto error = [&](double came, const char* key) {
    const double wanted = reference.at(key).get<double>();
    return std::abs(came - wanted) / std::abs(wanted);
  };
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  return {
      {place + "volume_error" + after,
       error(levelset::tube_volume<Real>(grid, values), "tube_volume_m2_rad")},
      {place + "least_value_error" + after, error(static_cast<double>(*least), "least_value_m")},
      {place + "greatest_value_error" + after,
       error(static_cast<double>(*greatest), "greatest_value_m")}};
}

template <class Real>
Result<json> times_in(const GameGrid& size, const json& reference, int repeats, const Clock& clock,
                      const Note& note) {
  const std::string name = fmt::format("{}x{}x{}", size.x, size.y, size.heading);
  const std::string place = fmt::format("reach.air3d_{}.", name);
  const std::string after = sizeof(Real) == sizeof(double) ? ".double" : "";
  const danger::Grid grid = levelset::air3d_grid(size.x, size.y, size.heading);
  json figures;
  for (const int threads : {1, usual_threads()}) {
    note(fmt::format("air3D {}, {}, threads: {}", name, after.empty() ? "float" : "double",
                     threads));
    double seconds = std::numeric_limits<double>::infinity();
    for (int repeat = 0; repeat < repeats; ++repeat) {
      const auto run = game_run<Real>(grid, threads, clock);
      if (!run.has_value()) {
        return run.error();
      }
      const std::vector<Real>& values = run.value().values;
      seconds = std::min(seconds, run.value().seconds);
      const double work = static_cast<double>(values.size()) * run.value().steps * game_stages;
      const std::string by = fmt::format(".t{}{}", threads, after);
      figures[fmt::format("{}seconds{}", place, by)] = seconds;
      figures[fmt::format("{}ns_per_point_stage{}", place, by)] = 1e9 * seconds / work;
      figures.update(errors_json(place, after, grid, values, reference));
    }
  }
  return figures;
}

}  // namespace

Result<json> air3d_reference(const std::filesystem::path& file, const GameGrid& size) {
  const auto text = read_file(file);
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
               fmt::format("{}: want a solution of {} points in doubles, got none", file.string(),
                           points.dump())};
}

Result<json> air3d_times(const GameGrid& size, const json& reference, int repeats,
                         const Clock& clock, const Note& note) {
  auto in_floats = times_in<float>(size, reference, repeats, clock, note);
  if (!in_floats.has_value()) {
    return in_floats;
  }
  auto in_doubles = times_in<double>(size, reference, repeats, clock, note);
  if (!in_doubles.has_value()) {
    return in_doubles;
  }
  json figures = std::move(in_floats).value();
  figures.update(in_doubles.value());
  return figures;
}

}  // namespace saca::benchmarks
