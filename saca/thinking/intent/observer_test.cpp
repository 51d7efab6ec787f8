#include "saca/thinking/intent/observer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "saca/base/core/contract.h"
#include "saca/thinking/intent/observed.h"
#include "saca/thinking/intent/shipped_model.h"
#include "tests/support/count_allocations.h"
#include "tests/support/scenes.h"

namespace saca::intent::observer_test {
namespace {

using world::Actor;
using world::ActorKind;
using world::Scene;

static_assert(std::is_trivially_copyable_v<Beliefs>);

constexpr double looks_per_second = 100.0;

Scene at(double time) {
  Scene scene = test::ego_at(20.0);
  scene.time = time;
  return scene;
}

/// Drives at 20 m/s in a lane of its own, ahead of the ego.
Actor car(std::uint8_t id, double deceleration = 0.0) {
  return test::car(id, {30.0 + 8.0 * id, 0.0}, {20.0, 0.0}, {-deceleration, 0.0});
}

Scene with(double time, std::initializer_list<Actor> actors) {
  Scene scene = at(time);
  for (const Actor& actor : actors) {
    scene.actors.push_back(actor);
  }
  return scene;
}

const Model& model = shipped_model();

/// How likely it is thought to brake now, moving aside or not.
double braking(const Belief& belief) {
  const auto of = [&](Intention intention) {
    return belief.now()[static_cast<std::size_t>(intention)];
  };
  return of(Intention::brake) + of(Intention::brake_left) + of(Intention::brake_right);
}

/// Of a car that is seen for the first time, not braking or with 6 m/s^2.
double braking_at_sight(double deceleration) {
  return braking(beliefs_at_sight(model, with(0.0, {car(1, deceleration)}))[0]);
}

TEST(Observer, WhoHasLearntNothingTakesAllToGoOn) {
  const Model none;
  Observer observer(none);
  Actor vru = car(2);
  vru.kind = ActorKind::pedestrian;
  vru.v_W = {0.0, 1.5};
  const Scene scene = with(0.0, {car(1, 8.0), vru});
  constexpr auto maintains = static_cast<std::size_t>(Intention::maintain);
  EXPECT_LT(beliefs_at_sight(model, scene)[0].now()[maintains], 0.9);
  EXPECT_LT(beliefs_at_sight(model, scene)[1].now()[maintains], 0.9);
  for (const Belief& belief : observer.look(scene)) {
    for (const IntentPosterior& at : belief.at) {
      EXPECT_EQ(at[maintains], 1.0);
    }
  }
}

TEST(Observer, HardBrakingIsBelievedWithinThreeTenths) {
  Observer observer(model);
  for (int look = 0; look <= 40; ++look) {
    const double time = 0.1 * look;
    Actor actor = car(1, time > 2.0 ? 6.0 : 0.0);
    actor.v_W.x = 20.0 - 6.0 * std::max(0.0, time - 2.0);
    const Beliefs& beliefs = observer.look(with(time, {actor}));
    if (time < 2.05) {
      EXPECT_LT(braking(beliefs[0]), 0.2) << time;
    } else if (time > 2.35) {
      EXPECT_GT(braking(beliefs[0]), 0.8) << time;
    }
  }
}

TEST(Observer, HasOneBeliefPerActorInTheScenesOrder) {
  ASSERT_GT(braking_at_sight(6.0), braking_at_sight(0.0));
  Observer observer(model);
  const Beliefs& beliefs = observer.look(with(0.0, {car(3), car(1, 6.0), car(2)}));
  ASSERT_EQ(beliefs.size(), 3U);
  const double of_one = braking(beliefs[1]);
  EXPECT_LT(braking(beliefs[0]), of_one);
  EXPECT_LT(braking(beliefs[2]), of_one);
  // The same road users in another order.
  const Beliefs& turned = observer.look(with(0.01, {car(2), car(3), car(1, 6.0)}));
  EXPECT_EQ(braking(turned[2]), of_one);
  EXPECT_EQ(observer.num_known(), 3U);
  EXPECT_TRUE(observer.look(at(0.02)).empty());
}

TEST(Observer, StepsEachVehiclesStreamEveryTenthOfASecondAndRepeatsItselfBetween) {
  Observer observer(model);
  Stream stream;
  HorizonScores told{};
  for (int look = 0; look <= 100; ++look) {
    const Scene scene = with(look / looks_per_second, {car(1, 0.05 * look)});
    if (look % 10 == 0) {
      told = stream.step(model, observed(scene, 0));
    }
    const Beliefs& beliefs = observer.look(scene);
    for (std::size_t h = 0; h < num_horizons; ++h) {
      for (std::size_t k = 0; k < num_classes; ++k) {
        EXPECT_EQ(beliefs[0].at[h][k], told[h][k]) << look;
      }
    }
  }
}

TEST(Observer, WhoStandsMaintainsAndIsRememberedAllTheSame) {
  Observer observer(model);
  Actor actor = car(1);
  actor.v_W = {};
  const Beliefs& beliefs = observer.look(with(0.0, {actor}));
  for (const IntentPosterior& each : beliefs[0].at) {
    EXPECT_EQ(each[0], 1.0);
  }
  Stream stream;
  stream.step(model, observed(with(0.0, {actor}), 0));
  const Scene next = with(0.1, {car(1)});
  EXPECT_EQ(observer.look(next)[0].now()[0], stream.step(model, observed(next, 0))[0][0]);
}

TEST(Observer, KeepsToTheGridWhereLooksFallBesideIt) {
  Observer observer(model);
  IntentPosterior last{};
  std::vector<int> changed;
  for (int look = 0; look <= 10; ++look) {  // every 40 ms
    const IntentPosterior now = observer.look(with(0.04 * look, {car(1, 0.1 * look)}))[0].now();
    if (now != last) {
      changed.push_back(look);
    }
    last = now;
  }
  // The first at or after 0, 0.1, 0.2, 0.3, 0.4 s.
  EXPECT_EQ(changed, (std::vector<int>{0, 3, 5, 8, 10}));
}

TEST(Observer, JudgesWhoIsNewAtOnce) {
  Observer observer(model);
  (void)observer.look(with(0.0, {car(1)}));
  const Beliefs& beliefs = observer.look(with(0.03, {car(1, 6.0), car(2, 6.0)}));
  EXPECT_EQ(braking(beliefs[0]), braking_at_sight(0.0));  // not its turn yet
  EXPECT_GT(braking(beliefs[1]), braking(beliefs[0]));
}

TEST(Observer, ForgetsWhoHasBeenGoneForTwoSeconds) {
  Observer observer(model);
  (void)observer.look(with(0.0, {car(1), car(2)}));
  (void)observer.look(with(1.99, {car(2)}));
  EXPECT_EQ(observer.num_known(), 2U);
  (void)observer.look(with(2.0, {car(2)}));
  EXPECT_EQ(observer.num_known(), 1U);
  (void)observer.look(with(9.0, {car(1), car(2)}));  // nobody was there for long
  EXPECT_EQ(observer.num_known(), 2U);
}

TEST(Observer, TheSameInstantTwiceIsJudgedOnce) {
  Observer observer(model);
  (void)observer.look(with(0.0, {car(1)}));
  EXPECT_EQ(braking(observer.look(with(0.0, {car(1, 6.0)}))[0]), braking_at_sight(0.0));
  EXPECT_NE(braking(observer.look(with(0.1, {car(1, 6.0)}))[0]), braking_at_sight(0.0));
}

TEST(Observer, StartsAfreshWhenTimeGoesBack) {
  Observer observer(model);
  (void)observer.look(with(5.0, {car(1), car(2)}));
  const Beliefs& beliefs = observer.look(with(4.95, {car(1, 6.0)}));
  EXPECT_EQ(braking(beliefs[0]), braking_at_sight(6.0));
  EXPECT_EQ(observer.num_known(), 1U);
}

TEST(Observer, OneIdOfTwoKindsIsTwoRoadUsers) {
  Actor truck = car(1, 6.0);
  truck.kind = ActorKind::truck;
  Observer observer(model);
  (void)observer.look(with(0.0, {car(1)}));
  const Beliefs& beliefs = observer.look(with(0.05, {truck}));  // the car's belief is not its own
  EXPECT_EQ(braking(beliefs[0]), braking_at_sight(6.0));
  EXPECT_EQ(observer.num_known(), 2U);
}

TEST(Observer, HasRoomForWhoIsThereWhoeverWasThereBefore) {
  Observer observer(model);
  for (int round = 0; round < 8; ++round) {  // 224 road users within 0.8 s, 4 of them always there
    Scene scene = at(0.1 * round);
    for (std::uint8_t id = 1; id <= 4; ++id) {
      scene.actors.push_back(car(id));
    }
    for (std::size_t i = 0; i < world::max_actors - 4; ++i) {
      Actor actor = car(static_cast<std::uint8_t>(i + 5));
      actor.kind = static_cast<ActorKind>(round % 4);
      actor.id = static_cast<std::uint8_t>(actor.id + 30 * (round / 4));
      actor.a_W.x = round % 2 == 0 ? 0.0 : -6.0;
      scene.actors.push_back(actor);
    }
    const Beliefs& beliefs = observer.look(scene);
    ASSERT_EQ(beliefs.size(), world::max_actors);
    const Beliefs fresh = beliefs_at_sight(model, scene);
    for (std::size_t i = 4; i < world::max_actors; ++i) {
      EXPECT_EQ(beliefs[i].now(), fresh[i].now()) << round << ' ' << i;
    }
    EXPECT_EQ(observer.num_known(), world::max_actors);
  }
}

TEST(Observer, ACopyGoesItsOwnWay) {
  Observer observer(model);
  (void)observer.look(with(0.0, {car(1)}));
  Observer copy = observer;
  const double of_copy = braking(copy.look(with(0.1, {car(1, 6.0)}))[0]);
  const double of_original = braking(observer.look(with(0.1, {car(1)}))[0]);
  EXPECT_GT(of_copy, of_original);
  Observer again(model);
  (void)again.look(with(0.0, {car(1)}));
  EXPECT_EQ(braking(again.look(with(0.1, {car(1)}))[0]), of_original);  // the copy left no trace
}

TEST(Observer, AllocatesNothing) {
  Observer observer(model);
  Scene scene = at(0.0);
  for (std::uint8_t id = 1; id <= world::max_actors; ++id) {
    scene.actors.push_back(car(id));
  }
  const std::size_t before = num_allocations;
  for (int look = 0; look < 300; ++look) {
    scene.time = look / looks_per_second;
    scene.actors[0].id = static_cast<std::uint8_t>(100 + look / 30);
    (void)observer.look(scene);
  }
  EXPECT_EQ(num_allocations, before);
}

TEST(Observer, RefusesABrokenScene) {
  Observer observer(model);
  Scene broken = with(0.0, {car(1)});
  broken.actors[0].v_W.x = std::nan("");
  EXPECT_THROW((void)observer.look(broken), ContractViolation);
  broken = at(std::nan(""));
  EXPECT_THROW((void)observer.look(broken), ContractViolation);
  EXPECT_THROW((void)beliefs_at_sight(model, with(0.0, {car(1), car(1)})), ContractViolation);
}

}  // namespace
}  // namespace saca::intent::observer_test
