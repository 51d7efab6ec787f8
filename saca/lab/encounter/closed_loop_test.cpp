#include "saca/lab/encounter/closed_loop.h"

#include <gmock/gmock.h>

#include <cmath>

#include "saca/lab/encounter/wreck_for_test.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/vehicle/vehicle.h"
#include "saca/thinking/intent/shipped_model.h"

namespace saca::encounter::closed_loop_test {
namespace {

using manoeuvre::PolicyId;

constexpr manoeuvre::Plan braking{PolicyId::aeb, std::nullopt};

class ClosedLoopTest : public testing::Test {
 protected:
  ClosedLoopTest() {
    scenario_.name = "standing_car";
    scenario_.grip = 0.9;
  }
  [[nodiscard]] Stage stage() const { return {&scenario_, &car_, &harm_, &intent_, {}, {}}; }

  /// Goes on to this time, nobody deciding anything.
  static void advance_to(ClosedLoop& loop, double time) {
    while (loop.time() < time - 1e-9) {
      ASSERT_FALSE(loop.look().has_value());
      loop.keep();
      loop.advance();
    }
    ASSERT_FALSE(loop.look().has_value());
  }
  static void to_the_end(ClosedLoop& loop) {
    loop.keep();
    loop.advance();
    while (!loop.over()) {
      ASSERT_FALSE(loop.look().has_value());
      loop.keep();
      loop.advance();
    }
  }

  /// With an avoider to the end; `each` is called at every instant after its answer.
  template <class Each>
  static void avoid(ClosedLoop& loop, Avoider& avoider, Each&& each) {
    while (!loop.over()) {
      ASSERT_FALSE(loop.look().has_value());
      loop.wake();
      each(avoider.step(loop.seen()));
      loop.keep();
      loop.advance(avoider);
      EXPECT_EQ(loop.finished(), avoider.finished());
    }
  }
  AvoiderSetup avoider_setup(std::optional<manoeuvre::Plan> forced = std::nullopt) {
    return {.planes = {.forecast = {&car_, &harm_}, .forced = forced, .clock = &clock_},
            .intent = &intent_};
  }

