#include "saca/lab/eval/yardstick.h"

#include <gmock/gmock.h>

#include "saca/base/core/contract.h"
#include "saca/lab/eval/scenes_for_test.h"
#include "saca/lab/scenario/chance.h"
#include "saca/onboard/collision/ordering.h"
#include "saca/thinking/intent/shipped_model.h"

namespace saca::eval::yardstick_test {
namespace {

using manoeuvre::PolicyId;

class Yardstick : public testing::Test {
 protected:
  Yardstick() : scenario_(standing_car(19.0, 40.0)) {
    // Ice under the wheels where a dry road is believed in: only who knows can tell.
    stage_.chance.car.grip = 0.4;
  }
  encounter::ClosedLoop at(double time) {
    encounter::ClosedLoop loop(stage_);
    while (loop.time() < time - 1e-9) {
      EXPECT_FALSE(loop.look().has_value());
      loop.advance();
    }
    EXPECT_FALSE(loop.look().has_value());
    loop.take_the_wheel();
    return loop;
  }

  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = shipped_harm();
  scenario::Scenario scenario_;
  encounter::Stage stage_{&scenario_, &car_, &harm_, &intent::shipped_model(), {}, {}};
};

// 31 m to go at 19 m/s: 20.5 m are needed on a grip of 0.9, 51 m on 0.36.
TEST_F(Yardstick, WhoKnowsOnlyTheMotionsTakesTheRoadForWhatItSeems) {
  const encounter::ClosedLoop loop = at(0.47);
  const auto braking_meets = [&](Knowledge knowledge) {
    for (const preview::RolledOut& one : try_all(loop, car_, harm_, knowledge)) {
      if (one.facts.plan.policy == PolicyId::aeb) {
        return one.facts.outcome().contact.has_value();
      }
    }
    throw std::logic_error("braking was not tried");
  };
  EXPECT_FALSE(braking_meets(Knowledge::motions));
  EXPECT_TRUE(braking_meets(Knowledge::everything));
}

TEST_F(Yardstick, TheBestAsPublishedBrakesWithAllTheGripOrNotAtAll) {
  auto tried = try_all(at(0.7), car_, harm_, Knowledge::everything);
  EXPECT_EQ(tried[best_of(tried, forecast::Braking::full)].facts.plan.strength, std::nullopt);
  for (preview::RolledOut& one : tried) {  // gentle braking alone harms nobody
    if (one.facts.drivable()) {
      one.facts.outcome().harm = one.facts.plan.strength == 0.45 ? 0.0 : 1.0;
    }
  }
  EXPECT_EQ(tried[best_of(tried)].facts.plan.strength, 0.45);
  EXPECT_EQ(tried[best_of(tried, forecast::Braking::full)].facts.plan.strength, std::nullopt);
}

TEST_F(Yardstick, NoneIsBetterThanTheBestByTheOneOrdering) {
  const auto tried = try_all(at(0.7), car_, harm_, Knowledge::everything);
  const preview::PolicyFacts& best = tried[best_of(tried)].facts;
  for (const preview::RolledOut& one : tried) {
    if (one.facts.drivable()) {
      EXPECT_FALSE(collision::better(one.facts.outcome(), one.facts.plan.policy, best.outcome(),
                                     best.plan.policy));
    }
  }
  EXPECT_THROW((void)best_of({}), ContractViolation);
}

TEST_F(Yardstick, AnInstantIsTriedOnceWhoeverAsks) {
  Hindsight hindsight(car_, harm_);
  const encounter::ClosedLoop loop = at(0.5);
  const auto* const first = hindsight.at(loop).data();
  EXPECT_EQ(hindsight.at(loop).data(), first);
  const double harm = hindsight.at(loop)[0].facts.outcome().harm;
  EXPECT_NE(hindsight.at(at(1.2))[0].facts.outcome().harm, harm);  // nearer: harder
}

}  // namespace
}  // namespace saca::eval::yardstick_test
