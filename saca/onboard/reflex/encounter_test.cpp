#include "saca/onboard/reflex/encounter.h"

#include <gtest/gtest.h>

#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "tests/support/count_allocations.h"
#include "tests/support/scenes.h"

namespace saca::reflex::encounter_test {
namespace {

using manoeuvre::PolicyId;

/// A car on its model, and an encounter that hears of what the test lets the plane say.
class Drive {
 public:
  explicit Drive(double speed) : scene_(test::ego_alone(speed, 0.9)) {
    scene_.ego_footprint = manoeuvre::footprint(car_);
    scene_.ego_mass = car_.mass;
    state_ = manoeuvre::rolling_state(car_, scene_.ego, scene_.grip);
  }

  bool hear(const Reflex& answer) { return encounter_.look(scene_, answer); }
  /// A tenth of a second of driving, and a look at which the plane says nothing new.
  bool go_on(bool threatened) {
    for (int k = 0; k < 100; ++k) {
      const vehicle::Command command = encounter_.control(state_, 0.001);
      state_ = vehicle::step(car_, state_, command, scene_.grip, 0.001);
    }
    scene_.time += 0.1;
    scene_.ego = manoeuvre::ego_state(state_);
    return hear(quiet(threatened));
  }
  static Reflex quiet(bool threatened = false) {
    Reflex answer;
    if (threatened) {
      answer.threat = Threat{.actor = 0, .time = 1.0};
    }
    return answer;
  }
  static Reflex trigger(PolicyId policy) {
    Reflex answer = quiet(true);
    answer.plan = {policy, std::nullopt};
    answer.triggered = true;
    return answer;
  }
  Encounter& encounter() { return encounter_; }
  void pushed_to(double speed) {
    scene_.ego.v_B = {speed, 0.0};
    state_ = manoeuvre::rolling_state(car_, scene_.ego, scene_.grip);
    (void)hear(quiet());
  }
  [[nodiscard]] double speed() const { return norm(scene_.ego.v_B); }
  world::Scene& scene() { return scene_; }