  SteadyClock clock_;
  scenario::Scenario scenario_ = wreck_on_wet_road();
  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = prepare::read_harm("data/harm.toml").value();
  const intent::Model& intent_ = intent::shipped_model();
};

TEST_F(ClosedLoopTest, WhoNeverTakesTheWheelIsJudgedByNobody) {
  const Stage s = stage();
  ClosedLoop loop(s);
  advance_to(loop, 1.0);
  EXPECT_FALSE(loop.driven());
  EXPECT_EQ(loop.outcome(), std::nullopt);
}

// The brakes are told to decelerate by 3 m/s^2 at most: from 20 m/s that takes 66.7 m, less what
// drag and rolling take, more for the brakes' delay of some tenths of a second.
TEST_F(ClosedLoopTest, BrakesNoHarderThanItIsAskedTo) {
  scenario_.actors.clear();
  const Stage s = stage();
  ClosedLoop loop(s);
  advance_to(loop, 1.0);
  EXPECT_EQ(loop.carry_out(braking, 3.0), std::nullopt);
  const double from = loop.truth().ego().X_WB.p.x;
  for (int k = 0; k < 900; ++k) {
    loop.keep();
    loop.advance();
    ASSERT_FALSE(loop.look().has_value());
    EXPECT_GT(loop.truth().ego().a_B.x, -3.6);  // drag adds 0.15 m/s^2 at 20 m/s
  }
  EXPECT_LT(norm(loop.truth().ego().v_B), 0.1);
  EXPECT_NEAR(loop.truth().ego().X_WB.p.x - from, 20.0 * 20.0 / (2.0 * 3.0), 7.0);
}

TEST_F(ClosedLoopTest, ACopyGoesOnByItselfAndAsTheOriginalWould) {
  const Stage s = stage();
  ClosedLoop loop(s);
  advance_to(loop, 2.5);
  loop.carry_out(braking);
  ClosedLoop copy = loop;
  ClosedLoop other = loop;
  other.carry_out({PolicyId::aes_left, std::nullopt});
  to_the_end(other);
  to_the_end(loop);
  to_the_end(copy);
  ASSERT_TRUE(loop.outcome().has_value());
  EXPECT_EQ(copy.outcome()->clearance, loop.outcome()->clearance);
  EXPECT_EQ(copy.truth().ego().X_WB.p.x, loop.truth().ego().X_WB.p.x);
  EXPECT_NE(other.truth().ego().X_WB.p.x, loop.truth().ego().X_WB.p.x);
  EXPECT_FALSE(loop.contact());  // 35 m are there, 26 m are needed
}

TEST_F(ClosedLoopTest, WhatCannotBeDrivenGivesWayToBraking) {
  std::get<scenario::EgoStart>(scenario_.ego).speed = 4.0;
  const Stage s = stage();
  ClosedLoop loop(s);
  advance_to(loop, 1.0);
  const auto refused = loop.carry_out({PolicyId::t_drift_left, std::nullopt});
  ASSERT_TRUE(refused.has_value());
  EXPECT_EQ(loop.plan(), braking);
}

// Begun at the trigger, braking ends where it does when the loop carries it out from there.
TEST_F(ClosedLoopTest, AnAvoiderDrivesAsTheLoopItselfWould) {
  std::get<scenario::EgoStart>(scenario_.ego).speed = 12.0;
  const Stage s = stage();
  ClosedLoop loop(s);
  std::optional<ClosedLoop> by_itself;
  Avoider avoider(avoider_setup(braking));
  avoid(loop, avoider, [&](const Answer& answer) {
    if (answer.triggered) {
      by_itself.emplace(loop).carry_out(braking);
    }
  });
  ASSERT_TRUE(by_itself.has_value());
  to_the_end(*by_itself);
  EXPECT_EQ(loop.truth().ego().X_WB.p.x, by_itself->truth().ego().X_WB.p.x);
  EXPECT_EQ(loop.outcome().value().clearance, by_itself->outcome().value().clearance);
  EXPECT_EQ(loop.time(), by_itself->time());
  EXPECT_LT(norm(loop.truth().ego().v_B), 0.1);
}

// Braking would hit the wreck on the wet road; the lane beside is free. Once it is recovered the
// stack keeps it, at the speed that it has then.
TEST_F(ClosedLoopTest, TheStackKeepsTheLaneThatTheAvoiderLeavesItIn) {
  scenario_.grip = 0.5;
  const Stage s = stage();
  ClosedLoop loop(s);
  Avoider avoider(avoider_setup(manoeuvre::Plan{PolicyId::aes_left, std::nullopt}));
  std::optional<world::EgoState> given_back;
  bool had_plan = false;
  avoid(loop, avoider, [&](const Answer& answer) {
    if (had_plan && !answer.plan && !given_back) {
      given_back = loop.truth().ego();
    }
    had_plan = had_plan || answer.plan;
  });
  ASSERT_TRUE(given_back.has_value());
  const world::EgoState end = loop.truth().ego();
  EXPECT_FALSE(loop.contact());
  EXPECT_NEAR(end.X_WB.p.y, scenario_.road.lane_width, 0.3);
  EXPECT_NEAR(norm(end.v_B), norm(given_back->v_B), 0.5);
  EXPECT_GT(end.X_WB.p.x, given_back->X_WB.p.x + 15.0);  // for 2 s at the least
}

TEST_F(ClosedLoopTest, AnAvoiderThatHasAPlanTakesTheWheel) {
  const Stage s = stage();
  ClosedLoop loop(s);
  Avoider avoider(avoider_setup());
  while (!avoider.plan()) {
    ASSERT_LT(loop.time(), 5.0);
    ASSERT_FALSE(loop.look().has_value());
    (void)avoider.step(loop.seen());
    EXPECT_FALSE(loop.driven());
    loop.keep();
    loop.advance(avoider);
  }
  EXPECT_TRUE(loop.driven());
}

TEST_F(ClosedLoopTest, ABrokenSceneIsToldAndNotPlayed) {
  scenario_.actors[0].mass = -1.0;
  const Stage s = stage();
  ClosedLoop loop(s);
  const auto problem = loop.look();
  ASSERT_TRUE(problem.has_value());
  EXPECT_THAT(problem->message, testing::StartsWith("standing_car: at 0.00 s: a scene must hold:"));
}

}  // namespace
}  // namespace saca::encounter::closed_loop_test
