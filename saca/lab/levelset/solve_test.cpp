#include "saca/lab/levelset/solve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "saca/base/core/contract.h"
#include "saca/lab/levelset/own_systems.h"
#include "saca/lab/verification/known_systems.h"
#include "saca/thinking/danger/danger_cases.h"
#include "saca/thinking/danger/march_for_test.h"

namespace saca::levelset::solve_test {
namespace {

/// Braking before a wall at 0, whose value is known: x + v^2 / 2 for v >= 0.
Problem braking(int points) {
  Problem problem;
  problem.text = "system = \"brake\"\n";
  problem.grid.axes = {{.name = "x", .first = -6.0, .last = 2.0, .points = points},
                       {.name = "v", .first = -2.0, .last = 3.0, .points = points}};
  problem.times = {1.0, 2.0, 4.0};
  problem.unsafe = [](std::span<const double> x) { return x[0]; };
  problem.in_floats = [](const danger::Grid& grid, Differences differences) {
    return verification::known_flow<float>(grid, verification::DoubleIntegrator{1.0}, differences);
  };
  problem.in_doubles = [](const danger::Grid& grid, Differences differences) {
    return verification::known_flow<double>(grid, verification::DoubleIntegrator{1.0}, differences);
  };
  return problem;
}

TEST(Solve, KeepsEachTimeAndKnowsItsError) {
  const Problem problem = braking(41);
  const auto solved = solve(problem, {.doubles = true}, std::nullopt, {});
  ASSERT_TRUE(solved.has_value());
  EXPECT_TRUE(solved.value().complete);
  EXPECT_EQ(solved.value().times, problem.times);
  EXPECT_TRUE(solved.value().doubles());
  const auto values = danger::snapshot(solved.value(), 2);
  std::size_t covered = 0;
  std::size_t asked = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const danger::State x = danger::state_at(problem.grid, i);
    const double expected = x[0] + 0.5 * std::max(0.0, x[1]) * std::max(0.0, x[1]);
    if (expected < 1.0 && x[0] > -5.0) {
      ++asked;
      const double wrong = std::abs(static_cast<double>(values[i]) - expected);
      if (wrong <= static_cast<double>(solved.value().error[i]) + 1e-4) {
        ++covered;
      }
    }
  }
  EXPECT_GT(static_cast<double>(covered), 0.9 * static_cast<double>(asked));
}

TEST(Solve, StoppedAndGoneOnWithItIsTheSame) {
  const Problem problem = braking(31);
  const auto whole = solve(problem, {}, std::nullopt, {});
  ASSERT_TRUE(whole.has_value());
  for (const double stop : {0.3, 1.0, 1.7, 3.9}) {
    std::optional<danger::Solution> kept;
    const Onlooker impatient{.step = [&](double tau) { return tau < stop; },
                             .keep =
                                 [&](const danger::Solution& so_far) {
                                   kept = so_far;
                                   return std::optional<Error>();
                                 }};
    const auto part = solve(problem, {}, std::nullopt, impatient);
    ASSERT_TRUE(part.has_value());
    EXPECT_FALSE(part.value().complete);
    ASSERT_TRUE(kept);
    const auto rest = solve(problem, {}, kept, {});
    ASSERT_TRUE(rest.has_value());
    EXPECT_TRUE(rest.value().complete);
    EXPECT_EQ(rest.value().times, whole.value().times);
    EXPECT_EQ(rest.value().values, whole.value().values);
    EXPECT_EQ(rest.value().error, whole.value().error);
  }
}

TEST(Solve, RefusesToGoOnWithSomethingElse) {
  const Problem problem = braking(21);
  const auto solved = solve(problem, {}, std::nullopt, {});
  ASSERT_TRUE(solved.has_value());
  Problem other = problem;
  other.text += "# another\n";
  const auto refused = solve(other, {}, solved.value(), {});
  ASSERT_FALSE(refused.has_value());
  EXPECT_THAT(refused.error().message, testing::HasSubstr("another problem"));
  Problem backwards = problem;
  backwards.times = {-1.0};
  EXPECT_THROW((void)solve(backwards, {}, std::nullopt, {}), ContractViolation);
  backwards.times = {2.0, 1.0};
  EXPECT_THROW((void)solve(backwards, {}, std::nullopt, {}), ContractViolation);
}

/// Braking as it is kept when stopped after 1.5 of 4 s.
danger::Solution stopped(const Problem& problem, const Scheme& scheme) {
  danger::Solution kept;
  const auto part = solve(problem, scheme, std::nullopt,
                          {.step = [](double tau) { return tau < 1.5; },
                           .keep =
                               [&](const danger::Solution& so_far) {
                                 kept = so_far;
                                 return std::optional<Error>();
                               }});
  EXPECT_TRUE(part.has_value());
  return kept;
}

std::string refusal(const Problem& problem, const Scheme& scheme, const danger::Solution& begun) {
  const auto solved = solve(problem, scheme, begun, {});
  return solved.has_value() ? "" : solved.error().message;
}

TEST(Solve, RefusesToGoOnByAnotherScheme) {
  const Problem problem = braking(21);
  const danger::Solution begun = stopped(problem, {});
  EXPECT_EQ(refusal(problem, {.threads = 2, .with_error = false}, begun), "");
  const auto by = [](const std::string& wanted) {
    return "it was begun by weno5, rk3, cfl 0.75, floats, solver 1, wanted " + wanted;
  };
  EXPECT_EQ(refusal(problem, {.differences = Differences::upwind1}, begun),
            by("upwind1, rk3, cfl 0.75, floats, solver 1"));
  EXPECT_EQ(refusal(problem, {.differences = Differences::eno2, .steps = Steps::tvd_rk2}, begun),
            by("eno2, rk2, cfl 0.75, floats, solver 1"));
  EXPECT_EQ(refusal(problem, {.differences = Differences::eno3, .steps = Steps::euler}, begun),
            by("eno3, euler, cfl 0.75, floats, solver 1"));
  EXPECT_EQ(refusal(problem, {.cfl = 0.8}, begun), by("weno5, rk3, cfl 0.8, floats, solver 1"));
  EXPECT_EQ(refusal(problem, {.doubles = true}, begun),
            by("weno5, rk3, cfl 0.75, doubles, solver 1"));
  danger::Solution untold = begun;
  untold.scheme.clear();
  EXPECT_THAT(refusal(problem, {}, untold),
              testing::HasSubstr("begun by a scheme that is not told"));
}

TEST(Solve, RefusesToGoOnOnAnotherGrid) {
  const danger::Solution begun = stopped(braking(21), {});
  EXPECT_EQ(refusal(braking(31), {}, begun),
            "it was begun on another grid: with x in [-6, 2], 21 points, open, stretch 0, wanted x "
            "in [-6, 2], 31 points, open, stretch 0");
  Problem other = braking(21);
  other.grid.axes[1].last = 3.5;  // as many cells
  EXPECT_THAT(refusal(other, {}, begun), testing::HasSubstr("v in [-2, 3], 21 points"));
  other = braking(21);
  other.grid.axes.pop_back();
  EXPECT_THAT(refusal(other, {}, begun), testing::HasSubstr("2 axes, wanted 1"));
  danger::Solution damaged = begun;
  std::get<danger::Snapshots<float>>(damaged.values).back().pop_back();
  EXPECT_THAT(refusal(braking(21), {}, damaged), testing::HasSubstr("one value per time and cell"));
}

TEST(Solve, RefusesToGoOnToOtherTimes) {
  const Problem problem = braking(21);
  const danger::Solution begun = stopped(problem, {});
  ASSERT_EQ(begun.times.size(), 2U);  // 1 s, and where it was stopped
  const auto asked_for = [&](std::vector<double> times, const danger::Solution& from) {
    Problem other = problem;
    other.times = std::move(times);
    return refusal(other, {}, from);
  };
  EXPECT_EQ(asked_for({1.0, 2.5, 3.0}, begun), "");
  EXPECT_THAT(asked_for({0.5, 2.0, 4.0}, begun), testing::HasSubstr("snapshots at 1, 1.5"));
  EXPECT_THAT(asked_for({1.0, 1.2, 4.0}, begun), testing::HasSubstr("wanted 1, 1.2, 4 s"));
  EXPECT_THAT(asked_for({1.0}, begun), testing::HasSubstr("wanted 1 s"));
  const auto whole = solve(problem, {}, std::nullopt, {});
  ASSERT_TRUE(whole.has_value());
  EXPECT_THAT(asked_for({1.0, 2.0}, whole.value()),
              testing::HasSubstr("at 1, 2, 4 s, wanted 1, 2 s"));
}

// What is complete for fewer times is gone on with, and its error is that of the new end.
TEST(Solve, GoesOnBeyondWhatWasItsEnd) {
  const Problem problem = braking(31);
  Problem shorter = problem;
  shorter.times.pop_back();
  const auto begun = solve(shorter, {}, std::nullopt, {});
  ASSERT_TRUE(begun.has_value());
  const auto rest = solve(problem, {}, begun.value(), {});
  const auto whole = solve(problem, {}, std::nullopt, {});
  ASSERT_TRUE(rest.has_value() && whole.has_value());
  EXPECT_TRUE(rest.value().complete);
  EXPECT_EQ(rest.value().times, problem.times);
  EXPECT_EQ(rest.value().values, whole.value().values);
  EXPECT_EQ(rest.value().error, whole.value().error);
}

TEST(Solve, FindsAnErrorThatWasNotAskedForBefore) {
  const Problem problem = braking(21);
  const auto without = solve(problem, {.with_error = false}, std::nullopt, {});
  ASSERT_TRUE(without.has_value());
  EXPECT_TRUE(without.value().complete);
  EXPECT_TRUE(without.value().error.empty());
  const auto with = solve(problem, {}, without.value(), {});
  const auto whole = solve(problem, {}, std::nullopt, {});
  ASSERT_TRUE(with.has_value() && whole.has_value());
  EXPECT_EQ(with.value().error, whole.value().error);
}

// Whoever brakes straight on from the table's 30 m/s stands after 30 / (0.9 g) = 3.4 s. Beside what
// rests nothing happens to a standing car: from then on a value rises only where swerving was best
// and is to go on for longer. Before, an obstacle ahead comes nearer at up to 30 m/s.
TEST(Solve, BesideAnObstacleAtRestFourSecondsAreEnough) {
  const danger::Avoidance car;
  const std::vector<danger::ObstacleKind> parked{
      {.obstacle = {.shape = world::Shape::box, .length = 4.8, .width = 1.9}, .top_speed = 0.0}};
  const auto cases = danger::danger_cases(car, parked[0].obstacle, car.grip, parked).value();
  ASSERT_EQ(cases.size(), 1U);
  danger::AvoidanceCase asked = cases[0].asked;
  const double top_speed = asked.grid.axes[3].last;
  EXPECT_LT(top_speed / (car.grip * 9.81), asked.times.back());
  for (danger::Axis& axis : asked.grid.axes) {
    axis.points = (axis.points + 1) / 2;
  }
  Solver<float> solver(asked.grid,
                       own_flow<float>(asked.grid, danger::AvoidanceAhead{asked.system}),
                       danger::unsafe<float>(asked, 1), {.steps = Steps::tvd_rk2, .cfl = 0.9});
  danger::march(solver, 1.0);
  EXPECT_GT(solver.greatest_rate(), 0.5 * top_speed);
  danger::march(solver, asked.times.back());
  EXPECT_LT(solver.greatest_rate(), 0.01 * top_speed);
}

TEST(Solve, HandsOnWhatKeepHadToSay) {
  const auto failed = solve(braking(21), {}, std::nullopt, {.keep = [](const danger::Solution&) {
                              return std::optional(Error{Error::Code::unwritable, "disk full"});
                            }});
  ASSERT_FALSE(failed.has_value());
  EXPECT_EQ(failed.error().message, "disk full");
}

TEST(MemoryNeeded, OfAProblemCountsItsSnapshots) {
  const Problem problem = braking(101);
  const std::size_t cells = 101 * 101;
  EXPECT_GE(memory_needed(problem, {}), (4 + 3) * cells * 4);
}

}  // namespace
}  // namespace saca::levelset::solve_test
