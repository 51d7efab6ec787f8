#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "saca/base/core/file.h"
#include "saca/lab/levelset/own_systems.h"
#include "saca/thinking/danger/march_for_test.h"
#include "tests/support/levels.h"

/// The solver beside hj_reachability, which solved the same with the same differences, dissipation
/// and steps (tools/hj_reachability); what is left are its edges, its weights and rounding.
namespace saca::levelset::air3d_reference_test {
namespace {

using nlohmann::json;

const json& reference() {
  static const json all = [] {
    const auto text = read_file("data/reference/air3d_hj_reachability.json");
    return text.has_value() ? json::parse(text.value()) : json();
  }();
  return all;
}

struct Solution {
  danger::Grid grid;
  json wanted;
};

Solution solution(const std::string& precision, int x_points) {
  for (const json& one : reference().at("solutions")) {
    if (one.at("precision") == precision && one.at("points")[0] == x_points) {
      return {air3d_grid(one["points"][0], one["points"][1], one["points"][2]), one};
    }
  }
  ADD_FAILURE() << "no such solution";
  return {};
}

template <class Real>
std::vector<Real> start(const danger::Grid& grid, const Air3d& game = {}) {
  return danger::sampled<Real>(
      grid, [&](auto x) { return intrusion(game, x); }, 1);
}

template <class Real>
std::vector<Real> solved(const danger::Grid& grid, double horizon, const Settings& settings = {},
                         const Air3d& game = {}, SimdLevel level = best_level()) {
  return danger::marched(grid, own_flow<Real>(grid, game, Differences::weno5, level),
                         start<Real>(grid, game), horizon, settings);
}

struct Distance {
  double mean = 0.0, greatest = 0.0;  // [m]
};

template <class Real>
Distance distance(const std::vector<Real>& values, const json& cells) {
  Distance all;
  for (const json& cell : cells) {
    const double off =
        std::abs(static_cast<double>(values[cell[0].get<std::size_t>()]) - cell[1].get<double>());
    all.mean += off / static_cast<double>(cells.size());
    all.greatest = std::max(all.greatest, off);
  }
  return all;
}

template <class Real>
void expect_as_reference(const std::string& precision, int x_points, SimdLevel level) {
  const auto [grid, wanted] = solution(precision, x_points);
  const auto values = solved<Real>(grid, reference()["horizon_s"], {.tube = Tube::tube}, {}, level);
  const double volume = wanted["tube_volume_m2_rad"];
  EXPECT_NEAR(tube_volume<Real>(grid, values), volume, 1e-4 * volume);
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  EXPECT_NEAR(*least, wanted["least_value_m"], 0.01);  // in a corner, where edges count
  EXPECT_NEAR(*greatest, wanted["greatest_value_m"], 1e-3);
  const Distance off = distance(values, wanted["cells"]);
  EXPECT_EQ(wanted["cells"].size(), 300U);
  EXPECT_LT(off.mean, 0.001);  // spacings are 0.5 or 0.25 m
  EXPECT_LT(off.greatest, 0.02);
}

TEST(Air3dReference, StartIsCutToTheSameVolume) {
  for (const int x_points : {51, 101}) {
    const auto [grid, wanted] = solution("double", x_points);
    const double volume = wanted["start_volume_m2_rad"];
    EXPECT_NEAR(tube_volume<double>(grid, start<double>(grid)), volume, 1e-9 * volume);
  }
}

TEST(Air3dReference, FloatsGiveTheSameTube) {
  expect_as_reference<float>("float", 51, best_level());
}

// Takes minutes: `make soak` sets SACA_SOAK_AIR3D.
TEST(Air3dReference, FineGridsDoublesAndEachInstructionSetGiveTheSameTube) {
  if (std::getenv("SACA_SOAK_AIR3D") == nullptr) {
    GTEST_SKIP() << "SACA_SOAK_AIR3D is not set";
  }
  for (const int x_points : {51, 101}) {
    for (const SimdLevel level : test::those_here({SimdLevel::baseline, SimdLevel::avx2})) {
      expect_as_reference<float>("float", x_points, level);
      expect_as_reference<double>("double", x_points, level);
    }
  }
}

// V never below h and rates that only raise V are two ways to say the same (the paper's eq. 1).
TEST(Air3dReference, RunningMaximumGivesTheSameVolume) {
  const auto [grid, wanted] = solution("float", 51);
  const auto values = solved<float>(grid, reference()["horizon_s"], {.tube = Tube::highest});
  const double volume = wanted["tube_volume_m2_rad"];
  EXPECT_NEAR(tube_volume<float>(grid, values), volume, 0.003 * volume);
}

constexpr double short_horizon = 1.0;  // [s]
danger::Grid small_grid() {
  return air3d_grid(27, 21, 20);
}

TEST(Air3dSolved, LeftAndRightAreAlike) {
  const danger::Grid grid = small_grid();
  const auto values = solved<double>(grid, short_horizon);
  const int y_points = grid.axes[1].points;
  const int headings = grid.axes[2].points;
  const std::vector<std::size_t> stride = danger::strides(grid);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const danger::Cell cell = danger::cell_at(grid, i);
    const auto y = static_cast<std::size_t>(y_points - 1 - cell[1]);
    const auto heading = static_cast<std::size_t>((headings - cell[2]) % headings);
    const std::size_t mirrored =
        static_cast<std::size_t>(cell[0]) + y * stride[1] + heading * stride[2];
    ASSERT_NEAR(values[i], values[mirrored], 1e-9) << described(grid, danger::state_at(grid, i));
  }
}

/// How far a value of at most `about` in size falls at most between 0, 0.4, 0.8 and 1.2 s [m]; the
/// tube must grow each time.
double greatest_fall(int scale, Tube tube, double about) {
  const danger::Grid grid = air3d_grid(26 * scale + 1, 20 * scale + 1, 20 * scale);
  auto before = start<double>(grid);
  Solver<double> solver(grid, own_flow<double>(grid, Air3d{}), before, {.tube = tube});
  double fall = 0.0;
  for (const double horizon : {0.4, 0.8, 1.2}) {
    danger::march(solver, horizon);
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (std::abs(before[i]) <= about) {
        fall = std::max(fall, before[i] - solver.values()[i]);
      }
    }
    EXPECT_GT(tube_volume<double>(grid, solver.values()), tube_volume<double>(grid, before));
    before.assign(solver.values().begin(), solver.values().end());
  }
  return fall;
}

