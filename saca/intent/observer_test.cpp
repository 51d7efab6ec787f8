#include "saca/intent/observer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>

#include "saca/core/contract.h"
#include "saca/intent/shipped_model.h"
#include "tests/support/count_allocations.h"

namespace saca::intent {
namespace {

using world::Actor;
using world::ActorKind;
using world::Scene;

static_assert(std::is_trivially_copyable_v<Beliefs>);

constexpr double looks_per_second = 100.0;

Scene at(double time) {
  Scene scene;
  scene.time = time;
  scene.ego.v_B = {20.0, 0.0};
  scene.ego_footprint = {.length = 4.7, .width = 1.9};
  scene.ego_mass = 1'700.0;
  return scene;
}

/// Drives at 20 m/s in a lane of its own, ahead of the ego.
Actor car(std::uint8_t id, double deceleration = 0.0) {
  Actor actor{.id = id, .footprint = {.length = 4.5, .width = 1.8}, .mass = 1'500.0};
  actor.X_WA.p = {30.0 + 8.0 * id, 0.0};
  actor.v_W = {20.0, 0.0};
  actor.a_W = {-deceleration, 0.0};
  return actor;
}

Scene with(double time, std::initializer_list<Actor> actors) {
  Scene scene = at(time);
  for (const Actor& actor : actors) {
    scene.actors.push_back(actor);
  }
  return scene;
}

const Model& model = shipped_model();

TEST(Observer, HasOneBeliefPerActorInTheScenesOrder) {
  Observer observer(model);
  const Beliefs& beliefs = observer.look(with(0.0, {car(3), car(1, 6.0), car(2)}));
  ASSERT_EQ(beliefs.size(), 3U);
  EXPECT_EQ(likeliest(beliefs[0].now()), Intention::maintain);
  EXPECT_EQ(likeliest(beliefs[1].now()), Intention::brake);
  EXPECT_EQ(likeliest(beliefs[2].now()), Intention::maintain);
  // The same road users in another order.
  const Beliefs& turned = observer.look(with(0.01, {car(2), car(3), car(1, 6.0)}));
  EXPECT_EQ(likeliest(turned[2].now()), Intention::brake);
  EXPECT_EQ(observer.num_known(), 3U);
  EXPECT_TRUE(observer.look(at(0.02)).empty());
}

TEST(Observer, JudgesAnewEveryTenthOfASecondAndRepeatsItselfBetween) {
  Observer observer(model);
  int changes = 0;
  IntentPosterior last{};
  for (int look = 0; look <= 100; ++look) {
    // Each look brakes a little harder: every new judgement differs from the one before.
    const Actor actor = car(1, 0.02 * look);
    const IntentPosterior now = observer.look(with(look / looks_per_second, {actor}))[0].now();
    if (look % 10 == 0) {
      EXPECT_EQ(now, beliefs_at_sight(model, with(0.0, {actor}))[0].now()) << look;
    }
    changes += now != last ? 1 : 0;
    last = now;
  }
  EXPECT_EQ(changes, 11);  // at 0.0, 0.1, ... 1.0 s
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
  EXPECT_EQ(likeliest(beliefs[0].now()), Intention::maintain);  // not its turn yet
  EXPECT_EQ(likeliest(beliefs[1].now()), Intention::brake);
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
  EXPECT_EQ(likeliest(observer.look(with(0.0, {car(1, 6.0)}))[0].now()), Intention::maintain);
  EXPECT_EQ(likeliest(observer.look(with(0.1, {car(1, 6.0)}))[0].now()), Intention::brake);
}

TEST(Observer, StartsAfreshWhenTimeGoesBack) {
  Observer observer(model);
  (void)observer.look(with(5.0, {car(1), car(2)}));
  const Beliefs& beliefs = observer.look(with(4.95, {car(1, 6.0)}));
  EXPECT_EQ(likeliest(beliefs[0].now()), Intention::brake);
  EXPECT_EQ(observer.num_known(), 1U);
}

TEST(Observer, OneIdOfTwoKindsIsTwoRoadUsers) {
  Actor truck = car(1, 6.0);
  truck.kind = ActorKind::truck;
  Observer observer(model);
  (void)observer.look(with(0.0, {car(1)}));
  const Beliefs& beliefs = observer.look(with(0.05, {truck}));  // the car's belief is not its own
  EXPECT_EQ(likeliest(beliefs[0].now()), Intention::brake);
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
    for (std::size_t i = 4; i < world::max_actors; ++i) {
      EXPECT_EQ(beliefs[i].now(), beliefs_at_sight(model, scene)[i].now()) << round << ' ' << i;
    }
    EXPECT_EQ(observer.num_known(), world::max_actors);
  }
}

TEST(Observer, ACopyGoesItsOwnWay) {
  Observer observer(model);
  (void)observer.look(with(0.0, {car(1)}));
  Observer copy = observer;
  EXPECT_EQ(likeliest(copy.look(with(0.1, {car(1, 6.0)}))[0].now()), Intention::brake);
  EXPECT_EQ(likeliest(observer.look(with(0.1, {car(1)}))[0].now()), Intention::maintain);
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
}  // namespace saca::intent
