#include "saca/lab/learned_danger/transitions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>

#include "saca/base/core/contract.h"
#include "saca/lab/learned_danger/networks_for_test.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/thinking/danger/car_limits.h"

namespace saca::learned_danger::transitions_test {
namespace {

const world::Footprint body{.length = 4.3, .width = 1.8, .centre_x = 0.1};

class TransitionsTest : public testing::Test {
 protected:
  [[nodiscard]] Transitions made(int drives, std::uint64_t seed,
                                 const Mixture& mixture = {}) const {
    return made_transitions(car_, body, model_, mixture, {drives, seed});
  }
  static double at(const std::vector<float>& rows, std::size_t row, std::size_t feature) {
    return rows[row * num_features + feature];
  }
  const manoeuvre::Car car_ = prepare::default_car();
  const danger::DangerModel model_{danger::avoidance_of(car_, 1.0), body, {}};
};

constexpr std::size_t v_x = 0;
constexpr std::size_t v_y = 1;
constexpr std::size_t second_is_there = num_ego_features + num_obstacle_features;
constexpr std::size_t obstacle_x = num_ego_features + 1;
constexpr std::size_t obstacle_y = num_ego_features + 2;

TEST_F(TransitionsTest, HaveARowForEach) {
  const Transitions all = made(6, 1);
  const std::size_t n = all.size();
  EXPECT_EQ(all.drives, 6U);
  EXPECT_EQ(all.situations, 60U);
  ASSERT_GT(n, 200U);
  EXPECT_EQ(all.observations.size(), n * num_features);
  EXPECT_EQ(all.next_observations.size(), n * num_features);
  EXPECT_EQ(all.actions.size(), 2 * n);
  for (const auto* one : {&all.next_h, &all.settled, &all.cut_off, &all.drive}) {
    EXPECT_EQ(one->size(), n);
  }
  for (const auto* rows :
       {&all.observations, &all.next_observations, &all.actions, &all.h, &all.next_h}) {
    for (const float number : *rows) {
      ASSERT_TRUE(std::isfinite(number));
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_LE(std::hypot(all.actions[2 * i], all.actions[2 * i + 1]), 1.0F + 1e-6F);
    EXPECT_GE(all.h[i], all.next_h[i] - 1e-5F) << "the way includes its end";
  }
}

// Within a situation x' of one transition is x of the next; at its end it is settled or cut off.
TEST_F(TransitionsTest, FollowOneAnother) {
  const Transitions all = made(6, 2);
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    if (all.settled[i] + all.cut_off[i] > 0.0F) {
      continue;
    }
    for (std::size_t k = 0; k < num_features; ++k) {
      ASSERT_EQ(at(all.next_observations, i, k), at(all.observations, i + 1, k));
    }
    EXPECT_GE(all.h[i + 1], all.next_h[i] - 1e-5F) << "the way includes its start";
  }
  EXPECT_EQ(all.settled.back() + all.cut_off.back(), 1.0F);
}

// Beside what stands, the ego comes on as far as its speed says.
TEST_F(TransitionsTest, MoveAsTheirSpeedsSay) {
  constexpr std::size_t speed = num_ego_features + 5;
  const Transitions all = made(10, 3);
  int seen = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (at(all.observations, i, speed) != 0.0) {
      continue;
    }
    ++seen;
    const double before =
        std::hypot(at(all.observations, i, obstacle_x), at(all.observations, i, obstacle_y));
    const double then = std::hypot(at(all.next_observations, i, obstacle_x),
                                   at(all.next_observations, i, obstacle_y));
    const double fastest = std::hypot(at(all.observations, i, v_x), at(all.observations, i, v_y));
    EXPECT_LE(std::abs(then - before), 0.1 * fastest + 0.06);
    if (at(all.observations, i, second_is_there) == 0.0) {
      EXPECT_LE(all.h[i] - all.next_h[i], 0.1 * fastest + 0.3) << "h falls as it drives away";
    }
  }
  EXPECT_GT(seen, 50);
}

TEST_F(TransitionsTest, AreTheSeedsAndHalfStartNearTheBoundary) {
  const Transitions first = made(4, 4);
  const Transitions again = made(4, 4);
  const Transitions other = made(4, 5);
  EXPECT_EQ(first.observations, again.observations);
  EXPECT_EQ(first.h, again.h);
  EXPECT_NE(first.h, other.h);
  EXPECT_NEAR(static_cast<double>(first.near + other.near) / 80.0, 0.5, 0.17);
  EXPECT_EQ(made(4, 4, {.near_share = 0.0}).near, 0U);
}

/// A network that brakes whatever comes: of all demands, braking adds least to Q.
Network braking_network() {
  formats::Tensors all = networks_that_hand_on();
  for (const char* const name : {"q1.", "q2."}) {
    all.tensors.at(name + std::string("0.weight")).values[num_net_inputs] = 1.0F;
    all.tensors.at(name + std::string("0.bias")).values[0] = 2.0F;
  }
  return Network::from(all, "weights").value();
}

// One situation each, driven by the network alone until it is settled.
TEST_F(TransitionsTest, OutcomesAreThoseOfTheNetwork) {
  const Network network = braking_network();
  const Transitions all =
      made_transitions(car_, body, model_, mixture_of_outcomes(), {40, 9}, &network);
  EXPECT_EQ(all.drives, 40U);
  EXPECT_EQ(all.situations, 40U);
  ASSERT_GT(all.size(), 200U);
  std::size_t ends = 0;
  std::size_t cut_off = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_NEAR(all.actions[2 * i], -1.0, 1e-6);
    EXPECT_NEAR(all.actions[2 * i + 1], 0.0, 1e-6);
    ends += all.settled[i] != 0.0F ? 1U : 0U;
    cut_off += all.cut_off[i] != 0.0F ? 1U : 0U;
  }
  EXPECT_LE(cut_off, 8U) << "who brakes stands within 12 s; somebody slow may yet be on his way";
  EXPECT_LE(ends, 40U);
  EXPECT_GT(ends, 25U) << "some are settled at once";
  EXPECT_THROW(std::ignore = made_transitions(car_, body, model_, mixture_of_outcomes(), {1, 1}),
               ContractViolation);
}

TEST_F(TransitionsTest, RefusesMixturesOfNothing) {
  EXPECT_THROW(std::ignore = made(0, 1), ContractViolation);
  EXPECT_THROW(std::ignore = made(1, 1, {.looks = 0}), ContractViolation);
  EXPECT_THROW(std::ignore = made(1, 1, {.near_share = 1.5}), ContractViolation);
  EXPECT_THROW(std::ignore = made(1, 1, {.behaviours = {0.0, 0.0, 0.0, 0.0}}), ContractViolation);
}

}  // namespace
}  // namespace saca::learned_danger::transitions_test
