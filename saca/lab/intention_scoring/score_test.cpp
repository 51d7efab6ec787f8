#include "saca/lab/intention_scoring/score.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "saca/base/core/contract.h"
#include "saca/lab/intention_scoring/sequences_for_test.h"

namespace saca::intention_scoring::score_test {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::Optional;

constexpr double rounding = 1e-12;

TEST(Confusion, CountsByHand) {
  const auto sum = tally(labelled("MMMMLLBB"), all_heads("MMMLLLBM"), 0);
  const Confusion& confusion = sum.confusion;
  EXPECT_EQ(confusion.counts[0][0], 3U);
  EXPECT_EQ(confusion.counts[0][1], 1U);
  EXPECT_EQ(confusion.counts[1][1], 2U);
  EXPECT_EQ(confusion.counts[3][0], 1U);
  EXPECT_EQ(confusion.counts[3][3], 1U);
  EXPECT_EQ(confusion.total(), 8U);
  EXPECT_THAT(confusion.recall(0), Optional(DoubleNear(3.0 / 4.0, rounding)));
  EXPECT_THAT(confusion.precision(0), Optional(DoubleNear(3.0 / 4.0, rounding)));
  EXPECT_THAT(confusion.recall(1), Optional(DoubleNear(1.0, rounding)));
  EXPECT_THAT(confusion.precision(1), Optional(DoubleNear(2.0 / 3.0, rounding)));
  EXPECT_THAT(confusion.f1(1), Optional(DoubleNear(0.8, rounding)));
  EXPECT_THAT(confusion.f1(3), Optional(DoubleNear(2.0 / 3.0, rounding)));
  // RC neither occurs nor is predicted: the mean is over M, LC and FB.
  EXPECT_THAT(confusion.macro_f1(recorded_classes),
              Optional(DoubleNear((0.75 + 0.8 + 2.0 / 3.0) / 3.0, rounding)));
}

TEST(Confusion, HasNoShareOfNothing) {
  const auto sum = tally(labelled("MM"), all_heads("ML"), 0);
  EXPECT_EQ(sum.confusion.recall(3), std::nullopt);
  EXPECT_EQ(sum.confusion.precision(3), std::nullopt);
  EXPECT_EQ(sum.confusion.f1(3), std::nullopt);
  EXPECT_THAT(sum.confusion.f1(1), Optional(0.0)) << "predicted, and wrong";
  EXPECT_EQ(sum.confusion.macro_f1(simulated_classes), std::nullopt);
  EXPECT_EQ(Tally{}.mean_log_loss(), std::nullopt);
  EXPECT_EQ(Tally{}.top_calibration_error(), std::nullopt);
  EXPECT_EQ(Tally{}.classwise_calibration_error(), std::nullopt);
}

TEST(Tally, ComparesAHeadWithTheLabelAheadOfIt) {
  const std::string late = "MMMMMLLLLL";
  // The head for 0.5 s says at each frame what will be five frames later.
  Forecasts forecasts = all_heads("MMMMMMMMMM");
  forecasts.at[1] = predicted("LLLLLBBBBB");  // the last five are never judged
  const auto ahead = tally(labelled(late), forecasts, 1);
  EXPECT_EQ(ahead.confusion.total(), 5U);
  EXPECT_EQ(ahead.confusion.counts[1][1], 5U);
  EXPECT_EQ(tally(labelled(late), forecasts, 0).confusion.counts[1][0], 5U);
  EXPECT_EQ(tally(labelled(late), forecasts, 2).confusion.total(), 0U);
}

TEST(Tally, LeavesOutFramesInDoubtAtEitherEnd) {
  Sequence sequence = labelled("MMMMMMMM");
  sequence.scored[1] = false;
  EXPECT_EQ(tally(sequence, all_heads("MMMMMMMM"), 0).confusion.total(), 7U);
  // Pairs (0,5), (1,6), (2,7): the second goes.
  EXPECT_EQ(tally(sequence, all_heads("MMMMMMMM"), 1).confusion.total(), 2U);
  sequence.scored[7] = false;
  EXPECT_EQ(tally(sequence, all_heads("MMMMMMMM"), 1).confusion.total(), 1U);
}

TEST(Tally, SumsAreMadeOfTheirParts) {
  const Sequence both = labelled("MLBMRBlr");
  const Forecasts said = all_heads("MLMMRBrr", 0.7);
  Tally sum = tally(labelled("MLB"), all_heads("MLM", 0.7), 0);
  sum += tally(labelled("MRBlr"), all_heads("MRBrr", 0.7), 0);
  const Tally whole = tally(both, said, 0);
  EXPECT_EQ(sum.confusion.counts, whole.confusion.counts);
  EXPECT_NEAR(sum.log_loss, whole.log_loss, rounding);
  EXPECT_NEAR(sum.brier, whole.brier, rounding);
  EXPECT_NEAR(*sum.classwise_calibration_error(), *whole.classwise_calibration_error(), rounding);
}

TEST(Tally, LossesByHand) {
  // Right with 0.75, the other five 0.05 each; then wrong the same way.
  const auto sum = tally(labelled("MM"), all_heads("ML", 0.75), 0);
  EXPECT_THAT(sum.mean_log_loss(),
              Optional(DoubleNear(-(std::log(0.75) + std::log(0.05)) / 2.0, rounding)));
  const double right = 0.25 * 0.25 + 5.0 * 0.05 * 0.05;
  const double wrong = 0.95 * 0.95 + 0.75 * 0.75 + 4.0 * 0.05 * 0.05;
  EXPECT_THAT(sum.mean_brier(), Optional(DoubleNear((right + wrong) / 2.0, rounding)));
}

TEST(Tally, AForecastOfZeroCostsNoInfinity) {
  const auto sum = tally(labelled("M"), all_heads("L", 1.0), 0);
  EXPECT_THAT(sum.mean_log_loss(), Optional(DoubleNear(-std::log(1e-12), 1e-9)));
  EXPECT_THAT(sum.mean_brier(), Optional(DoubleNear(2.0, rounding)));
}

TEST(CalibrationError, IsTheDistanceOfProbabilityAndShareByHand) {
  // Ten times 0.9, eight of them right; ten times 0.5, nine of them right.
  Sequence sequence = labelled("MMMMMMMMBBMMMMMMMMMB");
  Forecasts forecasts = all_heads("MMMMMMMMMMMMMMMMMMMM", 0.9);
  for (auto& head : forecasts.at) {
    for (std::size_t t = 10; t < 20; ++t) {
      head[t] = mostly(0, 0.5);
    }
  }
  const auto sum = tally(sequence, forecasts, 0);
  EXPECT_THAT(sum.top_calibration_error(),
              Optional(DoubleNear((std::abs(9.0 - 8.0) + std::abs(5.0 - 9.0)) / 20.0, rounding)));
  // M: as above. FB: 10 x 0.02 and 10 x 0.1, which true 2 and 1. Others: as predicted, none true.
  const double m = (1.0 + 4.0) / 20.0;
  const double fb = (std::abs(0.2 - 2.0) + std::abs(1.0 - 1.0)) / 20.0;
  const double other = (0.2 + 1.0) / 20.0;
  EXPECT_THAT(sum.classwise_calibration_error(),
              Optional(DoubleNear((m + fb + 4.0 * other) / 6.0, rounding)));
}

TEST(CalibrationError, IsSmallForWhoSaysHowOftenHeIsRight) {
  std::mt19937_64 rng(7);
  std::uniform_real_distribution<double> unit;
  Tally sum;
  for (int i = 0; i < 20000; ++i) {
    const double sure = 0.2 + 0.8 * unit(rng);
    const ClassProbabilities said = mostly(2, sure);
    double left = unit(rng);
    std::size_t truth = 0;
    while (truth + 1 < num_vehicle_classes && left >= said.at(truth)) {
      left -= said.at(truth);
      ++truth;
    }
    Sequence one = labelled("M");
    one.labels[0] = static_cast<std::uint8_t>(truth);
    sum += tally(one, {{{{said}, {said}, {said}}}}, 0);
  }
  // A bin of 1,600 has a standard error of at most 0.5 / 40 = 0.0125.
  EXPECT_LT(*sum.top_calibration_error(), 0.0125);
  EXPECT_LT(*sum.classwise_calibration_error(), 0.0125);
}

TEST(Tally, RefusesWhatDoesNotFit) {
  const Sequence sequence = labelled("MM");
  EXPECT_THROW((void)tally(sequence, all_heads("MM"), num_heads), ContractViolation);
  EXPECT_THROW((void)tally(sequence, all_heads("M"), 0), ContractViolation);
  Forecasts wrong = all_heads("MM");
  wrong.at[1][0][0] = 0.2;
  EXPECT_THROW((void)tally(sequence, wrong, 0), ContractViolation) << "sum";
  wrong.at[1][0][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)tally(sequence, wrong, 0), ContractViolation);
  Sequence unlike = sequence;
  unlike.labels[0] = 6;
  EXPECT_THROW((void)tally(unlike, all_heads("MM"), 0), ContractViolation);
  unlike = sequence;
  unlike.scored.pop_back();
  EXPECT_THROW((void)tally(unlike, all_heads("MM"), 0), ContractViolation);
}

TEST(GroupTallies, AreInAlphabeticOrder) {
  std::vector<Sequence> sequences{labelled("ML"), labelled("B"), labelled("R")};
  sequences[0].group = "b";
  sequences[1].group = "a";
  sequences[2].group = "b";
  const std::vector<Forecasts> forecasts{all_heads("ML"), all_heads("B"), all_heads("R")};
  EXPECT_THAT(groups_of(sequences), ElementsAre("a", "b"));
  const auto tallies = group_tallies(sequences, forecasts, 0);
  ASSERT_EQ(tallies.size(), 2U);
  EXPECT_EQ(tallies[0].confusion.counts[3][3], 1U);
  EXPECT_EQ(tallies[0].confusion.total(), 1U);
  EXPECT_EQ(tallies[1].confusion.total(), 3U);
}

TEST(LikeliestClass, OfEqualsIsTheFirst) {
  EXPECT_EQ(likeliest_class({0.1, 0.3, 0.1, 0.3, 0.1, 0.1}), 1U);
  EXPECT_THAT(all_heads("MBr").named(1), ElementsAre(0, 3, 5));
}

}  // namespace
}  // namespace saca::intention_scoring::score_test
