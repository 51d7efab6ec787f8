#include "saca/thinking/preview/preview.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "saca/base/core/contract.h"
#include "saca/base/world/time_to_conflict.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/onboard/reflex/trigger.h"
#include "saca/thinking/intent/shipped_model.h"
#include "saca/thinking/preview/forecast_for_test.h"
#include "tests/support/scenes.h"

namespace saca::preview::preview_test {
namespace {

using test::car;
using world::Actor;
using world::Scene;

/// Two lanes to the left of the ego, one to its right.
Scene motorway(double speed) {
  Scene scene = test::ego_at(speed, manoeuvre::footprint(prepare::default_car()));
  scene.road.left_edge = 8.75;
  scene.road.right_edge = -5.25;
  return scene;
}

std::vector<Situation> look(const Scene& scene, const intent::Beliefs& beliefs) {
  static const manoeuvre::Car car = prepare::default_car();
  static const collision::HarmModel harm = prepare::read_harm("data/harm.toml").value();
  return situations(scene, beliefs, {}, {.car = &car, .harm = &harm});
}

std::vector<Situation> look(const Scene& scene) {
  return look(scene, intent::beliefs_at_sight(intent::shipped_model(), scene));
}

TEST(Situations, AnEmptyRoadHasNone) {
  EXPECT_TRUE(look(motorway(20.0)).empty());
}

// A wreck 90 m ahead: one certain situation; the trigger comes 1.3 s before the contact.
TEST(Situations, AWreckGivesOneCertainForecast) {
  Scene scene = motorway(20.0);
  scene.actors.push_back(car(1, {90.0, 0.0}, {}));
  const auto found = look(scene);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].probability, 1.0);
  const Scene& trigger = found[0].scene_at_trigger;
  const double gap = 90.0 - 2.25 - trigger.ego.X_WB.p.x - 2.25;  // half a wreck, the ego's front
  EXPECT_NEAR(gap, 1.3 * 20.0, 20.0 * 0.011);                    // the conflict is found to 10 ms
  EXPECT_NEAR(trigger.time, trigger.ego.X_WB.p.x / 20.0, 1e-9);
  EXPECT_GT(found[0].risks[0].risk, 0.5);
}

TEST(Situations, AreInFallingOrderAndNeverMoreThanThree) {
  Scene scene = motorway(22.0);
  for (std::uint8_t id = 1; id <= 3; ++id) {
    scene.actors.push_back(car(id, {25.0 + 12.0 * id, id == 2 ? 3.5 : 0.0}, {18.0, 0.0}));
    scene.actors[id - 1].a_W = {-1.5, 0.0};  // each may brake or not
  }
  const auto found = look(scene);
  ASSERT_EQ(found.size(), max_situations);
  EXPECT_GE(found[0].probability, found[1].probability);
  EXPECT_GE(found[1].probability, found[2].probability);
  double sum = 0.0;
  for (const Situation& each : found) {
    EXPECT_EQ(each.intentions.size(), 3U);
    sum += each.probability;
  }
  EXPECT_LE(sum, 1.0);
}

TEST(Situations, ALeadThatMayBrakeIsForecastBraking) {
  Scene scene = motorway(20.0);
  scene.actors.push_back(car(1, {40.0, 0.0}, {20.0, 0.0}));
  scene.actors[0].a_W = {-1.2, 0.0};  // no conflict within T2 unless it brakes harder
  const auto found = look(scene);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].intentions[0], intent::Intention::brake);
  EXPECT_LT(norm(found[0].scene_at_trigger.actors[0].v_W), 20.0);
}

// What happens is what is believed, whatever the car does now.
TEST(Situations, FollowTheBeliefsThatAreHandedIn) {
  Scene scene = motorway(20.0);
  scene.actors.push_back(car(1, {40.0, 0.0}, {20.0, 0.0}));  // no conflict if it goes on
  intent::Beliefs beliefs;
  beliefs.push_back({});
  beliefs[0].at.fill({0.3, 0.0, 0.0, 0.7});
  const auto found = look(scene, beliefs);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].intentions[0], intent::Intention::brake);
  EXPECT_EQ(found[0].probability, 0.7);
  beliefs[0].at.fill({1.0});
  EXPECT_TRUE(look(scene, beliefs).empty());
  EXPECT_THROW((void)look(scene, intent::Beliefs()), ContractViolation);
}

