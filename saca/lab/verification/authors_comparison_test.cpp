#include "saca/lab/verification/authors_comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "saca/thinking/danger/obstacle_frame.h"

namespace saca::verification::authors_comparison_test {
namespace {

/// A network whose value is offset + slope x (x + 50) / 50, where that is right of 0 and x > -50.
AuthorsNetwork along_x(double slope, double offset) {
  const std::map<std::string, NpyArray> arrays{
      {"MLP_0_Dense_0_kernel", {{4, 1}, {1.0, 0.0, 0.0, 0.0}}},
      {"MLP_0_Dense_0_bias", {{1}, {0.0}}},
      {"MLP_0_Dense_1_kernel", {{1, 1}, {1.0}}},
      {"MLP_0_Dense_1_bias", {{1}, {0.0}}},
      {"OutputVDense_kernel", {{1, 1}, {slope}}},
      {"OutputVDense_bias", {{1}, {offset}}}};
  return AuthorsNetwork::from(arrays, "made here").value();
}

danger::ValueAt solved_as(const std::function<double(std::span<const double>)>& value,
                          double x_first = -60.0, double speed_last = 20.0) {
  const double pi = std::numbers::pi;
  const danger::Grid grid{
      {{.name = "x", .first = x_first, .last = 20.0, .points = 41},
       {.name = "y", .first = -10.0, .last = 10.0, .points = 5},
       {.name = "course", .first = -pi, .last = pi, .points = 8, .edge = danger::Edge::periodic},
       {.name = "speed", .first = 0.0, .last = speed_last, .points = 5}}};
  return [table = danger::ValueTable(grid, danger::sampled<float>(grid, value, 1))](
             const danger::State& state) { return table.at(state); };
}

constexpr std::size_t places = 17 * 17;          // y and yaw
constexpr std::size_t each_speed = 51 * places;  // and x

TEST(Agreement, CountsBecomeShares) {
  const Agreement counts{.states = 100, .unsafe = 40, .false_safe = 10, .false_alarm = 15};
  EXPECT_DOUBLE_EQ(counts.sign_agreement(), 0.75);
  EXPECT_DOUBLE_EQ(counts.false_safe_share(), 0.25);
  EXPECT_DOUBLE_EQ(counts.false_alarm_share(), 0.25);
  EXPECT_EQ(Agreement{}.sign_agreement(), 1.0);
  EXPECT_EQ(Agreement{}.false_safe_share(), 0.0);
}

// Solved: unsafe from x = -10.5 m on. Network: from x = -20.5 m on.
TEST(CompareWithAuthors, TooCarefulANetworkGivesFalseAlarms) {
  const auto found =
      compare_with_authors(solved_as([](auto x) { return x[0] + 10.5; }), along_x(50.0, -29.5));
  const Agreement& all = found.all;
  EXPECT_EQ(all.states, 19 * each_speed);
  EXPECT_EQ(all.unsafe, 19 * 11 * places);  // x = -10 ... 0 m
  EXPECT_EQ(all.false_safe, 0U);
  EXPECT_EQ(all.false_alarm, 19 * 10 * places);  // x = -20 ... -11 m
  EXPECT_EQ(found.outside, 0U);
}

TEST(CompareWithAuthors, TooCarelessANetworkIsFalselySafe) {
  const auto found =
      compare_with_authors(solved_as([](auto x) { return x[0] + 20.5; }), along_x(50.0, -39.5));
  EXPECT_EQ(found.all.false_safe, 19 * 10 * places);
  EXPECT_EQ(found.all.false_alarm, 0U);
}

TEST(CompareWithAuthors, SpeedsAreToldApart) {  // solved: unsafe from 9.5 m/s on; network: never
  const auto found =
      compare_with_authors(solved_as([](auto x) { return x[3] - 9.5; }), along_x(0.0, -2.0));
  ASSERT_EQ(found.by_speed.size(), 19U);
  for (const auto& one : found.by_speed) {
    EXPECT_EQ(one.agreement.states, each_speed);
    EXPECT_EQ(one.agreement.false_safe, one.speed > 9.5 ? each_speed : 0U) << one.speed;
    EXPECT_NEAR(one.mean_solved, one.speed - 9.5, 1e-4);
    EXPECT_NEAR(one.mean_network, -2.0, 1e-5);
  }
}

TEST(CompareWithAuthors, AValueSeenFromTheEgoIsHeldToTheSameStates) {
  const double pi = std::numbers::pi;
  const danger::Grid grid{
      {{.name = "ahead", .first = -60.0, .last = 60.0, .points = 121},
       {.name = "left",
        .first = 0.0,
        .last = 60.0,
        .points = 61,
        .edge = danger::Edge::mirrored,
        .turned = 2},
       {.name = "turned", .first = -pi, .last = pi, .points = 8, .edge = danger::Edge::periodic},
       {.name = "speed", .first = 0.0, .last = 20.0, .points = 4}}};
  const danger::ValueTable table(
      grid, danger::sampled<float>(
                grid, [](auto s) { return 10.25 - std::hypot(s[0], s[1]); }, 1));
  const AuthorsComparison found =
      compare_with_authors(danger::in_obstacle_frame(table, danger::View::ego), along_x(0.0, -2.0));
  std::size_t within = 0;
  for (int x = -50; x <= 0; ++x) {
    for (int y = -8; y <= 8; ++y) {
      within += std::hypot(x, y) < 10.25 ? 1U : 0U;  // the nearest: 10.20 and 10.30 m
    }
  }
  EXPECT_EQ(found.outside, 0U);
  EXPECT_EQ(found.all.states, 19 * each_speed);
  EXPECT_EQ(found.all.unsafe, 19 * 17 * within);
  EXPECT_EQ(found.all.false_safe, found.all.unsafe);
}

TEST(CompareWithAuthors, WhatTheTableDoesNotHoldIsLeftOutAndCounted) {
  const auto found =
      compare_with_authors(solved_as([](auto) { return -1.0; }, -40.0, 10.0), along_x(0.0, -2.0));
  EXPECT_EQ(found.all.states, 11 * 41 * places);
  EXPECT_EQ(found.outside, 19 * each_speed - 11 * 41 * places);
  EXPECT_EQ(found.by_speed.size(), 11U);
}

}  // namespace
}  // namespace saca::verification::authors_comparison_test
