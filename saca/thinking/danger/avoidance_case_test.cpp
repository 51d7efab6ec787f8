#include "saca/thinking/danger/avoidance_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "saca/lab/levelset/own_systems.h"
#include "saca/lab/levelset/solve.h"
#include "saca/thinking/danger/intrusion.h"
#include "saca/thinking/danger/march_for_test.h"

namespace saca::danger::avoidance_case_test {
namespace {

constexpr double pi = std::numbers::pi;

const std::string small_case = R"(schema = "saca.avoidance/1"
name = "small"
seen_from = "obstacle"
snapshots_s = [0.5, 2.0]
[car]
grip = 0.5
tightest_curvature_1pm = 0.2
drive_share = 0.4
[ego]
shape = "box"
length_m = 4.0
width_m = 2.0
centre_m = -0.2
[obstacle]
shape = "ellipse"
length_m = 7.0
width_m = 3.5
speed_mps = 3.0
[grid.x]
first_m = -20.0
last_m = 12.0
points = 9
stretch_m = 6.0
[grid.y]
last_m = 10.0
points = 6
[grid.course]
points = 8
[grid.speed]
last_mps = 12.0
points = 5
)";

std::string with(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

AvoidanceCase parsed(const std::string& text) {
  auto result = parse_avoidance_case(text, "small.toml");
  EXPECT_TRUE(result.has_value()) << (result.has_value() ? "" : result.error().message);
  return std::move(result).value();
}

/// A disc of radius 1 m beside a left edge: its value is known.
AvoidanceCase disc_at_edge(int refined) {
  std::string text = with(with(small_case, "seen_from = \"obstacle\"\n", ""),
                          "shape = \"ellipse\"\nlength_m = 7.0\nwidth_m = 3.5\nspeed_mps = 3.0",
                          "shape = \"left_edge\"");
  text = with(text, "shape = \"box\"\nlength_m = 4.0\nwidth_m = 2.0\ncentre_m = -0.2",
              "shape = \"ellipse\"\nlength_m = 2.0\nwidth_m = 2.0\ncentre_m = 0.0");
  text = with(text, "[grid.x]\nfirst_m = -20.0\nlast_m = 12.0\npoints = 9\nstretch_m = 6.0\n", "");
  text = with(text, "[grid.y]\n", "[grid.y]\nfirst_m = -20.0\n");
  AvoidanceCase problem = parsed(text);
  problem.grid.axes[0].points = 40 * refined + 1;
  problem.grid.axes[1].points = 36 * refined;
  problem.grid.axes[2].points = 8 * refined + 1;
  problem.grid.axes[2].last = 20.0;
  return problem;
}

template <class System>
std::vector<float> solved(const AvoidanceCase& problem, const System& system, double horizon) {
  return marched(problem.grid, levelset::own_flow<float>(problem.grid, system),
                 unsafe<float>(problem, 1), horizon);
}

TEST(AvoidanceCase, ReadsEveryKey) {
  const AvoidanceCase problem = parsed(small_case);
  EXPECT_EQ(problem.name, "small");
  EXPECT_EQ(problem.text, small_case);
  EXPECT_EQ(problem.view, View::obstacle);
  EXPECT_EQ(problem.times, (std::vector<double>{0.5, 2.0}));
  EXPECT_EQ(problem.system.grip, 0.5);
  EXPECT_EQ(problem.system.tightest_curvature, 0.2);
  EXPECT_EQ(problem.system.drive_share, 0.4);
  EXPECT_EQ(problem.system.obstacle_speed, 3.0);
  EXPECT_EQ(problem.ego.length, 4.0);
  EXPECT_EQ(problem.ego.width, 2.0);
  EXPECT_EQ(problem.ego.centre_x, -0.2);
  ASSERT_TRUE(problem.obstacle);
  EXPECT_EQ(problem.obstacle->shape, world::Shape::ellipse);
  EXPECT_EQ(problem.obstacle->length, 7.0);
  ASSERT_EQ(problem.grid.axes.size(), 4);
  EXPECT_EQ(problem.grid.axes[0].first, -20.0);
  EXPECT_EQ(problem.grid.axes[0].stretch, 6.0);
  EXPECT_EQ(problem.grid.axes[1].edge, Edge::mirrored);
  EXPECT_EQ(problem.grid.axes[1].turned, 2);
  EXPECT_EQ(problem.grid.axes[2].edge, Edge::periodic);
  EXPECT_EQ(problem.grid.axes[2].points, 8);
  EXPECT_EQ(problem.grid.axes[3].last, 12.0);
}

TEST(AvoidanceCase, RefusesWhatItDoesNotKnow) {
  const auto message = [](const std::string& from, const std::string& to) {
    const auto result = parse_avoidance_case(with(small_case, from, to), "small.toml");
    return result.has_value() ? std::string("accepted") : result.error().message;
  };
  using testing::AllOf;
  using testing::HasSubstr;
  EXPECT_THAT(message("grip = 0.5", "grip = 0.5\ngrop = 1.0"),
              AllOf(HasSubstr("small.toml:7"), HasSubstr("grop")));
  EXPECT_THAT(message("grip = 0.5", "grip = -0.5"),
              AllOf(HasSubstr("small.toml:6"), HasSubstr("grip")));
  EXPECT_THAT(message("drive_share = 0.4\n", ""), HasSubstr("drive_share"));
  EXPECT_THAT(message("\"ellipse\"", "\"blob\""), AllOf(HasSubstr("left_edge"), HasSubstr("blob")));
  EXPECT_THAT(message("\"box\"", "\"left_edge\""), HasSubstr("want box, ellipse, segment, got"));
  EXPECT_THAT(message("[0.5, 2.0]", "[]"), HasSubstr("snapshots_s"));
  EXPECT_THAT(message("\"obstacle\"", "\"moon\""), HasSubstr("want ego or obstacle, got moon"));
  EXPECT_THAT(message("\"obstacle\"", "\"ego\""), HasSubstr("ahead"));
  EXPECT_THAT(message("[0.5, 2.0]", "[2.0, 0.5]"), HasSubstr("rising"));
  EXPECT_THAT(message("last_m = 12.0", "last_m = -30.0"), HasSubstr("last_m"));
  EXPECT_THAT(message("points = 9", "points = 1"), HasSubstr("points"));
  EXPECT_THAT(message("avoidance/1", "avoidance/2"), HasSubstr("avoidance/2"));
  EXPECT_FALSE(read_avoidance_case("data/reach/no_such.toml").has_value());
}

TEST(AvoidanceCase, EveryFileOfTheDataCanBeRead) {
  std::set<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator("data/reach")) {
    const auto result = read_avoidance_case(file.path());
    ASSERT_TRUE(result.has_value()) << result.error().message;
    EXPECT_EQ(result.value().name, file.path().stem());
    EXPECT_LT(num_cells(result.value().grid), 2'500'000) << file.path();
    names.insert(result.value().name);
  }
  EXPECT_THAT(names, testing::IsSupersetOf({"parked_car", "paper_ellipse", "truck", "walker",
                                            "moving_car", "road_edge"}));
}

// The same bodies in the same place, whoever looks.
TEST(AvoidanceCase, BothViewsHaveTheSameIntrusion) {
  const AvoidanceCase problem = parsed(small_case);
  AvoidanceCase seen = problem;
  seen.view = View::ego;
  for (std::size_t i = 0; i < num_cells(problem.grid); i += 7) {
    const State state = state_at(problem.grid, i);
    EXPECT_NEAR(intrusion_at(seen, grid_state(View::ego, state)), intrusion_at(problem, state),
                1e-9);
  }
  EXPECT_EQ(grid_state(View::obstacle, {1.0, 2.0, 3.0, 4.0}), (State{1.0, 2.0, 3.0, 4.0}));
  EXPECT_EQ(grid_state(View::edge, {1.0, 2.0, 3.0, 4.0}), (State{2.0, 3.0, 4.0, 0.0}));
}

TEST(AvoidanceCase, UnsafeIsTheIntrusionAtEveryCell) {
  const AvoidanceCase problem = parsed(small_case);
  const auto h = unsafe<double>(problem, 1);
  ASSERT_EQ(h.size(), num_cells(problem.grid));
  for (std::size_t i = 0; i < h.size(); ++i) {
    const State state = state_at(problem.grid, i);
    EXPECT_EQ(h[i],
              intrusion(problem.ego, {{state[0], state[1]}, state[2]}, *problem.obstacle, {}));
  }
  const auto single = unsafe<float>(problem, 2);
  EXPECT_FLOAT_EQ(single[100], static_cast<float>(h[100]));
}

// Slowing down at full grip towards the road, along -y, is the shortest way out of the drift to the
// edge: a way of (v sin course)^2 / (2 grip g). Going along the edge at 5 m/s or more, its share
// across the course is below the curvature's limit, 0.2 x 5^2 = 5 m/s^2 > 0.5 g; and it never
// drives. A disc's reach does not depend on its course.
TEST(AvoidanceCase, ValueBesideAnEdgeIsThatOfTheClosedForm) {
  const auto worst_of = [](int refined) {
    const AvoidanceCase problem = disc_at_edge(refined);
    const auto values = solved(problem, EdgeAvoidance{problem.system}, 3.5);
    double worst = 0.0;
    double sum = 0.0;
    int compared = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const State state = state_at(problem.grid, i);
      const double onto = state[2] * std::max(0.0, std::sin(state[1]));
      const double expected = state[0] + 1.0 + onto * onto / (2.0 * 0.5 * 9.80665);
      if (state[2] * std::abs(std::cos(state[1])) < 5.0 || state[2] > 16.0 || expected > 3.0 ||
          state[0] < -16.0) {
        continue;
      }
      const double error = std::abs(static_cast<double>(values[i]) - expected);
      worst = std::max(worst, error);
      sum += error;
      ++compared;
    }
    EXPECT_GT(compared, 1'000);
    return std::pair(worst, sum / compared);
  };
  const auto [worst, mean] = worst_of(1);
  const auto [finer_worst, finer_mean] = worst_of(2);
  EXPECT_LT(finer_worst, 0.6 * worst);  // at least first order, at the kink where course is 0
  EXPECT_LT(finer_mean, 0.6 * mean);
  EXPECT_LT(finer_worst, 0.1);
}

// Scaling the speeds, and with them the time, leaves every number of the scheme the same, up to the
// rounding of floats: 1e-6 of 20 m, over some ten steps.
std::vector<float> solved_to(AvoidanceCase problem, double horizon,
                             const levelset::Scheme& scheme) {
  problem.times = {horizon};
  const auto result =
      levelset::solve(levelset::avoidance_problem(problem), scheme, std::nullopt, {});
  EXPECT_TRUE(result.has_value()) << (result.has_value() ? "" : result.error().message);
  return snapshot(result.value(), 0);
}

/// The small case seen from the ego.
AvoidanceCase small_case_seen() {
  std::string text = with(small_case, "\"obstacle\"", "\"ego\"");
  text = with(text, "grid.x", "grid.ahead");
  text = with(text, "first_m = -20.0\nlast_m = 12.0", "first_m = -12.0\nlast_m = 20.0");
  text = with(text, "grid.y", "grid.left");
  return parsed(with(text, "grid.course", "grid.turned"));
}

// First differences and Euler's equal steps are a monotone scheme, for which this holds exactly but
// for the open ends: values go on there with the last slope, which is no monotone rule. That, and
// steps that differ with the inputs, are worth 0.1 m of 20 m on this coarse grid.
TEST(AvoidanceCase, LongerHorizonsAndLessGripAreNeverSafer) {
  const levelset::Scheme monotone{.differences = levelset::Differences::upwind1,
                                  .steps = levelset::Steps::euler,
                                  .cfl = 0.9,
                                  .with_error = false};
  for (const AvoidanceCase& problem : {parsed(small_case), small_case_seen()}) {
    AvoidanceCase better = problem;
    better.system.grip = 0.8;
    AvoidanceCase wider = problem;
    wider.system.tightest_curvature = 0.3;
    wider.system.drive_share = 0.6;
    const auto h = unsafe<float>(problem, 1);
    const levelset::Flow<float> flow =
        levelset::avoidance_problem(problem).in_floats(problem.grid, monotone.differences);
    const double step = monotone.cfl / flow.crossings_per_second;
    const auto soon = solved_to(problem, 8 * step, monotone);
    const auto late = solved_to(problem, 24 * step, monotone);
    const auto late_better = solved_to(better, 24 * step, monotone);
    const auto late_wider = solved_to(wider, 24 * step, monotone);
    double gained = 0.0;
    for (std::size_t i = 0; i < h.size(); ++i) {
      EXPECT_LE(h[i], soon[i]);
      EXPECT_LE(soon[i], late[i] + 0.1F);
      EXPECT_LE(late_better[i], late[i] + 0.1F);
      EXPECT_LE(late_wider[i], late[i] + 0.1F);
      gained = std::max(gained, static_cast<double>(late[i] - late_better[i]));
    }
    EXPECT_GT(gained, 0.3);
  }
}

// The mirrored half and the whole are the same problem.
TEST(AvoidanceCase, LeftAndRightAreAlike) {
  for (const AvoidanceCase& half : {parsed(small_case), small_case_seen()}) {
    AvoidanceCase whole = half;
    Axis& across = whole.grid.axes[1];
    across.edge = Edge::open;
    across.turned = std::nullopt;
    across.first = -across.last;
    across.points = 2 * across.points - 1;
    const auto values = solved_to(half, 1.0, {.with_error = false});
    const auto all = solved_to(whole, 1.0, {.with_error = false});
    const int beyond = half.grid.axes[1].points - 1;  // points at y < 0
    for (std::size_t i = 0; i < values.size(); ++i) {
      Cell cell = cell_at(half.grid, i);
      cell[1] += beyond;
      const std::vector<std::size_t> stride = strides(whole.grid);
      std::size_t number = 0;
      for (std::size_t axis = 0; axis < stride.size(); ++axis) {
        number += stride[axis] * static_cast<std::size_t>(cell[axis]);
      }
      ASSERT_NEAR(values[i], all[number], 1e-4) << described(half.grid, state_at(half.grid, i));
    }
  }
}

TEST(AvoidanceCase, SolvedAtAnotherGripIsTheSameValueAtScaledSpeeds) {
  const AvoidanceCase problem = parsed(small_case);
  const auto values = solved(problem, problem.system, 1.0);
  AvoidanceCase other = problem;
  const ScaledAvoidance scaled = scaled_to(problem.system, 0.9);
  other.system = scaled.system;
  other.grid.axes[3].last *= scaled.speed_factor;
  const auto there = solved(other, other.system, scaled.time_factor);
  ASSERT_EQ(values.size(), there.size());
  double most_change = 0.0;
  const auto h = unsafe<float>(problem, 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_NEAR(values[i], there[i], 2e-4);
    most_change = std::max(most_change, std::abs(static_cast<double>(values[i] - h[i])));
  }
  EXPECT_GT(most_change, 1.0);  // there was something to compare
}

}  // namespace
}  // namespace saca::danger::avoidance_case_test
