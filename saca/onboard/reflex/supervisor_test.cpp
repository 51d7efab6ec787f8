#include "saca/onboard/reflex/supervisor.h"

#include <gtest/gtest.h>

#include <functional>

#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/reflex/verdict_for_test.h"
#include "tests/support/scenes.h"

namespace saca::reflex::supervisor_test {
namespace {

using manoeuvre::PolicyId;

/// A plan under way since 0 s, looked at again and again.
class Watched {
 public:
  explicit Watched(PolicyId policy, double speed = 15.0) : scene_(test::ego_at(speed)) {
    scene_.actors.push_back(test::car(1, {30.0, 0.0}));
    under_way_.plan = {policy, std::nullopt};
    supervisor_.begin(scene_);
  }

  std::optional<Switch> look(const Verdict& verdict, bool threatened = true, bool finished = false,
                             bool by_atlas = false) {
    scene_.time = verdict.time;
    return supervisor_.look({.scene = scene_,
                             .verdict = &verdict,
                             .by_atlas = by_atlas,
                             .under_way = under_way_,
                             .threatened = threatened,
                             .triggers = threatened,
                             .finished = finished},
                            &car_);
  }
  void somebody_comes() { scene_.actors.push_back(test::car(2, {20.0, 3.5})); }
  world::Scene& scene() { return scene_; }
  void carries_out(PolicyId policy) { under_way_.plan = {policy, std::nullopt}; }
  void carries_out(const manoeuvre::Plan& plan) { under_way_.plan = plan; }

