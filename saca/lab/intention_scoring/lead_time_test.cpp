#include "saca/lab/intention_scoring/lead_time.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/base/core/contract.h"
#include "saca/lab/intention_scoring/sequences_for_test.h"

namespace saca::intention_scoring::lead_time_test {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Optional;

constexpr double rounding = 1e-9;

TEST(LaneChangeWarnings, RunFromTheFirstLastingFrameToTheCrossing) {
  Sequence sequence = labelled("MMMMLLLLLLLM");
  sequence.crossing_times = {0.85};
  // A blip at frame 2 does not count, frames 5 to 8 do: 0.85 - 0.5.
  const auto lead_times = lane_change_lead_times(sequence, all_heads("MMLMMLLLLLMM"));
  EXPECT_THAT(lead_times.times, ElementsAre(DoubleNear(0.35, rounding)));
  EXPECT_EQ(lead_times.share_predicted(), 1.0);
}

TEST(LaneChangeWarnings, EitherHeadMayCarryIt) {
  Sequence sequence = labelled("MMMMLLLLLLLM");
  sequence.crossing_times = {0.8};
  Forecasts forecasts = all_heads("MMMMMMMMMMMM");
  forecasts.at[2] = predicted("MMLLLMMMMMMM");  // for 1 s ahead: frames 2 to 4
  forecasts.at[0] = predicted("MMMMMlLLLMMM");  // now: 5 to 8, braking at first
  EXPECT_THAT(lane_change_lead_times(sequence, forecasts).times,
              ElementsAre(DoubleNear(0.6, rounding)));
  forecasts.at[2] = predicted("MMMMMMMMMMMM");
  forecasts.at[1] = predicted("LLLLLLLLLLLL");  // that for 0.5 s does not count here
  EXPECT_THAT(lane_change_lead_times(sequence, forecasts).times,
              ElementsAre(DoubleNear(0.3, rounding)));
}

TEST(LaneChangeWarnings, TheOtherSideIsNoWarning) {
  Sequence sequence = labelled("MMRRRRRR");
  sequence.crossing_times = {0.6};
  const auto lead_times = lane_change_lead_times(sequence, all_heads("LLLLLLLL"));
  EXPECT_THAT(lead_times.times, ElementsAre(0.0));
  EXPECT_EQ(lead_times.share_predicted(), 0.0);
}

TEST(LaneChangeWarnings, ASecondCrossingIsWarnedOfAfterTheFirst) {
  Sequence sequence = labelled("LLLLLLLLLL");
  sequence.crossing_times = {0.3, 0.8};
  // Predicted all along: 0.3 - 0, and 0.8 - 0.4.
  EXPECT_THAT(lane_change_lead_times(sequence, all_heads("LLLLLLLLLL")).times,
              ElementsAre(DoubleNear(0.3, rounding), DoubleNear(0.4, rounding)));
}

TEST(LaneChangeWarnings, ACrossingWithoutASideIsCounted) {
  Sequence sequence = labelled("MMMMMM");
  sequence.crossing_times = {0.3, 9.0};
  const auto lead_times = lane_change_lead_times(sequence, all_heads("MMMMMM"));
  EXPECT_THAT(lead_times.times, IsEmpty());
  EXPECT_EQ(lead_times.unlabelled, 2U);
  EXPECT_EQ(lead_times.share_predicted(), std::nullopt);
  EXPECT_EQ(lead_times.quantile(0.5), std::nullopt);
}

TEST(BrakingWarnings, AnyHeadAndAnySideCount) {
  Sequence sequence = labelled("MMMMMMMBBB");
  sequence.braking_times = {0.7};
  Forecasts forecasts = all_heads("MMMMMMMMMM");
  forecasts.at[0] = predicted("MMMMMMMBMM");
  forecasts.at[1] = predicted("MMMMlrMMMM");
  forecasts.at[2] = predicted("MMMMMMBMMM");
  EXPECT_THAT(braking_lead_times(sequence, forecasts).times,
              ElementsAre(DoubleNear(0.3, rounding)));
  forecasts.at[2] = predicted("MMMMMMMMMM");  // a gap: only the frame of the onset is left
  EXPECT_THAT(braking_lead_times(sequence, forecasts).times,
              ElementsAre(DoubleNear(0.0, rounding)));
}

TEST(LeadTimes, QuantilesCountTheMissedAsNone) {
  LeadTimes lead_times;
  lead_times.times = {0.0, 2.0, 1.0};
  LeadTimes other;
  other.times = {3.0};
  other.unlabelled = 1;
  lead_times.add(other);
  EXPECT_EQ(lead_times.events(), 4U);
  EXPECT_EQ(lead_times.unlabelled, 1U);
  EXPECT_THAT(lead_times.share_predicted(), Optional(0.75));
  EXPECT_THAT(lead_times.quantile(0.25), Optional(0.0));
  EXPECT_THAT(lead_times.quantile(0.5), Optional(1.0));
  EXPECT_THAT(lead_times.quantile(0.75), Optional(2.0));
}

TEST(FalseAlarms, CountRunsWithoutSuchALabelNear) {
  //                                    0         1         2         3
  const Sequence sequence = labelled("MMMMMMMMMMMMMMMMMMMMMMMMMMMMLLLLLLLL");
  // A left run of two, a right one of one, a braking one; the left run at 25 is within 1 s.
  const auto alarms = false_alarms(sequence, all_heads("MLLMRMMMMMBBBMMMMMMMMMMMMLLMLLLLLLLL"));
  EXPECT_EQ(alarms.left, 1U);
  EXPECT_EQ(alarms.right, 1U);
  EXPECT_EQ(alarms.braking, 1U);
  EXPECT_NEAR(alarms.hours, 3.6 / 3600.0, rounding);
  EXPECT_THAT(alarms.per_hour(), Optional(DoubleNear(3000.0, 1e-6)));
}

TEST(FalseAlarms, CountBothThatOneClassNames) {
  const auto alarms = false_alarms(labelled("MMMM"), all_heads("MlrM"));
  EXPECT_EQ(alarms.left, 1U);
  EXPECT_EQ(alarms.right, 1U);
  EXPECT_EQ(alarms.braking, 1U);
}

TEST(FalseAlarms, PassOverRunsInDoubt) {
  Sequence sequence = labelled("MMMM");
  sequence.scored[2] = false;
  EXPECT_EQ(false_alarms(sequence, all_heads("MMLM")).left, 0U);
  EXPECT_EQ(false_alarms(sequence, all_heads("MLLM")).left, 1U);
}

TEST(FalseAlarms, OfNoTimeAreNoRate) {
  EXPECT_EQ(false_alarms(labelled(""), all_heads("")).per_hour(), std::nullopt);
  FalseAlarms sum = false_alarms(labelled("MM"), all_heads("LM"));
  sum += false_alarms(labelled("MM"), all_heads("LB"));
  EXPECT_EQ(sum.left, 2U);
  EXPECT_EQ(sum.braking, 1U);
  EXPECT_NEAR(sum.hours, 0.4 / 3600.0, rounding);
}

TEST(FalseAlarms, MirrorIntoEachOther) {
  const auto alarms = false_alarms(labelled("MMMMMMMMMMMMMR"), all_heads("LMLMMMMMMMMMMR"));
  const auto turned = false_alarms(labelled("MMMMMMMMMMMMML"), all_heads("RMRMMMMMMMMMML"));
  EXPECT_EQ(alarms.left, 2U);
  EXPECT_EQ(alarms.left, turned.right);
  EXPECT_EQ(alarms.right, turned.left);
}

TEST(IllegalSteps, AreCountedFromTo) {
  ForbiddenSteps forbidden{};
  forbidden[1][2] = true;  // LC -> RC only
  EXPECT_EQ(illegal_steps(labelled("MLRLRRL").labels, forbidden), 2U);
  EXPECT_EQ(illegal_steps(labelled("RLMR").labels, forbidden), 0U);
  EXPECT_EQ(illegal_steps({}, forbidden), 0U);
  const std::vector<std::uint8_t> unknown{0, 6};
  EXPECT_THROW((void)illegal_steps(unknown, forbidden), ContractViolation);
}

}  // namespace
}  // namespace saca::intention_scoring::lead_time_test