// Along, who sets off the trigger is where the trigger finds it: as surely as it is perceived.
TEST(Situations, PlacesAtTheTriggerAreAsUnsureAsTheForecast) {
  Scene scene = motorway(20.0);
  scene.actors.push_back(car(1, {70.0, 0.0}, {5.0, 0.0}));
  scene.actors.push_back(car(2, {90.0, 3.5}, {20.0, 0.0}));  // beside: in nobody's way
  for (Actor& actor : scene.actors) {
    actor.position_sd = 0.3;
    actor.velocity_sd = 0.1;
  }
  const auto found = look(scene);
  ASSERT_FALSE(found.empty());
  const Scene& trigger = found[0].scene_at_trigger;
  const double t = trigger.time;
  ASSERT_GT(t, 2.0);
  const double perceived = 0.3 * 0.3 + 0.01 * t * t;
  const double wavered = intent::ornstein_uhlenbeck_sd(intent::MotionLaw().driving, t);
  EXPECT_EQ(found[0].intentions[0], intent::Intention::maintain);
  EXPECT_EQ(found[0].intentions[1], intent::Intention::maintain);
  const world::Spread first = spread_at(found[0].spreads[0], t);
  const world::Spread beside = spread_at(found[0].spreads[1], t);
  // The forecast is linear between poses 50 ms apart.
  EXPECT_NEAR(first.along_sd, 0.3, 1e-9);
  EXPECT_NEAR(first.across_sd, std::sqrt(perceived), 1e-3);
  EXPECT_NEAR(beside.along_sd, std::sqrt(perceived + wavered * wavered), 3e-3);
  EXPECT_NEAR(beside.across_sd, std::sqrt(perceived), 1e-3);
  // A second later it has been seen again: what has come since is that of a second.
  const double a_second = intent::ornstein_uhlenbeck_sd(intent::MotionLaw().driving, 1.0);
  EXPECT_NEAR(spread_at(found[0].spreads[0], t + 1.0).along_sd,
              std::sqrt(0.3 * 0.3 + 0.01 + a_second * a_second), 3e-3);
}

double normal_below(double x) {
  return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

/// At 12.5 m/s, as the small atlas has it, with a wreck ahead: the trigger comes after some 3.5 s.
/// Everybody maintains.
Situation read_situation(const Scene& scene) {
  intent::Beliefs beliefs;
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    beliefs.push_back({});
    beliefs[i].at.fill({1.0});
  }
  ForecastTools tools = reading();
  tools.braking = forecast::Braking::full;
  const auto found = situations(scene, beliefs, {}, tools);
  EXPECT_EQ(found.size(), 1U);
  return found.empty() ? Situation() : found[0];
}
Scene wreck_ahead() {
  Scene scene = motorway(12.5);
  scene.actors.push_back(car(1, {64.0, 0.0}, {}));
  return scene;
}
const PolicyFacts& braking(const Situation& situation) {
  return situation.facts[manoeuvre::index(manoeuvre::PolicyId::aeb)];
}

// A car abreast in the next lane, 3.5 m aside: how far ahead or behind it may be by then says
// nothing about how far aside it is. Braking is struck by it with the mass that a normal law of its
// place across has beyond the gap.
TEST(Situations, WhoIsAbreastMayBeAheadOrBehindAndStaysInItsLane) {
  Scene scene = wreck_ahead();
  scene.actors.push_back(car(2, {0.0, 3.5}, {12.5, 0.0}));
  const Situation surely = read_situation(scene);
  ASSERT_GT(surely.scene_at_trigger.time, 3.0);
  EXPECT_LT(braking(surely).contact_probability(), 1e-4);
  scene.actors[1].position_sd = 0.3;
  scene.actors[1].velocity_sd = 0.3;
  const Situation found = read_situation(scene);
  const double gap = 3.5 - 0.5 * (scene.ego_footprint.width + scene.actors[1].footprint.width);
  const double t = found.scene_at_trigger.time;
  const double at_trigger = std::hypot(0.3, 0.3 * t);
  // The ego rests after 12.5 / 8 s; by then the other has surely passed.
  const double when_passed = std::hypot(at_trigger, 0.3 * 12.5 / 8.0);
  EXPECT_GT(braking(found).contact_probability(), 0.9 * normal_below(-gap / at_trigger));
  EXPECT_LT(braking(found).contact_probability(), 1.1 * normal_below(-gap / when_passed));
}

// Who follows reacts: it keeps a gap that it sees, whatever it might have done by then if nobody
// were ahead. It stops behind the ego by more than a metre (rolled out), seen to 20 cm.
TEST(Situations, WhoReactsIsAsUnsureAsItIsPerceived) {
  Scene scene = wreck_ahead();
  scene.actors.push_back(car(2, {-35.0, 0.0}, {12.5, 0.0}));
  scene.actors[1].position_sd = 0.2;
  scene.actors[1].velocity_sd = 0.3;
  const Situation found = read_situation(scene);
  const std::array plans{manoeuvre::Plan{manoeuvre::PolicyId::aeb, std::nullopt}};
  const auto rolled = rolled_out(found.scene_at_trigger, found.tracks, plans, reading());
  ASSERT_FALSE(rolled[0].outcome().contact.has_value());
  ASSERT_GT(rolled[0].outcome().clearance, 1.0);
  EXPECT_LT(braking(found).contact_probability(), 1e-4);
}

