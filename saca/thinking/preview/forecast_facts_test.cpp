#include "saca/thinking/preview/forecast_facts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/onboard/collision/ordering.h"
#include "saca/onboard/forecast/futures.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/preview/forecast_for_test.h"
#include "tests/support/scenes.h"

namespace saca::preview::forecast_facts_test {
namespace {

using atlas::small_atlas;
using atlas::small_atlas_car;
using manoeuvre::PolicyId;
using world::Actor;
using world::Scene;
using world::Track;

/// A wreck so far ahead of the bumper; two lanes to the left of the ego, one to its right.
struct Road {
  Scene scene;
  std::vector<Track> tracks;

  Road(double speed, double gap) {
    scene = test::ego_at(speed, manoeuvre::footprint(small_atlas_car()));
    scene.ego_mass = small_atlas_car().mass;
    scene.road.left_edge = 8.75;
    scene.road.right_edge = -5.25;
    add({support(scene.ego_footprint, {}, {1.0, 0.0}).x + gap + 2.25, 0.0}, 0.0);
  }
  void add(Vec2 p_W, double speed) {
    const auto id = static_cast<std::uint8_t>(scene.actors.size() + 1);
    const Actor actor = test::car(id, p_W, {speed, 0.0});
    scene.actors.push_back(actor);
    Track track{.step = 0.05, .X_WA = {}};
    for (int k = 0; k <= 200; ++k) {
      track.X_WA.push_back({p_W + track.step * k * actor.v_W, 0.0});
    }
    tracks.push_back(track);
  }
  [[nodiscard]] AllFacts facts(const ForecastTools& tools) const {
    return policy_facts(scene, tracks, tools);
  }
};

const PolicyFacts& of(const AllFacts& facts, PolicyId policy) {
  return facts[manoeuvre::index(policy)];
}

// 26 m to a wreck at 20 m/s: going on hits at 20 m/s; both lane changes are clear where the road
// has the lanes.
TEST(PolicyFacts, SayWhatEachPolicyEndsIn) {
  const AllFacts facts = Road(20.0, 26.0).facts(rolling());
  const collision::Outcome& nothing = of(facts, PolicyId::no_intervention).outcome();
  ASSERT_TRUE(nothing.contact.has_value());
  EXPECT_NEAR(nothing.contact->relative_speed, 20.0, 0.3);
  EXPECT_EQ(nothing.contact->ego_face, collision::Face::front);
  EXPECT_FALSE(of(facts, PolicyId::aes_left).outcome().contact.has_value());
  EXPECT_TRUE(of(facts, PolicyId::es_b_left).plan.target_speed.has_value());
  EXPECT_TRUE(of(facts, PolicyId::t_drift_left).drivable());
  const PolicyFacts& best = of(facts, best_by_forecast(facts));
  for (const PolicyFacts& fact : facts) {
    EXPECT_FALSE(std::holds_alternative<ExpectedOutcome>(fact.end));
    if (fact.drivable()) {
      EXPECT_FALSE(
          collision::better(fact.outcome(), fact.plan.policy, best.outcome(), best.plan.policy))
          << name(fact.plan.policy);
    }
  }
}

// 19.5 m to a wreck at 15 m/s are enough to stop; with a car 4.3 m behind, who brakes is run into
// before it reacts, and who changes the lane is not. Likewise by the atlas, at 12.5 m/s and 13 m.
TEST(PolicyFacts, BeingHitFromBehindCounts) {
  struct Case {
    double speed, gap;
    ForecastTools tools;
  };
  for (Case one : {Case{15.0, 19.5, rolling()}, Case{12.5, 14.0, reading()}}) {
    one.tools.braking = forecast::Braking::full;
    Road road(one.speed, one.gap);
    const AllFacts alone = road.facts(one.tools);
    road.add({-9.0, 0.0}, one.speed);
    const AllFacts followed = road.facts(one.tools);
    EXPECT_EQ(rolled_out(followed), one.tools.atlas == nullptr);
    EXPECT_FALSE(of(alone, PolicyId::aeb).outcome().contact.has_value());
    ASSERT_TRUE(of(followed, PolicyId::aeb).outcome().contact.has_value());
    EXPECT_EQ(of(followed, PolicyId::aeb).outcome().contact->ego_face, collision::Face::rear);
    EXPECT_GT(of(followed, PolicyId::aeb).outcome().harm, of(alone, PolicyId::aeb).outcome().harm);
    EXPECT_EQ(of(followed, PolicyId::aes_left).outcome().harm,
              of(alone, PolicyId::aes_left).outcome().harm);
  }
}

// 60 m to the wreck are enough for a third of the grip; the car behind needs time that full braking
// does not leave it. Nobody behind: nothing is gained, and it is full braking.
TEST(PolicyFacts, BrakingIsAsHardAsIsBest) {
  for (const ForecastTools& tools : {rolling(), reading()}) {
    Road road(12.5, 60.0);
    EXPECT_EQ(of(road.facts(tools), PolicyId::aeb).plan, manoeuvre::full_braking);
    road.add({-11.0, 0.0}, 12.5);
    const PolicyFacts best = of(road.facts(tools), PolicyId::aeb);
    EXPECT_LT(strength_of(best.plan), 1.0);
    ForecastTools published = tools;
    published.braking = forecast::Braking::full;
    const PolicyFacts full = of(road.facts(published), PolicyId::aeb);
    EXPECT_EQ(full.plan, manoeuvre::full_braking);
    EXPECT_LT(best.outcome().harm, full.outcome().harm);
  }
}

// What the atlas says is what full dynamics say, up to its error, where nobody is struck twice.
TEST(PolicyFacts, ReadAndRolledOutAgree) {
  for (const double gap : {6.0, 14.0, 30.0, 80.0}) {
    Road road(12.4, gap);
    if (gap > 50.0) {  // who swerves leaves the road over a kerb
      road.scene.road.left_edge = 1.75;
      road.scene.road.left_beyond = world::Beyond::kerb;
    }
    const AllFacts read = road.facts(reading());
    const AllFacts rolled = road.facts(rolling());
    for (std::size_t i = 0; i < read.size(); ++i) {
      EXPECT_FALSE(std::holds_alternative<RolledOutcome>(read[i].end));
      ASSERT_EQ(read[i].drivable(), rolled[i].drivable());
      if (!read[i].drivable() || read[i].plan != rolled[i].plan) {
        continue;  // equals within the error may be chosen differently
      }
      const std::string_view policy = name(read[i].plan.policy);
      EXPECT_EQ(read[i].outcome().contact.has_value(), rolled[i].outcome().contact.has_value())
          << policy << gap;
      EXPECT_NEAR(read[i].outcome().clearance, rolled[i].outcome().clearance, 0.3) << policy << gap;
      EXPECT_NEAR(read[i].outcome().collision_loss, rolled[i].outcome().collision_loss, 0.15)
          << policy << gap;
    }
  }
}

// The small atlas ends at 13 m/s.
TEST(PolicyFacts, OutsideTheAtlasAllIsRolledOut) {
  for (const PolicyFacts& fact : Road(14.0, 20.0).facts(reading())) {
    EXPECT_FALSE(std::holds_alternative<ExpectedOutcome>(fact.end));
  }
}

// Half the speed is too much where the next lane is closed at its end; the choice is the best.
TEST(PolicyFacts, TheTargetSpeedIsTheBestOfItsGrid) {
  Road road(20.0, 16.0);
  road.add({30.0, 3.5}, 0.0);  // stands in the lane to the left
  const AllFacts facts = road.facts(rolling());
  const PolicyFacts& chosen = of(facts, PolicyId::es_b_left);
  std::vector<manoeuvre::Plan> plans;
  for (const double share : forecast::target_shares) {
    plans.push_back({PolicyId::es_b_left, share * 20.0});
  }
  for (const PolicyFacts& one : rolled_out(road.scene, road.tracks, plans, rolling())) {
    EXPECT_FALSE(collision::better(one.outcome(), PolicyId::es_b_left, chosen.outcome(),
                                   PolicyId::es_b_left))
        << *one.plan.target_speed;
  }
}

TEST(PolicyFacts, NeedCarAndHarm) {
  EXPECT_THROW((void)Road(12.0, 20.0).facts({}), ContractViolation);
}

TEST(BestByForecast, DoesNothingWhereNothingThreatens) {
  Road road(12.5, 20.0);
  road.scene.actors.clear();
  road.tracks.clear();
  EXPECT_EQ(best_by_forecast(road.facts(rolling())), PolicyId::no_intervention);
  EXPECT_EQ(best_by_forecast(road.facts(reading())), PolicyId::no_intervention);
}

}  // namespace
}  // namespace saca::preview::forecast_facts_test
