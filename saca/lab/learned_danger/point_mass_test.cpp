#include "saca/lab/learned_danger/point_mass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "saca/lab/learned_danger/disc_for_test.h"
#include "saca/lab/learned_danger/experience.h"

namespace saca::learned_danger::point_mass_test {
namespace {

const DiscBeforeDisc discs;

/// Poses on the way are 20 ms apart: between two of them discs may come this much nearer [m].
double seen_too_far(double exact) {
  const double half_a_step = 0.5 * 0.02 * 30.0;
  const double distance = DiscBeforeDisc::touching - exact;
  return std::hypot(distance, half_a_step) - distance;
}

TEST(PointMass, IsSeenFromTheEgo) {
  const SeenByNet seen = seen_by_net(discs.problem, {-12.0, 3.0, 0.0, 16.0});
  EXPECT_NEAR(seen.h, 2.5 - std::hypot(12.0, 3.0), 1e-5);
  EXPECT_NEAR(seen.inputs[0], 0.8, 1e-6);
  EXPECT_NEAR(seen.inputs[9], 12.0 / 30.0, 1e-6);
  EXPECT_NEAR(seen.inputs[10], -3.0 / 15.0, 1e-6);
  EXPECT_NEAR(discs.value(seen.inputs.data()), discs.value({-12.0, 3.0, 0.0, 16.0}), 1e-4);
}

TEST(PointMass, NoDriveIsBetterThanTheValueAndEvasionsComeNearIt) {
  const Transitions made = point_mass_transitions(discs.problem, discs.exact(), 600, 3);
  ASSERT_EQ(made.drives, 600U);
  EXPECT_GT(made.near, 200U);
  Experience all;
  add_experience(all, made, discs.problem.ego, world::Shape::ellipse);
  ASSERT_EQ(all.size(), made.size());
  std::size_t near = 0;
  std::size_t as_good = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double exact = discs.value(&all.inputs[all.row[i] * num_net_inputs]);
    ASSERT_GE(static_cast<double>(all.reached[i]),
              std::max(-15.0, exact) - seen_too_far(exact) - 0.001)
        << i;
    if (std::abs(exact) < 2.0) {
      ++near;
      as_good += static_cast<double>(all.reached[i]) < exact + 0.1 ? 1U : 0U;
    }
  }
  ASSERT_GT(near, 1'000U);
  EXPECT_GT(as_good, near / 5);
}

// Bellman's equation: V is what the best input leads to.
TEST(PointMass, OutcomesHoldTheBestInput) {
  const Outcomes all = point_mass_outcomes(discs.problem, discs.exact(), 500, 4);
  ASSERT_EQ(all.num_states(), 500U);
  ASSERT_EQ(all.next_states.size(), 500 * all.num_inputs * num_net_inputs);
  for (std::size_t i = 0; i < all.num_states(); ++i) {
    const double exact = discs.value(&all.states[i * num_net_inputs]);
    if (exact < -14.0) {
      continue;
    }
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t k = i * all.num_inputs; k < (i + 1) * all.num_inputs; ++k) {
      const double ahead = all.settled[k] > 0.5F
                               ? static_cast<double>(all.next_h[k])
                               : discs.value(&all.next_states[k * num_net_inputs]);
      best = std::min(best, std::max(static_cast<double>(all.h[k]), ahead));
    }
    EXPECT_NEAR(best, exact, seen_too_far(exact) + 0.001) << i;
  }
}

TEST(PointMass, ErrorsAreThoseOfTheValue) {
  const auto told = [](double off) {
    return [off](std::span<const danger::State> states) {
      std::vector<double> all;
      for (const danger::State& at : states) {
        all.push_back(discs.value(at) + off);
      }
      return all;
    };
  };
  const ValueErrors none = value_errors(discs.problem, discs.exact(), told(0.0), 30.0, 500, 5);
  EXPECT_EQ(none.states, 500U);
  EXPECT_EQ(none.mean_size, 0.0);
  EXPECT_NEAR(none.same_sign, 1.0, 1e-9);
  const ValueErrors less = value_errors(discs.problem, discs.exact(), told(-0.5), 30.0, 500, 5);
  EXPECT_NEAR(less.mean_size, 0.5, 1e-9);
  EXPECT_NEAR(less.p99_size, 0.5, 1e-9);
  EXPECT_NEAR(less.bias, -0.5, 1e-9);
  EXPECT_LT(less.same_sign, 0.95);
  EXPECT_GT(less.same_sign, 0.7) << "a half metre of four";
}

TEST(PointMass, IsTheSeeds) {
  const auto made = [](std::uint64_t seed) {
    return point_mass_transitions(discs.problem, discs.exact(), 20, seed).observations;
  };
  EXPECT_EQ(made(1), made(1));
  EXPECT_NE(made(1), made(2));
}

}  // namespace
}  // namespace saca::learned_danger::point_mass_test