TEST(Situations, WhoCrossesIsUnsureByTheTriggersTolerance) {
  Scene scene = motorway(20.0);
  scene.actors.push_back(car(1, {80.0, -32.0}, {0.0, 8.0}));
  scene.actors[0].X_WA.yaw = 0.5 * std::numbers::pi;
  const auto found = look(scene);
  ASSERT_FALSE(found.empty());
  const intent::MotionLaw law;
  const double t = found[0].scene_at_trigger.time;
  const double along = 8.0 * reflex::Thresholds().trigger_tolerance / std::sqrt(3.0);
  EXPECT_NEAR(spread_at(found[0].spreads[0], t).along_sd,
              std::min(along, intent::ornstein_uhlenbeck_sd(law.driving, t)), 1e-3);
  EXPECT_NEAR(spread_at(found[0].spreads[0], t).across_sd, 0.0, 1e-9);
}

/// The scene a while later, all on their tracks, the ego going on: velocities, accelerations and
/// turning rates from differences of places.
Scene later(const Scene& scene, const std::vector<world::Track>& tracks, double after) {
  Scene then = scene;
  then.time += after;
  then.ego.X_WB = world::ego_going_on(scene, after);
  constexpr double h = 0.05;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const auto at = [&](double time) { return pose_at(tracks[i], time); };
    const Pose before = at(then.time - 0.5 * h);
    const Pose now = at(then.time + 0.5 * h);
    const Pose next = at(then.time + 1.5 * h);
    Actor& actor = then.actors[i];
    actor.X_WA = at(then.time);
    actor.v_W = (1.0 / h) * (now.p - before.p);
    actor.a_W = (1.0 / (h * h)) * ((next.p - now.p) - (now.p - before.p));
    actor.yaw_rate = wrap_angle(now.yaw - before.yaw) / h;
  }
  return then;
}

// A slower car cuts in, a lead brakes, somebody crosses: when the trigger of a forecast has come,
// the reflex plane's own rule triggers if all have moved like that, and 0.1 s earlier it does not.
TEST(Situations, TheTriggerIsTheReflexPlanesOwn) {
  intent::Belief cuts_in;
  cuts_in.at.fill({0.0, 0.0, 1.0});
  intent::Belief brakes;
  brakes.at.fill({0.0, 0.0, 0.0, 1.0});
  intent::Belief goes_on;
  goes_on.at.fill({1.0});
  struct Case {
    Actor actor;
    intent::Belief belief;
  };
  Actor crossing = car(1, {70.0, -28.0}, {0.0, 8.0});
  crossing.X_WA.yaw = 0.5 * std::numbers::pi;
  for (const Case& one :
       {Case{car(1, {32.0, 3.5}, {13.0, 0.0}), cuts_in},
        Case{car(1, {26.0, 3.5}, {16.0, 0.0}), cuts_in},
        Case{car(1, {30.0, 0.0}, {20.0, 0.0}), brakes}, Case{crossing, goes_on}}) {
    Scene scene = motorway(20.0);
    scene.actors.push_back(one.actor);
    intent::Beliefs beliefs;
    beliefs.push_back(one.belief);
    const auto found = look(scene, beliefs);
    ASSERT_FALSE(found.empty()) << one.actor.X_WA.p.x;
    const double after = found[0].scene_at_trigger.time;
    EXPECT_TRUE(reflex::triggering_threat(found[0].scene_at_trigger, {}).has_value());
    EXPECT_TRUE(
        reflex::triggering_threat(later(scene, found[0].tracks, after + 0.05), {}).has_value())
        << one.actor.X_WA.p.x << " " << after;
    ASSERT_GT(after, 0.1);
    EXPECT_FALSE(
        reflex::triggering_threat(later(scene, found[0].tracks, after - 0.1), {}).has_value())
        << one.actor.X_WA.p.x << " " << after;
  }
}

// Two lanes to the left drives somebody who may come over into the lane beside us: that lane is
// free to swerve to, or not.
TEST(Situations, WhoMayCloseTheLaneBesideCounts) {
  Scene scene = motorway(20.0);
  scene.actors.push_back(car(1, {90.0, 0.0}, {}));
  scene.actors.push_back(car(2, {38.0, 7.0}, {12.0, 0.0}));  // slower: the ego draws level
  intent::Beliefs beliefs;
  beliefs.push_back({});
  beliefs[0].at.fill({1.0});
  beliefs.push_back({});
  beliefs[1].at.fill({0.7, 0.0, 0.3});
  const auto found = look(scene, beliefs);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].intentions[1], intent::Intention::maintain);
  EXPECT_NEAR(found[0].probability, 0.7, 1e-12);
  EXPECT_EQ(found[1].intentions[1], intent::Intention::lane_right);
  EXPECT_NEAR(found[1].probability, 0.3, 1e-12);
  // Where there is no such lane it makes no difference.
  scene.road.left_edge = 1.75;
  EXPECT_EQ(look(scene, beliefs).size(), 1U);
}

TEST(Situations, ThosePresentButHarmlessDoNotMultiplyForecasts) {
  Scene scene = motorway(20.0);
  scene.actors.push_back(car(1, {90.0, 0.0}, {}));
  scene.actors.push_back(car(2, {-60.0, 3.5}, {20.0, 0.0}));
  EXPECT_EQ(look(scene).size(), 1U);
}

}  // namespace
}  // namespace saca::preview::preview_test
