#include "saca/runtime/replay.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "saca/runtime/tape_for_test.h"
#include "tests/support/meeting_clock.h"

namespace saca::runtime::replay_test {
namespace {

using testing::StartsWith;

constexpr double infinity = std::numeric_limits<double>::infinity();

void expect_all(const Reproduction& of, std::size_t least) {
  EXPECT_GE(of.recorded, least);
  EXPECT_EQ(of.same, of.recorded);
}

class ReplayTest : public testing::Test {
 protected:
  Replay replayed(const TapeContent& tape) {
    return replay(tape, drive_.setup(), intent::shipped_model(), arbitration::usual_draws);
  }
  const TapeContent& tape() {
    static const TapeContent content = TapedDrive().driven(TapedDrive().setup());
    return content;
  }
  static TapeStep& first(TapeContent& tape, const std::function<bool(const TapeStep&)>& is) {
    return *std::find_if(tape.steps.begin(), tape.steps.end(), is);
  }

  TapedDrive drive_;
};

TEST_F(ReplayTest, EverythingComesBackInLockstep) {
  const Replay replay = replayed(tape());
  EXPECT_FALSE(replay.first.has_value())
      << replay.first->what << " " << replay.first->recorded << " " << replay.first->got;
  expect_all(replay.beliefs, 330);
  expect_all(replay.answers, 280);
  expect_all(replay.verdicts, 5);
  expect_all(replay.decisions, 1);
  expect_all(replay.switches, 1);
  EXPECT_EQ(replay.beliefs_not_compared, 0U);
  EXPECT_EQ(replay.verdicts_not_compared, 0U);
}

// Which verdict comes in which step is the threads' affair there, and stands on the tape.
TEST_F(ReplayTest, EverythingComesBackAtRealPace) {
  MeetingClock clock(3);  // this thread, the thinking one and the forecaster's
  const TapeContent real = drive_.driven(drive_.setup(Pace::real, &clock));
  const Replay replay = replayed(real);
  EXPECT_FALSE(replay.first.has_value())
      << replay.first->what << " " << replay.first->recorded << " " << replay.first->got;
  expect_all(replay.verdicts, 20);
  expect_all(replay.decisions, 1);
  expect_all(replay.switches, 1);
}

TEST_F(ReplayTest, OneBitOfASceneThatWasJudgedIsNoticed) {
  TapeContent altered = tape();
  const NumberedVerdict verdict =
      *first(altered, [](const TapeStep& step) { return step.verdict.has_value(); }).verdict;
  double& way = altered.steps.at(verdict.scene).scene.actors[0].X_WA.p.x;
  way = std::nextafter(way, infinity);
  const Replay replay = replayed(altered);
  ASSERT_TRUE(replay.first.has_value());
  EXPECT_LT(replay.verdicts.same + replay.beliefs.same + replay.answers.same,
            replay.verdicts.recorded + replay.beliefs.recorded + replay.answers.recorded);
}

TEST_F(ReplayTest, NamesWhatIsNotTheSame) {
  TapeContent altered = tape();
  const auto harms = [](const reflex::JudgedPlan& one) { return one.harm > 0.0; };
  TapeStep& step = first(altered, [&](const TapeStep& one) {
    return one.verdict &&
           std::any_of(one.verdict->verdict.plans.begin(), one.verdict->verdict.plans.end(), harms);
  });
  auto& plans = step.verdict->verdict.plans;
  reflex::JudgedPlan& plan = *std::find_if(plans.begin(), plans.end(), harms);
  const double recorded = plan.harm;
  plan.harm = std::nextafter(plan.harm, infinity);
  const Replay replay = replayed(altered);
  EXPECT_EQ(replay.verdicts.same + 1, replay.verdicts.recorded);
  ASSERT_TRUE(replay.first.has_value());
  EXPECT_EQ(replay.first->what,
            "verdict.plans[" + std::to_string(&plan - plans.begin()) + "].harm");
  EXPECT_EQ(replay.first->scene, step.number);
  EXPECT_EQ(replay.first->time, step.scene.time);
  EXPECT_EQ(std::stod(replay.first->got), recorded);
  EXPECT_EQ(std::stod(replay.first->recorded), plan.harm);
}

TEST_F(ReplayTest, AnotherDecisionOrSwitchIsNoticed) {
  TapeContent altered = tape();
  TapeStep& trigger = first(altered, [](const TapeStep& step) { return step.reflex.triggered; });
  trigger.decision->source = reflex::Source::model;
  Replay replay = replayed(altered);
  EXPECT_EQ(replay.decisions.same, 0U);
  EXPECT_EQ(replay.first->what, "decision.source");
  EXPECT_EQ(replay.first->recorded, "\"model\"");

  altered = tape();
  TapeStep& change =
      first(altered, [](const TapeStep& step) { return step.reflex.switched.has_value(); });
  change.reflex.switched.reset();
  replay = replayed(altered);
  EXPECT_THAT(replay.first->what, StartsWith("switch"));
  EXPECT_EQ(replay.first->time, change.scene.time);
}

TEST_F(ReplayTest, WithOtherWeightsOfHarmTheVerdictsDiffer) {
  drive_.harm.severe_weight *= 2.0;
  const Replay replay = replayed(tape());
  ASSERT_TRUE(replay.first.has_value());
  EXPECT_LT(replay.verdicts.same, replay.verdicts.recorded);
}

// A drive that is longer than the tape: what is left of it is replayed, and told is what is not.
TEST_F(ReplayTest, WhatIsLeftOfALongDriveIsReplayed) {
  PlanesSetup setup = drive_.setup();
  setup.tape_size = 200 * Tape::step_size(1) / 6;
  const TapeContent content = drive_.driven(setup);
  ASSERT_GT(content.dropped, 0U);
  const Replay replay = replayed(content);
  EXPECT_FALSE(replay.first.has_value()) << replay.first->what;
  EXPECT_EQ(replay.beliefs_not_compared, content.steps.size());
  EXPECT_EQ(replay.decisions.recorded, 1U);
  EXPECT_EQ(replay.decisions.same, 1U);
}

}  // namespace
}  // namespace saca::runtime::replay_test
