#include "saca/reach/solve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "saca/core/contract.h"
#include "saca/reach/known_systems.h"

namespace saca::reach {
namespace {

/// Braking before a wall at 0, whose value is known: x + v^2 / 2 for v >= 0.
Problem braking(int points) {
  Problem problem;
  problem.text = "system = \"brake\"\n";
  problem.grid.axes = {{.name = "x", .first = -6.0, .last = 2.0, .points = points},
                       {.name = "v", .first = -2.0, .last = 3.0, .points = points}};
  problem.times = {1.0, 2.0, 4.0};
  problem.unsafe = [](std::span<const double> x) { return x[0]; };
  problem.in_floats = [](const Grid& grid, Differences differences) {
    return known_flow<float>(grid, DoubleIntegrator{1.0}, differences);
  };
  problem.in_doubles = [](const Grid& grid, Differences differences) {
    return known_flow<double>(grid, DoubleIntegrator{1.0}, differences);
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
  const auto values = snapshot(solved.value(), 2);
  std::size_t covered = 0;
  std::size_t asked = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const State x = state_at(problem.grid, i);
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
    std::optional<Solved> kept;
    const Onlooker impatient{.step = [&](double tau) { return tau < stop; },
                             .keep =
                                 [&](const Solved& so_far) {
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
  EXPECT_FALSE(solve(problem, {.doubles = true}, solved.value(), {}).has_value());
  Problem backwards = problem;
  backwards.times = {-1.0};
  EXPECT_THROW((void)solve(backwards, {}, std::nullopt, {}), ContractViolation);
  backwards.times = {2.0, 1.0};
  EXPECT_THROW((void)solve(backwards, {}, std::nullopt, {}), ContractViolation);
}

TEST(Solve, HandsOnWhatKeepHadToSay) {
  const auto failed = solve(braking(21), {}, std::nullopt, {.keep = [](const Solved&) {
                              return std::optional(Error{Error::Code::unwritable, "disk full"});
                            }});
  ASSERT_FALSE(failed.has_value());
  EXPECT_EQ(failed.error().message, "disk full");
}

TEST(MemoryNeeded, OfAProblemCountsItsSnapshots) {
  const Problem problem = braking(101);
  const std::size_t cells = 101 * 101;
  EXPECT_GE(memory_needed(problem, {}), (4 + 3) * cells * 4);
  EXPECT_GT(memory_needed(problem, {.doubles = true}), 2 * memory_needed(problem, {}) * 9 / 10);
}

}  // namespace
}  // namespace saca::reach
