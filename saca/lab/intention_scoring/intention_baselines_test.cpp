#include "saca/lab/intention_scoring/intention_baselines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/lab/intention_scoring/sequences_for_test.h"
#include "saca/lab/intention_scoring/simulated.h"
#include "saca/thinking/intent/model.h"

namespace saca::intention_scoring::intention_baselines_test {
namespace {

using testing::ElementsAreArray;

/// What is seen of somebody who moves so.
Sequence moving(const std::vector<double>& acceleration, const std::vector<double>& lateral_speed) {
  Sequence sequence = labelled(std::string(acceleration.size(), 'M'));
  for (std::size_t t = 0; t < acceleration.size(); ++t) {
    sequence.observations[t].speed = 20.0;
    sequence.observations[t].acceleration = acceleration[t];
    sequence.observations[t].lateral_speed = lateral_speed[t];
  }
  return sequence;
}

std::vector<std::uint8_t> named(const Forecasts& forecasts, std::size_t head = 0) {
  return forecasts.named(head);
}

std::vector<std::uint8_t> letters(std::string_view text) {
  return labelled(text).labels;
}

const std::vector<double> nothing(8, 0.0);

TEST(ConstantMotion, AlwaysMaintains) {
  const Forecasts forecasts = constant_motion(moving(nothing, nothing));
  EXPECT_NO_THROW(expect_forecasts_of(moving(nothing, nothing), forecasts));
  for (std::size_t head = 0; head < num_heads; ++head) {
    EXPECT_THAT(forecasts.named(head), ElementsAreArray(letters("MMMMMMMM")));
    EXPECT_EQ(forecasts.at[head][3][0], 1.0);
  }
}

TEST(CausalRule, BeginsAndEndsAtTheLabelsThresholds) {
  const CausalRule quick{.smoothed = 1};
  EXPECT_THAT(
      named(causal_rule(moving({0.0, -1.9, -2.0, -1.5, -1.1, -1.0, -1.5, 0.0}, nothing), quick)),
      ElementsAreArray(letters("MMBBBMMM")));
  EXPECT_THAT(
      named(causal_rule(moving(nothing, {0.0, 0.3, 0.36, 0.3, 0.21, 0.2, -0.36, -0.1}), quick)),
      ElementsAreArray(letters("MMLLLMRM")));
  EXPECT_THAT(named(causal_rule(moving({-3.0, -3.0, -3.0, 0.0, 0.0, 0.0, -3.0, -3.0},
                                       {0.0, 0.5, 0.5, 0.5, -0.5, 0.0, -0.5, -0.5}),
                                quick)),
              ElementsAreArray(letters("BllLRMrr")));
}

TEST(CausalRule, TakesMeansOfTheLastFrames) {
  // Means of three: -1, -2, -3 from the third frame on; of one frame alone the first counts whole.
  EXPECT_THAT(named(causal_rule(moving({0.0, 0.0, -3.0, -3.0, -3.0, 0.0, 0.0, 0.0}, nothing))),
              ElementsAreArray(letters("MMMBBBMM")));
}

TEST(CausalRule, DoesNotLookAhead) {
  const auto sequence = simulated_sequences(1, 9, 1).front();
  Sequence cut = sequence;
  cut.observations.resize(50);
  const Forecasts whole = causal_rule(sequence);
  const Forecasts part = causal_rule(cut);
  const Forecasts whole_chain = crf_by_hand(sequence);
  const Forecasts part_chain = crf_by_hand(cut);
  for (std::size_t t = 0; t < 50; ++t) {
    EXPECT_EQ(whole.at[0][t], part.at[0][t]);
    EXPECT_EQ(whole_chain.at[2][t], part_chain.at[2][t]);
  }
}

TEST(CausalRule, OfNobodyInALaneNoSideIsNamed) {
  const std::vector<double> unknown(8, std::nan(""));
  EXPECT_THAT(named(causal_rule(moving(std::vector<double>(8, -3.0), unknown))),
              ElementsAreArray(letters("BBBBBBBB")));
  EXPECT_THAT(named(causal_rule(moving(unknown, unknown))), ElementsAreArray(letters("MMMMMMMM")));
  EXPECT_TRUE(causal_rule(moving({}, {})).at[0].empty());
}

TEST(CausalRule, RefusesNoFilterAndNoCertainty) {
  const Sequence sequence = moving(nothing, nothing);
  EXPECT_THROW((void)causal_rule(sequence, {.smoothed = 0}), ContractViolation);
  EXPECT_THROW((void)causal_rule(sequence, {.sure = 0.1}), ContractViolation);
  EXPECT_THROW((void)causal_rule(sequence, {.sure = std::nan("")}), ContractViolation);
}

TEST(EmissionsByHand, AreADistributionEvenAtTheThresholds) {
  for (const double pull : {-9.0, -2.0, 0.0, std::nan("")}) {
    for (const double aside : {-2.0, -0.35, 0.0, 0.35, std::nan("")}) {
      const Sequence one = moving({pull}, {aside});
      const intent::Scores scores = emissions_by_hand(one.observations);
      double sum = 0.0;
      for (const double score : scores) {
        sum += std::exp(score);
      }
      EXPECT_NEAR(sum, 1.0, 1e-12);
    }
  }
  const Sequence even = moving({-2.0}, {0.0});
  const intent::Scores scores = emissions_by_hand(even.observations);
  EXPECT_NEAR(scores[0], scores[3], 1e-12) << "at -2 m/s^2 M is as likely as FB";
  const Sequence aside = moving({0.0}, {0.35});
  EXPECT_NEAR(emissions_by_hand(aside.observations)[0], emissions_by_hand(aside.observations)[1],
              1e-12);
  EXPECT_THROW((void)emissions_by_hand({}), ContractViolation);
}

TEST(EmissionsByHand, MirrorIntoEachOther) {
  const Sequence there = moving({-3.0}, {0.4});
  const Sequence turned = moving({-3.0}, {-0.4});
  const intent::Scores a = emissions_by_hand(there.observations);
  const intent::Scores b = emissions_by_hand(turned.observations);
  EXPECT_EQ(a[1], b[2]);
  EXPECT_EQ(a[4], b[5]);
  EXPECT_EQ(a[3], b[3]);
}

TEST(CrfByHand, IsTheForwardPassOverAllPaths) {
  const Sequence sequence = moving({0.0, -2.1, -1.9}, {0.0, 0.3, 0.4});
  const HandMadeChain chain{.stays = 0.8, .maintains = 0.5};
  const Forecasts forecasts = crf_by_hand(sequence, chain);
  // Brute force: all 6^3 paths, scores as the header states them.
  const auto step = [&](std::size_t from, std::size_t to) {
    double allowed = 0.0;
    for (std::size_t other = 0; other < 6; ++other) {
      allowed += other != from && intent::may_follow(from, other) ? 1.0 : 0.0;
    }
    return from == to ? 0.8 : intent::may_follow(from, to) ? 0.2 / allowed : 0.0;
  };
  const std::span<const intent::Observation> seen = sequence.observations;
  const auto emission = [&](std::size_t t, std::size_t c) {
    return std::exp(emissions_by_hand(seen.first(t + 1))[c]);
  };
  ClassProbabilities last{};
  double sum = 0.0;
  for (std::size_t a = 0; a < 6; ++a) {
    for (std::size_t b = 0; b < 6; ++b) {
      for (std::size_t c = 0; c < 6; ++c) {
        const double path = (a == 0 ? 0.5 : 0.1) * emission(0, a) * step(a, b) * emission(1, b) *
                            step(b, c) * emission(2, c);
        last[c] += path;
        sum += path;
      }
    }
  }
  for (std::size_t c = 0; c < 6; ++c) {
    EXPECT_NEAR(forecasts.at[0][2][c], last[c] / sum, 1e-12) << c;
  }
}

TEST(CrfByHand, IsLessSureOfWhatIsFarther) {
  const Sequence sequence = moving(std::vector<double>(20, -6.0), std::vector<double>(20, 0.0));
  const Forecasts forecasts = crf_by_hand(sequence);
  EXPECT_NO_THROW(expect_forecasts_of(sequence, forecasts));
  const auto braking = [&](std::size_t head) { return forecasts.at.at(head)[19][3]; };
  EXPECT_GT(braking(0), 0.99);
  EXPECT_GT(braking(0), braking(1));
  EXPECT_GT(braking(1), braking(2));
  // Ten steps at 0.97 leave 0.74, and a little comes back.
  EXPECT_NEAR(braking(2), std::pow(0.97, 10.0), 0.02);
  EXPECT_THROW((void)crf_by_hand(sequence, {.stays = 1.0}), ContractViolation);
}

TEST(Baselines, RankAsTheyMustOnSimulatedVehicles) {
  Tally constant;
  Tally rule;
  Tally chain;
  for (const Sequence& sequence : simulated_sequences(60, 3, 2)) {
    constant += tally(sequence, constant_motion(sequence), 0);
    rule += tally(sequence, causal_rule(sequence), 0);
    chain += tally(sequence, crf_by_hand(sequence), 0);
  }
  EXPECT_LT(*constant.confusion.macro_f1(recorded_classes), 0.26) << "one of four";
  EXPECT_GT(*rule.confusion.macro_f1(recorded_classes), 0.6);
  EXPECT_GT(*chain.confusion.macro_f1(recorded_classes), 0.6);
  EXPECT_LT(*chain.mean_log_loss(), *constant.mean_log_loss());
}

}  // namespace
}  // namespace saca::intention_scoring::intention_baselines_test
