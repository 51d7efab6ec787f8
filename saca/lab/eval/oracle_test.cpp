#include "saca/lab/eval/oracle.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "saca/lab/eval/scenes_for_test.h"
#include "saca/onboard/collision/ordering.h"

namespace saca::eval::oracle_test {
namespace {

using manoeuvre::PolicyId;
using prepare::default_car;

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
  EXPECT_FALSE(told.of(PolicyId::aes_left).written.facts.drivable());
}

// Too near to brake (19 m/s needs some 24 m, 20 are there), both sides closed by barriers: nothing
// stays clear, and doing nothing is worst by far.
TEST(Oracle, UnderDrawsAllAreComparedInTheSameWorlds) {
  scenario::Scenario scenario = standing_car(19.0, 60.0);
  scenario.road.left_edge = 1.9;
  scenario.road.right_edge = -1.9;
  scenario.road.left_beyond = world::Beyond::barrier;
  scenario.road.right_beyond = world::Beyond::barrier;
  const OracleOptions options{.time = 40.0 / 19.0, .draws = 12, .seed = 4, .threads = 2};
  const Oracle told = oracle(scenario, default_car(), shipped_harm(), options);
  ASSERT_EQ(told.ranking.size(), 8U);
  EXPECT_EQ(told.ranking.back(), PolicyId::no_intervention);
  double second = 1e9;
  for (const PolicyId policy : told.ranking) {
    const Verdict& verdict = told.of(policy);
    EXPECT_EQ(verdict.expected.contact.share, 1.0);
    EXPECT_NEAR(verdict.behind.value,
                verdict.expected.harm.value - told.of(told.best()).expected.harm.value, 1e-12);
    if (policy != told.best()) {
      second = std::min(second, verdict.behind.value);
    }
  }
  EXPECT_EQ(margin_of_best(told).mean, second);
  EXPECT_GT(told.of(PolicyId::no_intervention).behind.low, 0.0);
}

TEST(Oracle, ThreadsAndRepetitionChangeNothing) {
  const scenario::Scenario scenario = standing_car(19.0, 60.0);
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

// A wet road between barriers, the car ahead too near to stop behind: of each policy that has
// several plans, that stands which harms least, and it harms no more than the default.
TEST(Oracle, OfEachPolicyTheBestOfAllTargetSpeedsAndStrengthsStands) {
  scenario::Scenario scenario = standing_car(19.0, 60.0);
  scenario.road.left_edge = 1.9;
  scenario.road.right_edge = -1.9;
  scenario.road.left_beyond = world::Beyond::barrier;
  scenario.road.right_beyond = world::Beyond::barrier;
  const double time = 40.0 / 19.0;
  const Oracle told = oracle(scenario, default_car(), shipped_harm(), {.time = time});
  const DecisionPoint point = decision_point_at(scenario, default_car(), time);
  const auto all = encounter::all_plans_tried({&point, 1}, default_car(), shipped_harm());
  for (const encounter::Hindsight& one : all.front()) {
    ASSERT_TRUE(one.facts.drivable());
    EXPECT_LE(told.of(one.facts.plan.policy).written.facts.outcome().harm,
              one.facts.outcome().harm + collision::harm_tie);
  }
  const encounter::Hindsights by_default = encounter::hindsight(
      decision_point_at(scenario, default_car(), time), default_car(), shipped_harm());
  const auto gain = [&](PolicyId policy) {
    return by_default[manoeuvre::index(policy)].facts.outcome().harm -
           told.of(policy).written.facts.outcome().harm;
  };
  EXPECT_GT(gain(PolicyId::es_b_left),
            collision::harm_tie);  // braking to rest meets it more slowly
  EXPECT_EQ(gain(PolicyId::aes_left), 0.0);
  const Oracle paper =
      oracle(scenario, default_car(), shipped_harm(), {.time = time, .only_defaults = true});
  for (const PolicyId policy : manoeuvre::all_policies) {
    EXPECT_EQ(paper.of(policy).written.facts.outcome().harm,
              by_default[manoeuvre::index(policy)].facts.outcome().harm);
  }
}

}  // namespace
}  // namespace saca::eval::oracle_test