TEST(Air3dSolved, LongerHorizonNeverSavesAnybody) {
  constexpr double anywhere = 100.0;
  EXPECT_LT(greatest_fall(1, Tube::tube, anywhere), 1e-12);  // rounding
  // Beside a running maximum the grid's error may let values fall; about the tube's surface it goes
  // down with the spacing. More than 10 m from being caught values do fall, by up to 1.4 m on any
  // grid: they came in over the open ends, where what lies beyond is made up.
  const double coarse = greatest_fall(1, Tube::highest, 1.0);
  const double fine = greatest_fall(2, Tube::highest, 1.0);
  EXPECT_GT(coarse / fine, 1.5) << coarse << " m, " << fine << " m";
}

TEST(Air3dSolved, WhoMayTurnMoreGains) {
  const danger::Grid grid = small_grid();
  const auto volume = [&](double evader, double pursuer) {
    const Air3d game{.evader_turn_rate = evader, .pursuer_turn_rate = pursuer};
    return tube_volume<double>(grid, solved<double>(grid, 2.0, {}, game));
  };
  const double even = volume(1.0, 1.0);
  EXPECT_GT(volume(1.0, 1.2), even);
  EXPECT_GT(volume(0.8, 1.0), even);
  EXPECT_LT(volume(1.2, 1.0), even);
  EXPECT_LT(volume(1.0, 0.8), even);
}

// Without turns both drive straight on: V is minus the least distance on the way, less the radius.
double straight_on(const danger::State& s, double horizon) {
  const Air3d game;
  const double vx = game.pursuer_speed * std::cos(s[2]) - game.evader_speed;
  const double vy = game.pursuer_speed * std::sin(s[2]);
  const double speed2 = vx * vx + vy * vy;
  const double nearest = speed2 > 0.0 ? -(s[0] * vx + s[1] * vy) / speed2 : 0.0;
  const double t = std::clamp(nearest, 0.0, horizon);
  return game.capture_radius - std::hypot(s[0] + vx * t, s[1] + vy * t);
}

TEST(Air3dSolved, WithoutTurnsItIsTheClosestApproach) {
  const auto mean_error = [](int scale) {
    const danger::Grid grid = air3d_grid(26 * scale + 1, 20 * scale + 1, 8);
    const Air3d straight{.evader_turn_rate = 0.0, .pursuer_turn_rate = 0.0};
    const auto values = solved<double>(grid, 2.0, {}, straight);
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double exact = straight_on(danger::state_at(grid, i), 2.0);
      if (std::abs(exact) < 2.0) {  // about the tube's surface, away from edges
        sum += std::abs(values[i] - exact);
        ++count;
      }
    }
    return sum / count;
  };
  const double coarse = mean_error(1);
  const double fine = mean_error(3);
  EXPECT_LT(coarse, 0.1);  // spacing 1 m
  EXPECT_GT(std::log(coarse / fine) / std::log(3.0), 1.0);
}

}  // namespace
}  // namespace saca::levelset::air3d_reference_test
