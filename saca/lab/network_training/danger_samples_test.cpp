#include "saca/lab/network_training/danger_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "saca/lab/network_training/danger_nets.h"

namespace saca::network_training::danger_samples_test {
namespace {

using learned_danger::Experience;

/// One transition beside so many obstacles; every number that the networks see is another one.
Experience one_transition(std::size_t obstacles) {
  Experience all{.num_obstacles = obstacles, .row = {0}, .next_row = {1}};
  for (std::size_t i = 0; i < 2 * obstacles * learned_danger::num_net_inputs; ++i) {
    all.inputs.push_back(1.0F + static_cast<float>(i));
  }
  for (std::size_t i = 0; i < 2 * obstacles; ++i) {
    all.h_at.push_back(-1.0F - static_cast<float>(i));
  }
  all.actions = {0.25F, 0.5F};
  all.h = {-0.5F};
  all.settled = {1.0F};
  all.reached = {-0.25F};
  return all;
}

bool is_mirrored(std::int64_t input) {
  const auto& mirrored = learned_danger::mirrored_inputs();
  return std::find(mirrored.begin(), mirrored.end(), static_cast<std::size_t>(input)) !=
         mirrored.end();
}

TEST(DangerSamples, ShowEachSecondTransitionInAMirror) {
  std::mt19937_64 random(1);
  const TransitionSample sample = drawn(one_transition(1), 4, random);
  ASSERT_FALSE(learned_danger::mirrored_inputs().empty());
  for (std::int64_t k = 0; k < 4; ++k) {
    for (std::int64_t j = 0; j < num_inputs; ++j) {
      const double sign = k % 2 == 1 && is_mirrored(j) ? -1.0 : 1.0;
      EXPECT_EQ(sample.inputs[k][j].item<double>(), sign * static_cast<double>(1 + j));
      EXPECT_EQ(sample.next_inputs[k][j].item<double>(),
                sign * static_cast<double>(1 + num_inputs + j));
    }
    EXPECT_EQ(sample.actions[k][0].item<double>(), 0.25) << "along";
    EXPECT_EQ(sample.actions[k][1].item<double>(), k % 2 == 1 ? -0.5 : 0.5) << "across";
    EXPECT_EQ(sample.h[k].item<double>(), -0.5);
    EXPECT_EQ(sample.settled[k].item<double>(), 1.0);
    EXPECT_EQ(sample.reached[k].item<double>(), -0.25);
  }
}

TEST(DangerSamples, HaveTheObstaclesOfATransitionInSequence) {
  std::mt19937_64 random(1);
  const TransitionSample sample = drawn(one_transition(2), 1, random);
  ASSERT_EQ(sample.inputs.size(0), 2);
  EXPECT_EQ(sample.h_at[0].item<double>(), -1.0);
  EXPECT_EQ(sample.h_at[1].item<double>(), -2.0);
  EXPECT_EQ(sample.next_h_at[0].item<double>(), -3.0);
  EXPECT_EQ(sample.next_h_at[1].item<double>(), -4.0);
  EXPECT_EQ(sample.inputs[1][0].item<double>(), static_cast<double>(1 + num_inputs));
}

TEST(DangerSamples, HaveAllThatInputsLeadToFromAState) {
  learned_danger::Outcomes all{.num_inputs = 2,
                               .states = std::vector<float>(learned_danger::num_net_inputs, 1.0F),
                               .h_at = {-4.0F},
                               .next_states = {},
                               .next_h = {-3.0F, -5.0F},
                               .h = {-2.5F, -4.5F},
                               .settled = {0.0F, 1.0F}};
  all.next_states.assign(learned_danger::num_net_inputs, 2.0F);
  all.next_states.resize(2 * learned_danger::num_net_inputs, 3.0F);
  std::mt19937_64 random(1);
  const OutcomeSample sample = drawn(all, 2, random);
  ASSERT_EQ(sample.next_inputs.size(0), 4);
  for (std::int64_t k = 0; k < 4; ++k) {
    const bool second = k % 2 == 1;
    EXPECT_EQ(sample.next_inputs[k].abs().max().item<double>(), second ? 3.0 : 2.0);
    EXPECT_EQ(sample.next_h_at[k].item<double>(), second ? -5.0 : -3.0);
    EXPECT_EQ(sample.h[k].item<double>(), second ? -4.5 : -2.5);
    EXPECT_EQ(sample.settled[k].item<double>(), second ? 1.0 : 0.0);
  }
  EXPECT_EQ(sample.h_at[1].item<double>(), -4.0);
}

}  // namespace
}  // namespace saca::network_training::danger_samples_test
