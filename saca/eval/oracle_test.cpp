#include "saca/eval/oracle.h"

#include <gmock/gmock.h>

#include <set>

#include "saca/eval/scenes_for_test.h"

namespace saca::eval {
namespace {

using manoeuvre::default_car;
using manoeuvre::PolicyId;

TEST(Oracle, AsWrittenTheMildestOfTheHarmlessIsBest) {
  const Oracle told =
      oracle(standing_car(15.0, 60.0), default_car(), shipped_harm(), {.time = 2.7});
  EXPECT_EQ(told.best(), PolicyId::aeb);
  EXPECT_EQ(told.ranking.size(), 8U);
  EXPECT_EQ(told.ranking.back(), PolicyId::no_intervention);
  EXPECT_EQ(told.of(PolicyId::aeb).expected.harm.value, 0.0);
  EXPECT_EQ(told.of(PolicyId::aeb).behind.value, 0.0);
  EXPECT_EQ(margin_of_best(told).mean, 0.0);  // lane changes harm nobody either
}

TEST(Oracle, WhatCannotBeDrivenIsNotRanked) {
  const Oracle told = oracle(standing_car(4.0, 30.0), default_car(), shipped_harm(), {.time = 6.0});
  EXPECT_EQ(std::set(told.ranking.begin(), told.ranking.end()),
            (std::set{PolicyId::aeb, PolicyId::no_intervention}));
  EXPECT_FALSE(told.of(PolicyId::aes_left).written.facts.refusal.empty());
}

// Too near to brake (19 m/s needs some 24 m, 20 are there), both sides closed by walls: braking
// still takes most of the speed.
TEST(Oracle, UnderDrawsTheBestIsAloneByItsMargin) {
  sim::Scenario scenario = standing_car(19.0, 60.0);
  scenario.road.left_edge = 1.9;
  scenario.road.right_edge = -1.9;
  scenario.road.left_beyond = world::Beyond::barrier;
  scenario.road.right_beyond = world::Beyond::barrier;
  const OracleOptions options{.time = 40.0 / 19.0, .draws = 12, .seed = 4, .threads = 2};
  const Oracle told = oracle(scenario, default_car(), shipped_harm(), options);
  EXPECT_EQ(told.best(), PolicyId::aeb);
  const Margin margin = margin_of_best(told);
  EXPECT_GT(margin.low, 0.0);
  EXPECT_GT(margin.mean, margin.low);
  const auto& behind = told.of(PolicyId::no_intervention).behind;
  const auto mean = [&](PolicyId policy) { return told.of(policy).expected.harm.value; };
  EXPECT_NEAR(behind.value, mean(PolicyId::no_intervention) - mean(PolicyId::aeb), 1e-12);
}

TEST(Oracle, ThreadsAndRepetitionChangeNothing) {
  const sim::Scenario scenario = standing_car(19.0, 60.0);
  OracleOptions options{.time = 2.4, .draws = 6, .seed = 4, .threads = 1};
  const Oracle one = oracle(scenario, default_car(), shipped_harm(), options);
  options.threads = 3;
  const Oracle three = oracle(scenario, default_car(), shipped_harm(), options);
  options.seed = 5;
  const Oracle other = oracle(scenario, default_car(), shipped_harm(), options);
  for (const PolicyId policy : manoeuvre::all_policies) {
    EXPECT_EQ(one.of(policy).expected.harm.value, three.of(policy).expected.harm.value);
  }
  EXPECT_NE(one.of(PolicyId::no_intervention).expected.harm.value,
            other.of(PolicyId::no_intervention).expected.harm.value);
}

}  // namespace
}  // namespace saca::eval