 private:
  manoeuvre::Car car_ = prepare::default_car();
  world::Scene scene_;
  vehicle::VehicleState state_;
  Encounter encounter_{car_};
};

TEST(Encounter, WithNobodyThereIsNoneAndNeverOver) {
  Drive drive(15.0);
  for (int k = 0; k < 50; ++k) {
    EXPECT_FALSE(drive.go_on(false));
  }
  EXPECT_FALSE(drive.encounter().meets_somebody());
  EXPECT_EQ(drive.encounter().plan(), std::nullopt);
  const vehicle::Command command = drive.encounter().control({}, 0.001);
  EXPECT_EQ(command.steering, 0.0);
  EXPECT_EQ(command.brake_torque, vehicle::PerWheel{});
}

TEST(Encounter, IsOverTwoSecondsAfterTheLastThreat) {
  Drive drive(15.0);
  EXPECT_FALSE(drive.go_on(true));
  int looks = 1;
  while (!drive.go_on(false)) {
    ASSERT_LT(++looks, 100);
  }
  EXPECT_NEAR(0.1 * (looks - 1), Encounter::quiet_time, 0.11);
}

// Full braking on grip 0.9 from 15 m/s takes some 15 / (0.9 g) = 1.7 s.
TEST(Encounter, HoldsWhoHasBrakedToRestAndIsOverThen) {
  Drive drive(15.0);
  (void)drive.hear(Drive::trigger(PolicyId::aeb));
  int looks = 0;
  while (drive.speed() > 0.0) {
    EXPECT_FALSE(drive.go_on(true));
    ASSERT_LT(++looks, 30);
  }
  EXPECT_NEAR(0.1 * looks, 15.0 / (0.9 * vehicle::gravity), 0.4);
  EXPECT_TRUE(drive.encounter().finished());
  ASSERT_TRUE(drive.encounter().plan().has_value()) << "brakes hold";
  EXPECT_EQ(drive.encounter().plan()->policy, PolicyId::aeb);
  bool over = false;
  for (int k = 0; k < 22; ++k) {
    over = drive.go_on(false);
    EXPECT_EQ(drive.speed(), 0.0);
    if (over) {
      break;
    }
  }
  EXPECT_TRUE(over);
  drive.encounter().begin_anew();
  EXPECT_EQ(drive.encounter().plan(), std::nullopt);
  EXPECT_FALSE(drive.encounter().meets_somebody());
}

// Sensors never say exactly 0: a gyroscope drifts, wheels and position flicker.
TEST(Encounter, IsOverForACarThatMeasuresAlmostNothing) {
  Drive drive(0.0);
  (void)drive.hear(Drive::trigger(PolicyId::aeb));
  vehicle::VehicleState state;
  state.v_B = {0.01, -0.005};
  state.yaw_rate = 2e-3;
  (void)drive.encounter().control(state, 0.001);
  EXPECT_TRUE(drive.encounter().finished());
  state.v_B.x = 0.2;
  Drive crawls(0.2);
  (void)crawls.hear(Drive::trigger(PolicyId::aeb));
  (void)crawls.encounter().control(state, 0.001);
  EXPECT_FALSE(crawls.encounter().finished());
}

// Stopped, and then hit from behind: the brakes stop it again.
TEST(Encounter, BrakesAgainWhoIsPushed) {
  Drive drive(15.0);
  (void)drive.hear(Drive::trigger(PolicyId::aeb));
  for (int k = 0; k < 30; ++k) {
    (void)drive.go_on(true);
  }
  ASSERT_EQ(drive.speed(), 0.0);
  for (int k = 0; k < 19; ++k) {  // nobody is in the way any more, for almost as long as it takes
    ASSERT_FALSE(drive.go_on(false));
  }
  drive.pushed_to(6.0);
  for (int k = 0; k < 12; ++k) {
    ASSERT_FALSE(drive.go_on(false));
    ASSERT_TRUE(drive.encounter().plan().has_value());
  }
  EXPECT_EQ(drive.speed(), 0.0);
}

TEST(Encounter, GivesARecoveredLaneBack) {
  Drive drive(15.0);
  (void)drive.hear(Drive::trigger(PolicyId::aes_left));
  EXPECT_EQ(drive.encounter().plan()->policy, PolicyId::aes_left);
  int looks = 0;
  while (drive.encounter().plan()) {
    EXPECT_FALSE(drive.go_on(false));
    ASSERT_LT(++looks, 80);
  }
  EXPECT_TRUE(drive.encounter().finished());
  EXPECT_GT(drive.speed(), 13.0);
  EXPECT_NEAR(drive.scene().ego.X_WB.p.y, drive.scene().road.lane_width, 0.5);
}

TEST(Encounter, DoingNothingGivesTheWheelBack) {
  Drive drive(15.0);
  (void)drive.hear(Drive::trigger(PolicyId::aeb));
  Reflex back = Drive::quiet();
  back.plan = manoeuvre::doing_nothing;
  back.switched = Switch{.plan = back.plan, .reason = SwitchReason::no_longer_needed};
  (void)drive.hear(back);
  EXPECT_EQ(drive.encounter().plan(), std::nullopt);
  EXPECT_TRUE(drive.encounter().meets_somebody());
}

TEST(Encounter, ABrokenSceneChangesNothing) {
  Drive drive(15.0);
  (void)drive.hear(Drive::trigger(PolicyId::aeb));
  drive.scene().time += 100.0;
  Reflex refused;
  refused.refused_scene = true;
  EXPECT_FALSE(drive.hear(refused));
  EXPECT_EQ(drive.encounter().plan()->policy, PolicyId::aeb);
}

TEST(Encounter, AllocatesNothing) {
  Drive drive(15.0);
  const std::size_t before = num_allocations;
  (void)drive.hear(Drive::trigger(PolicyId::aes_right));
  for (int k = 0; k < 10; ++k) {
    (void)drive.go_on(true);
  }
  EXPECT_EQ(num_allocations, before);
}

}  // namespace
}  // namespace saca::reflex::encounter_test