 private:
  manoeuvre::Car car_ = prepare::default_car();
  world::Scene scene_;
  UnderWay under_way_;
  Supervisor supervisor_;
};

/// Braking harms this much, a swerve to the left nothing, going on more.
Verdict braking_harms(double time, double harm) {
  return verdict_of(
      time,
      {{PolicyId::aeb, harm}, {PolicyId::aes_left, 0.0}, {PolicyId::no_intervention, harm + 0.1}});
}

TEST(Supervisor, LetsBrakingBecomeASwerveOnceTwoVerdictsWantIt) {
  Watched watched(PolicyId::aeb);
  EXPECT_EQ(watched.look(braking_harms(0.1, 0.05)), std::nullopt);
  EXPECT_EQ(watched.look(braking_harms(0.1, 0.05)), std::nullopt) << "the same verdict again";
  const auto change = watched.look(braking_harms(0.2, 0.05));
  ASSERT_TRUE(change.has_value());
  EXPECT_EQ(change->plan.policy, PolicyId::aes_left);
  EXPECT_EQ(change->reason, SwitchReason::better_by_far);
  EXPECT_EQ(change->harm_before, 0.05);
}

TEST(Supervisor, DoesNotSwitchForLessThanIsMaterial) {
  Watched watched(PolicyId::aeb);
  for (int k = 1; k < 20; ++k) {
    EXPECT_EQ(watched.look(braking_harms(0.1 * k, 0.009)), std::nullopt);
  }
}

// A swerve under way harms 0.1, braking 0.088; doing nothing, 0.103, is as good as braking where
// full braking harms much more, so that it is what would begin. It harms more than the swerve.
TEST(Supervisor, DoesNotBeginWhatHarmsMoreThanWhatIsUnderWay) {
  Watched watched(PolicyId::aes_left);
  for (int k = 1; k < 20; ++k) {
    Verdict verdict = verdict_of(
        0.1 * k,
        {{PolicyId::aeb, 0.6}, {PolicyId::aes_right, 0.088}, {PolicyId::no_intervention, 0.103}});
    verdict.under_way = {
        .plan = {PolicyId::aes_left, std::nullopt}, .drivable = true, .harm = 0.1, .contact = 0.5};
    ASSERT_EQ(plan_of(verdict), manoeuvre::doing_nothing);
    EXPECT_EQ(watched.look(verdict), std::nullopt);
  }
}

TEST(Supervisor, DoesNotSwitchWhereVerdictsDisagree) {
  Watched watched(PolicyId::aeb);
  for (int k = 1; k < 20; ++k) {
    EXPECT_EQ(watched.look(braking_harms(0.1 * k, k % 2 == 0 ? 0.0 : 0.05)), std::nullopt);
  }
}

TEST(Supervisor, SwitchesOnceAndOnceMoreForWhoComes) {
  Watched watched(PolicyId::aeb);
  (void)watched.look(braking_harms(0.1, 0.05));
  ASSERT_TRUE(watched.look(braking_harms(0.2, 0.05)).has_value());
  watched.carries_out(PolicyId::aes_left);
  const auto swerving_harms = [](double time) {
    Verdict verdict = verdict_of(time, {{PolicyId::aeb, 0.0}, {PolicyId::no_intervention, 0.2}});
    verdict.under_way = {
        .plan = {PolicyId::aes_left, std::nullopt}, .drivable = true, .harm = 0.2, .contact = 0.5};
    return verdict;
  };
  for (int k = 3; k < 20; ++k) {
    EXPECT_EQ(watched.look(swerving_harms(0.1 * k)), std::nullopt);
  }
  watched.somebody_comes();
  const auto change = watched.look(swerving_harms(2.5));
  ASSERT_TRUE(change.has_value());
  EXPECT_EQ(change->plan.policy, PolicyId::aeb);
}

// Braking begun now is braking gone on with; of a swerve the verdict has the rest, or it does not
// say.
TEST(Supervisor, KnowsWhatGoingOnIsExpectedToEndIn) {
  Verdict verdict = braking_harms(0.1, 0.05);
  EXPECT_EQ(going_on(verdict, manoeuvre::full_braking)->harm, 0.05);
  EXPECT_EQ(going_on(verdict, manoeuvre::doing_nothing)->harm, 0.05 + 0.1);
  const manoeuvre::Plan swerve{PolicyId::aes_left, std::nullopt};
  EXPECT_EQ(going_on(verdict, swerve), nullptr);
  verdict.under_way = JudgedPlan{.plan = swerve, .drivable = true, .harm = 0.02, .contact = 0.1};
  EXPECT_EQ(going_on(verdict, swerve)->harm, 0.02);
}

TEST(Supervisor, CannotLeaveADrift) {
  Watched watched(PolicyId::t_drift_left);
  for (int k = 1; k < 20; ++k) {
    Verdict verdict = braking_harms(0.1 * k, 0.0);
    verdict.under_way = {.drivable = true, .harm = 0.4, .contact = 1.0};
    EXPECT_EQ(watched.look(verdict), std::nullopt);
  }
}

TEST(Supervisor, ActsAtOnceWhereNothingWasDone) {
  Watched watched(PolicyId::no_intervention);
  EXPECT_EQ(watched.look(verdict_of(0.1, {{PolicyId::aeb, 0.0}, {PolicyId::no_intervention, 0.0}})),
            std::nullopt);
  EXPECT_EQ(watched.look(verdict_of(0.2, {{PolicyId::aeb, 0.0}, {PolicyId::no_intervention, 0.1}}),
                         false),
            std::nullopt)
      << "nobody triggers";
  const auto change =
      watched.look(verdict_of(0.3, {{PolicyId::aeb, 0.0}, {PolicyId::no_intervention, 0.1}}));
  ASSERT_TRUE(change.has_value());
  EXPECT_EQ(change->plan.policy, PolicyId::aeb);
  EXPECT_EQ(change->reason, SwitchReason::needed_after_all);
}

TEST(Supervisor, ActsAgainAfterASwerveHasEnded) {
  Watched watched(PolicyId::aes_left);
  const auto change = watched.look(
      verdict_of(3.0, {{PolicyId::aeb, 0.0}, {PolicyId::no_intervention, 0.1}}), true, true);
  ASSERT_TRUE(change.has_value());
  EXPECT_EQ(change->plan.policy, PolicyId::aeb);
}

TEST(Supervisor, GivesTheWheelBackAfterHalfASecondOfPeace) {
  const auto peace = [](double time) {
    return verdict_of(time, {{PolicyId::aeb, 0.0}, {PolicyId::no_intervention, 0.0}});
  };
  Watched watched(PolicyId::aeb);
  EXPECT_EQ(watched.look(peace(1.0), false), std::nullopt);
  EXPECT_EQ(watched.look(peace(1.4), false), std::nullopt);
  const auto change = watched.look(peace(1.5), false);
  ASSERT_TRUE(change.has_value());
  EXPECT_EQ(change->plan.policy, PolicyId::no_intervention);
  EXPECT_EQ(change->reason, SwitchReason::no_longer_needed);
  // Not while somebody is in conflict, not in between, and not at rest.
  Watched threatened(PolicyId::aeb);
  Watched broken(PolicyId::aeb);
  Watched at_rest(PolicyId::aeb, 0.0);
  for (int k = 0; k < 30; ++k) {
    const double time = 1.0 + 0.1 * k;
    EXPECT_EQ(threatened.look(peace(time), true), std::nullopt);
    EXPECT_EQ(broken.look(k % 4 == 3 ? braking_harms(time, 0.0) : peace(time), false),
              std::nullopt);
    EXPECT_EQ(at_rest.look(peace(time), false), std::nullopt);
  }
}

// Whoever brakes into the way of somebody behind need not go on for half a second.
TEST(Supervisor, LeavesBrakingThatHarmsForDoingNothingThatDoesNot) {
  const auto struck_from_behind = [](double time, double harm_of_nothing) {
    return verdict_of(time, {{PolicyId::aeb, 0.373}, {PolicyId::no_intervention, harm_of_nothing}});
  };
  for (const double harm_of_nothing : {0.0, 0.002}) {  // without and with contact
    Watched watched(PolicyId::aeb);
    EXPECT_EQ(watched.look(struck_from_behind(1.0, harm_of_nothing)), std::nullopt);
    const auto change = watched.look(struck_from_behind(1.1, harm_of_nothing));
    ASSERT_TRUE(change.has_value());
    EXPECT_EQ(change->plan, manoeuvre::doing_nothing);
    EXPECT_EQ(change->reason, SwitchReason::better_by_far);
  }
  // Nothing is begun where nothing was done and that is still the best.
  Watched idle(PolicyId::no_intervention);
  EXPECT_EQ(idle.look(struck_from_behind(1.0, 0.002)), std::nullopt);
}

// At once, as often as verdicts say so, whoever is there; a tie is no reason.
TEST(Supervisor, BrakesHarderAtOnceAndAsOftenAsNeeded) {
  Watched watched(PolicyId::aeb);
  watched.carries_out(braking_at(0.3));
  EXPECT_EQ(watched.look(braking_verdict(0.1, 0.05, 0.02, 0.01, 0.01)), std::nullopt);
  EXPECT_EQ(watched.look(braking_verdict(0.2, 0.05, 0.00995, 0.01, 0.01)), std::nullopt);
  const auto first = watched.look(braking_verdict(0.3, 0.05, 0.02, 0.0095, 0.01));
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(first->plan, braking_at(0.6));
  EXPECT_EQ(first->reason, SwitchReason::harder_needed);
  EXPECT_EQ(first->harm, 0.0095);
  EXPECT_EQ(first->harm_before, 0.01);
  watched.carries_out(first->plan);
  const auto second = watched.look(braking_verdict(0.4, 0.05, 0.1, 0.2, 0.3));
  ASSERT_TRUE(second.has_value());
  EXPECT_EQ(second->plan, manoeuvre::full_braking);
  watched.carries_out(second->plan);
  EXPECT_EQ(watched.look(braking_verdict(0.5, 0.05, 0.1, 0.2, 0.3)), std::nullopt);
}

// Harder now does not use up what else may be begun later, nor does it make a swerve wait longer.
TEST(Supervisor, BrakingHarderLeavesTheOneOtherSwitch) {
  Watched watched(PolicyId::aeb);
  watched.carries_out(braking_at(0.3));
  const auto swerve_is_best = [](double time) {
    Verdict verdict = braking_verdict(time, 0.05, 0.06, 0.07, 0.08);
    add_to(verdict, {PolicyId::aes_left, std::nullopt}, 0.0);
    return verdict;
  };
  const auto harder = watched.look(swerve_is_best(0.1));
  ASSERT_TRUE(harder.has_value());
  EXPECT_EQ(harder->plan, manoeuvre::full_braking);
  watched.carries_out(harder->plan);
  const auto swerve = watched.look(swerve_is_best(0.2));
  ASSERT_TRUE(swerve.has_value());
  EXPECT_EQ(swerve->plan.policy, PolicyId::aes_left);
}

// The other way it takes what any other plan takes: materially better, twice, once.
TEST(Supervisor, BrakesGentlierOnlyWithTheUsualCaution) {
  Watched watched(PolicyId::aeb);
  const auto gentler_is_better = [](double time, double by) {
    return braking_verdict(time, 0.05, 0.05 - by, 0.06, 0.07);
  };
  for (int k = 1; k < 10; ++k) {
    EXPECT_EQ(watched.look(gentler_is_better(0.1 * k, 0.009)), std::nullopt);
  }
  EXPECT_EQ(watched.look(gentler_is_better(1.0, 0.03)), std::nullopt);
  const auto change = watched.look(gentler_is_better(1.1, 0.03));
  ASSERT_TRUE(change.has_value());
  EXPECT_EQ(change->plan, braking_at(0.8));
  EXPECT_EQ(change->reason, SwitchReason::better_by_far);
  watched.carries_out(change->plan);
  const auto still_gentler = [](double time) {
    return braking_verdict(time, 0.1, 0.05, 0.0, 0.07);
  };
  for (int k = 12; k < 20; ++k) {
    EXPECT_EQ(watched.look(still_gentler(0.1 * k)), std::nullopt) << "once";
  }
  watched.somebody_comes();
  const auto again = watched.look(still_gentler(2.5));
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->plan, braking_at(0.6));
}

TEST(Supervisor, GivesTheWheelBackFromGentleBrakingToo) {
  Watched watched(PolicyId::aeb);
  watched.carries_out(braking_at(0.3));
  const auto peace = [](double time) {
    return verdict_of(time, {{PolicyId::aeb, 0.0}, {PolicyId::no_intervention, 0.0}});
  };
  EXPECT_EQ(watched.look(peace(1.0), false), std::nullopt);
  const auto change = watched.look(peace(1.5), false);
  ASSERT_TRUE(change.has_value());
  EXPECT_EQ(change->reason, SwitchReason::no_longer_needed);
}

// The atlas knows one motion of each road user: by its word nothing that was begun is given up.
TEST(Supervisor, ByTheAtlasOnlyDoesMore) {
  const auto peace = [](double time) {
    return verdict_of(time, {{PolicyId::aeb, 0.0}, {PolicyId::no_intervention, 0.0}});
  };
  const auto swerve = [](double time) {
    return verdict_of(
        time, {{PolicyId::aeb, 0.3}, {PolicyId::aes_left, 0.0}, {PolicyId::no_intervention, 0.5}});
  };
  for (const auto& verdict : {std::function<Verdict(double)>(peace), {swerve}}) {
    Watched watched(PolicyId::aeb);
    watched.carries_out(braking_at(0.3));
    Watched trusting(PolicyId::aeb);
    trusting.carries_out(braking_at(0.3));
    bool switched = false;
    for (int k = 0; k < 10; ++k) {
      const double time = 1.0 + 0.1 * k;
      EXPECT_EQ(watched.look(verdict(time), false, false, true), std::nullopt) << time;
      switched = switched || trusting.look(verdict(time), false);
    }
    EXPECT_TRUE(switched) << "by the forecaster's it would be";
  }
  Watched harder(PolicyId::aeb);
  harder.carries_out(braking_at(0.3));
  const auto change = harder.look(braking_verdict(1.0, 0.0, 0.1, 0.2, 0.3), true, false, true);
  ASSERT_TRUE(change.has_value());
  EXPECT_EQ(change->reason, SwitchReason::harder_needed);
}

TEST(Supervisor, AfterTheAtlasTheForecasterIsLookedAtAtOnce) {
  Watched watched(PolicyId::no_intervention);
  const auto nothing = [](double time) {
    return verdict_of(time, {{PolicyId::aeb, 0.0}, {PolicyId::no_intervention, 0.0}});
  };
  EXPECT_EQ(watched.look(nothing(1.0), true, false, true), std::nullopt);
  const auto change = watched.look(
      verdict_of(1.01, {{PolicyId::aeb, 0.0}, {PolicyId::no_intervention, 0.5}}), true);
  ASSERT_TRUE(change.has_value());
  EXPECT_EQ(change->harm_before, 0.5);
}

TEST(Supervisor, BeginsNothingThatCannotBeDriven) {
  Watched watched(PolicyId::aeb);
  watched.scene().ego.v_B = {3.0, 0.0};  // too slow for a lane change
  for (int k = 1; k < 20; ++k) {
    EXPECT_EQ(watched.look(braking_harms(0.1 * k, 0.2)), std::nullopt);
  }
}

}  // namespace
}  // namespace saca::reflex::supervisor_test
