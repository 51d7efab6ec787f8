#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "saca/base/core/contract.h"
#include "saca/onboard/vehicle/vehicle.h"
#include "saca/thinking/rollout/collision_sequence.h"
#include "saca/thinking/rollout/encounters_for_test.h"

namespace saca::rollout::collision_sequence_test {
namespace {

using world::ActorKind;
using world::Beyond;
using world::Track;

constexpr double pi = std::numbers::pi;
constexpr double g = vehicle::gravity;
constexpr double grip = 0.9;  // the scene's
constexpr world::Footprint walker{.shape = world::Shape::ellipse, .length = 0.3, .width = 0.5};

const collision::HarmModel& model() {
  static const collision::HarmModel it = shipped_harm();
  return it;
}

// The ego from the origin along x.
Encounter along_x(double speed, double duration = 5.0) {
  Encounter encounter;
  encounter.motion = steady_ego({}, {speed, 0.0}, 0.0, duration);
  return encounter;
}

double braking_way(double speed) {
  return speed * speed / (2.0 * grip * g);
}

// --- by hand ---

// 15 against -10, equal masses, restitution 0.1: the common 2.5, and 0.1 x 12.5 away from each
// other.
TEST(CollisionSequence, HeadOnBothSlideToWhereTheirSpeedsTakeThem) {
  Encounter encounter = along_x(15.0);
  encounter.add_car({{50.0, 0.0}, pi}, {-10.0, 0.0});
  const CollisionSequence sequence = encounter.sequence(model());
  const double met = 15.0 * 45.3 / 25.0;
  EXPECT_TRUE(sequence.outcome.later.empty());
  EXPECT_NEAR(sequence.ego.track.X_WA.back().p.x, met + braking_way(1.25), 2e-3);
  EXPECT_NEAR(sequence.others[0].X_WA.back().p.x, met + 4.7 + braking_way(3.75), 2e-3);
  EXPECT_NEAR(sequence.outcome.end_time, 45.3 / 25.0 + 1.25 / (grip * g), 0.02);
  EXPECT_NEAR(sequence.outcome.contact->ego_spin, 0.0, 1e-9);
}

// 15 into 5: both at 10, then 0.5 apart. Both brake alike, so the struck one stays ahead.
TEST(CollisionSequence, RearEndedTheLeadIsPushedAwayAndStaysAhead) {
  Encounter encounter = along_x(15.0);
  encounter.add_car({{20.0, 0.0}, 0.0}, {5.0, 0.0});
  const CollisionSequence sequence = encounter.sequence(model());
  const double met = 15.0 * 1.53;
  EXPECT_NEAR(sequence.outcome.contact->ego_delta_v, 5.5, 1e-9);
  EXPECT_TRUE(sequence.outcome.later.empty());
  EXPECT_NEAR(sequence.ego.track.X_WA.back().p.x, met + braking_way(9.5), 2e-3);
  EXPECT_NEAR(sequence.others[0].X_WA.back().p.x, met + 4.7 + braking_way(10.5), 2e-3);
}

// --- second contacts ---

// It meets somebody on foot and brakes; then somebody who does not react comes from behind.
Encounter struck_twice() {
  Encounter encounter = along_x(10.0);
  encounter.add(ActorKind::pedestrian, walker, 75.0, {{{30.0, 0.0}, pi / 2.0}, {}});
  encounter.add(ActorKind::car, encounter.scene.ego_footprint, 1700.0,
                {{{-30.0, 0.0}, 0.0}, {10.0, 0.0}, 0.0, 8.0});
  return encounter;
}

TEST(CollisionSequence, AnEgoThatSlidToRestCanBeRunInto) {
  const Encounter encounter = struck_twice();
  const CollisionSequence sequence = encounter.sequence(model());
  const collision::Outcome& outcome = sequence.outcome;
  ASSERT_TRUE(outcome.contact);
  EXPECT_EQ(outcome.contact->actor, 0U);
  ASSERT_EQ(outcome.later.size(), 1U);
  const collision::Contact& second = outcome.later[0];
  EXPECT_EQ(second.actor, 1U);
  EXPECT_EQ(second.ego_face, collision::Face::rear);
  // The walker stands 0.25 m deep; as much of the ego's speed as its share of the mass.
  const double after = 10.0 * 1700.0 / 1775.0;
  const double rests_at = 30.0 - 0.25 - 2.35 + braking_way(after);
  EXPECT_NEAR(second.time, (rests_at - 4.7 + 30.0) / 10.0, 1e-3);
  EXPECT_NEAR(second.relative_speed, 10.0, 1e-9);
  EXPECT_NEAR(second.ego_delta_v, 5.5, 1e-6);
  const Pose before = pose_at(sequence.ego.track, second.time);
  EXPECT_NEAR(sequence.ego.track.X_WA.back().p.x, before.p.x + braking_way(5.5), 0.03);
  EXPECT_NEAR(outcome.end_time, second.time + 5.5 / (grip * g), 0.02);
}

// Each of the ego's people comes through all impacts or not: chances multiply, for injury and death
// apart.
TEST(CollisionSequence, TheHarmOfSeveralImpactsIsTheirCombinedProbability) {
  const collision::Outcome outcome = struck_twice().judged(model());
  ASSERT_EQ(outcome.later.size(), 1U);
  double unhurt = 1.0;
  double alive = 1.0;
  for (const collision::Contact& contact : {*outcome.contact, outcome.later[0]}) {
    const collision::Injury injury =
        collision::occupant_injury(model(), contact.ego_face, contact.ego_delta_v);
    unhurt *= 1.0 - injury.severe;
    alive *= 1.0 - injury.killed;
  }
  const double ego = 1.5 * (1.0 - unhurt + 4.0 * (1.0 - alive));
  const double walker_harm = collision::unprotected_harm(model(), ActorKind::pedestrian, 10.0);
  const double other =
      1.5 * occupant_harm(model(), collision::Face::front, outcome.later[0].other_delta_v);
  EXPECT_NEAR(outcome.harm, ego + walker_harm + other, 1e-6);
  EXPECT_NEAR(outcome.collision_loss, 0.35 * 10.0, 1e-9);  // the first contact's alone
}

// A wreck ahead throws it back by 1 m/s, 6 cm; the car behind pushes it in again and holds it
// there.
TEST(CollisionSequence, BetweenAWreckAndWhoComesFromBehind) {
  Encounter encounter = along_x(10.0);
  encounter.add(ActorKind::obstacle, {.length = 1.0, .width = 4.0}, 1.0, {{{30.0, 0.0}, 0.0}, {}});
  encounter.add(ActorKind::car, encounter.scene.ego_footprint, 1700.0,
                {{{-30.0, 0.0}, 0.0}, {10.0, 0.0}, 0.0, 8.0});
  const collision::Outcome outcome = encounter.judged(model());
  ASSERT_EQ(outcome.later.size(), 2U);
  const double rests_at = 29.5 - 2.35 - braking_way(1.0);
  EXPECT_NEAR(outcome.later[0].time, (rests_at - 4.7 + 30.0) / 10.0, 1e-3);
  EXPECT_GT(outcome.later[0].ego_delta_v, 5.5);  // it presses on while the wreck holds the ego
  EXPECT_EQ(outcome.later[1].actor, 0U);
  const double again = std::sqrt(5.5 * 5.5 - 2.0 * grip * g * braking_way(1.0));
  EXPECT_NEAR(outcome.later[1].relative_speed, again, 0.02);
}

TEST(CollisionSequence, WhatFollowsADoubtfulContactIsAsDoubtful) {
  Encounter encounter = along_x(15.0);
  encounter.add_car({{40.0, 0.0}, 0.0}, {});
  encounter.add_car({{48.0, 0.0}, 0.0}, {});
  encounter.scene.ego_mass = 40'000.0;  // it goes on through both
  const collision::Outcome sure = encounter.judged(model());
  ASSERT_GE(sure.later.size(), 1U);
  encounter.scene.actors[0].existence = 0.5;
  EXPECT_NEAR(encounter.judged(model()).harm, 0.5 * sure.harm, 1e-12);
  encounter.scene.actors[0].existence = 1.0;
  encounter.scene.actors[1].existence = 0.0;
  const double first_alone = encounter.judged(model()).harm;
  encounter.tracks[1] = {.X_WA = {{{48.0, 50.0}, 0.0}}};
  EXPECT_NEAR(first_alone, encounter.judged(model()).harm, 1e-12);
}

// The ego between two: pushed from behind into the car ahead that stands.
TEST(CollisionSequence, APileOfTwo) {
  Encounter encounter = along_x(0.0, 0.5);
  encounter.motion.ended = true;
  encounter.add_car({{6.0, 0.0}, 0.0}, {});
  encounter.add_car({{-25.0, 0.0}, 0.0}, {15.0, 0.0});
  const collision::Outcome outcome = encounter.judged(model());
  ASSERT_TRUE(outcome.contact);
  EXPECT_EQ(outcome.contact->actor, 1U);
  EXPECT_EQ(outcome.contact->ego_face, collision::Face::rear);
  ASSERT_GE(outcome.later.size(), 1U);
  EXPECT_EQ(outcome.later[0].actor, 0U);
  EXPECT_EQ(outcome.later[0].ego_face, collision::Face::front);
  // 8.25 m/s lose to friction over 1.3 m, then half of (1 + 0.1) of the rest.
  const double left = std::sqrt(8.25 * 8.25 - 2.0 * grip * g * 1.3);
  EXPECT_NEAR(outcome.later[0].ego_delta_v, 0.55 * left, 0.01);
}

// A truck and a car at the common speed after an impact brake alike: touching is no contact.
TEST(CollisionSequence, PushedAlongIsStruckOnce) {
  collision::HarmModel plastic = model();
  plastic.law.restitution = 0.0;
  Encounter encounter = along_x(5.0);
  encounter.add(ActorKind::truck, {.length = 8.0, .width = 2.5}, 12'000.0,
                {{{-30.0, 0.0}, 0.0}, {20.0, 0.0}});
  const collision::Outcome outcome = encounter.judged(plastic);
  ASSERT_TRUE(outcome.contact);
  EXPECT_TRUE(outcome.later.empty());
  EXPECT_NEAR(outcome.contact->ego_delta_v, 15.0 * 12.0 / 13.7, 1e-6);
}

TEST(CollisionSequence, BodiesThatRestInEachOtherDoNotFight) {
  Encounter encounter = along_x(0.0, 1.0);
  encounter.motion.ended = true;
  encounter.add_car({{3.0, 1.0}, 0.4}, {});
  const collision::Outcome outcome = encounter.judged(model());
  ASSERT_TRUE(outcome.contact);
  EXPECT_TRUE(outcome.later.empty());
  EXPECT_EQ(outcome.harm, 0.0);
}

TEST(CollisionSequence, APersonIsStruckOnceAndTheEgoThenBrakes) {
  Encounter encounter = along_x(10.0);
  encounter.add(ActorKind::pedestrian, walker, 75.0, {{{30.0, 0.0}, pi / 2.0}, {}});
  const CollisionSequence sequence = encounter.sequence(model());
  ASSERT_TRUE(sequence.outcome.contact);
  EXPECT_TRUE(sequence.outcome.later.empty());
  const double after = 10.0 - sequence.outcome.contact->ego_delta_v;
  EXPECT_NEAR(sequence.ego.track.X_WA.back().p.x, 30.0 - 0.15 - 2.35 + braking_way(after), 0.12);
  EXPECT_GT(sequence.others[0].X_WA.back().p.x, 31.0);
}

// --- edges ---

Encounter towards(Beyond beyond, double speed, double angle) {
  Encounter encounter;
  encounter.motion = steady_ego({{}, angle}, rotated({speed, 0.0}, angle), 0.0, 5.0);
  encounter.scene.road.left_edge = 3.0;
  encounter.scene.road.left_beyond = beyond;
  return encounter;
}

// The front corner is thrown back, the centre still moves outwards: the rear comes round. Hit far
// ahead of the centre the ego turns to the right, hit behind it to the left.
TEST(CollisionSequence, ABarrierIsHitByTheFrontAndThenByTheRear) {
  const CollisionSequence sequence = towards(Beyond::barrier, 15.0, 0.25).sequence(model());
  const collision::Outcome& outcome = sequence.outcome;
  ASSERT_TRUE(outcome.contact);
  EXPECT_LT(outcome.contact->ego_spin, -0.5);
  ASSERT_GE(outcome.later.size(), 1U);
  EXPECT_EQ(outcome.later[0].edge, collision::Side::left);
  EXPECT_GT(outcome.later[0].ego_spin, 0.2);
  for (const Pose& X_WB : sequence.ego.track.X_WA) {
    EXPECT_GT(collision::edge_clearance(towards(Beyond::barrier, 1.0, 0.0).scene.road,
                                        collision::Side::left, empty_scene().ego_footprint, X_WB),
              -0.25);  // what a tenth of a second of crumpling lets it intrude
  }
}

TEST(CollisionSequence, ScrapingAlongAWallIsAFewContactsNotHundreds) {
  for (const double angle : {0.01, 0.03, 0.1}) {
    const CollisionSequence sequence = towards(Beyond::barrier, 25.0, angle).sequence(model());
    EXPECT_LE(sequence.outcome.later.size(), 2U) << angle;
    EXPECT_LT(sequence.outcome.harm, 0.2) << angle;
    EXPECT_GT(sequence.ego.track.X_WA.back().p.x, 25.0) << angle;
  }
}

TEST(CollisionSequence, TreesHoldTheEgoAndThereItCanBeHit) {
  Encounter encounter = towards(Beyond::trees, 15.0, 0.25);
  const CollisionSequence alone = encounter.sequence(model());
  ASSERT_TRUE(alone.outcome.contact);
  EXPECT_TRUE(alone.outcome.later.empty());
  EXPECT_NEAR(alone.outcome.end_time, alone.outcome.contact->time, 1e-12);
  const Vec2 stuck = alone.ego.track.X_WA.back().p;
  encounter.add_car({{stuck.x - 40.0, stuck.y}, 0.0}, {12.0, 0.0});
  const collision::Outcome outcome = encounter.judged(model());
  ASSERT_EQ(outcome.later.size(), 1U);
  EXPECT_EQ(outcome.later[0].actor, 0U);
}

TEST(CollisionSequence, AKerbCrossedWhileSlidingIsAContactOnce) {
  Encounter encounter = towards(Beyond::kerb, 15.0, 0.25);
  encounter.add(ActorKind::pedestrian, walker, 75.0, {{{5.0, 5.0 * std::tan(0.25)}, 0.0}, {}});
  const collision::Outcome outcome = encounter.judged(model());
  ASSERT_TRUE(outcome.contact);
  EXPECT_EQ(outcome.contact->actor, 0U);
  ASSERT_EQ(outcome.later.size(), 1U);
  EXPECT_EQ(outcome.later[0].edge, collision::Side::left);
}

TEST(CollisionSequence, AWallIsMetLikeAnythingElse) {
  Encounter encounter = along_x(10.0);
  encounter.add(ActorKind::obstacle, {.shape = world::Shape::segment, .length = 30.0}, 1.0,
                {{{30.0, 0.0}, pi / 2.0}, {}});
  const collision::Outcome outcome = encounter.judged(model());
  ASSERT_TRUE(outcome.contact);
  EXPECT_NEAR(outcome.contact->time, (30.0 - 2.35) / 10.0, 1e-8);
  EXPECT_NEAR(outcome.contact->ego_delta_v, 11.0, 1e-6);
  EXPECT_TRUE(outcome.later.empty());
}

// --- others who react ---

// A driver behind who keeps a place 8 m behind the ego at every instant: told of the real stop, it
// stops too.
TEST(CollisionSequence, WhoReactsIsAskedAgainWithWhatTheEgoReallyDoes) {
  Encounter encounter = along_x(15.0);
  encounter.add(ActorKind::obstacle, {.length = 1.0, .width = 4.0}, 1.0, {{{40.0, 0.0}, 0.0}, {}});
  encounter.add_car({{-8.0, 0.0}, 0.0}, {15.0, 0.0});
  std::vector<Track> asked;
  const collision::Others others = [&](const manoeuvre::EgoMotion& ego) {
    asked.push_back(ego.track);
    std::vector<Track> tracks = encounter.tracks;
    tracks[1] = ego.track;
    for (Pose& pose : tracks[1].X_WA) {
      pose.p.x -= 8.0;
    }
    return tracks;
  };
  const CollisionSequence sequence =
      collision_sequence(encounter.motion, encounter.scene, others, model());
  ASSERT_TRUE(sequence.outcome.contact);
  EXPECT_EQ(sequence.outcome.contact->actor, 0U);
  EXPECT_TRUE(sequence.outcome.later.empty());
  ASSERT_EQ(asked.size(), 2U);
  const auto same = static_cast<std::size_t>(sequence.outcome.contact->time / 0.01);
  for (std::size_t i = 0; i <= same; ++i) {
    ASSERT_EQ(asked[0].X_WA[i].p.x, asked[1].X_WA[i].p.x) << i;  // to the last bit
  }
  EXPECT_NEAR(sequence.others[1].X_WA.back().p.x, sequence.ego.track.X_WA.back().p.x - 8.0, 1e-9);
  // Whoever does not react, on a fixed track, runs into it.
  EXPECT_EQ(encounter.judged(model()).later[0].actor, 1U);
}

// A wreck that stands 30 m ahead counts only if it is there when the ego passes, after 2 s; who
// appears inside the ego is in contact then.
TEST(CollisionSequence, BeforeItsTrackStartsAnActorIsNotThere) {
  Encounter encounter = along_x(15.0);
  encounter.add_car({{30.0, 0.0}, 0.0}, {});
  const double start_of_contact = encounter.judged(model()).contact.value().time;
  encounter.tracks[0].start = start_of_contact - 0.01;
  EXPECT_NEAR(encounter.judged(model()).contact.value().time, start_of_contact, 1e-6);
  encounter.tracks[0].start = start_of_contact + 0.1;
  EXPECT_NEAR(encounter.judged(model()).contact.value().time, start_of_contact + 0.1, 1e-6);
  encounter.tracks[0].start = start_of_contact + 2.0;  // long past
  EXPECT_FALSE(encounter.judged(model()).contact.has_value());
  EXPECT_GT(encounter.judged(model()).clearance, 5.0);
}

TEST(CollisionSequence, TheCourseIsTheMotionAndThenTheSlide) {
  Encounter encounter = along_x(15.0);
  encounter.add_car({{40.0, 0.6}, 0.3}, {});
  const CollisionSequence sequence = encounter.sequence(model());
  ASSERT_TRUE(sequence.outcome.contact);
  const auto& poses = sequence.ego.track.X_WA;
  ASSERT_EQ(sequence.ego.v_B.size(), poses.size());
  ASSERT_EQ(sequence.ego.yaw_rate.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double time = 0.01 * static_cast<double>(i);
    if (time < sequence.outcome.contact->time) {
      EXPECT_EQ(poses[i].p.x, encounter.motion.track.X_WA[i].p.x);
    } else if (i > 0) {
      const Vec2 v_W = rotated(sequence.ego.v_B[i], poses[i].yaw);
      EXPECT_LT(norm(poses[i].p - poses[i - 1].p - 0.01 * v_W),
                0.01 * (time < sequence.outcome.contact->time + 0.01 ? 15.0 : 0.1));
    }
  }
  EXPECT_EQ(norm(sequence.ego.v_B.back()), 0.0);
  EXPECT_TRUE(sequence.ego.ended);
  EXPECT_EQ(sequence.outcome.harm, encounter.judged(model()).harm);
}

TEST(CollisionSequence, OnIceEverybodySlidesFarther) {
  Encounter encounter = along_x(15.0);
  encounter.add_car({{20.0, 0.0}, 0.0}, {5.0, 0.0});
  const collision::Others fixed = [&](const manoeuvre::EgoMotion&) { return encounter.tracks; };
  const CollisionSequence dry =
      collision_sequence(encounter.motion, encounter.scene, fixed, model());
  const CollisionSequence icy =
      collision_sequence(encounter.motion, encounter.scene, fixed, model(), 0.1);
  const double met = 15.0 * 1.53;
  EXPECT_NEAR((icy.ego.track.X_WA.back().p.x - met) / (dry.ego.track.X_WA.back().p.x - met), 9.0,
              0.01);
}

// --- properties ---

Encounter random_story(std::mt19937& rng) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Encounter encounter;
  encounter.motion =
      steady_ego({}, {14.0 + 6.0 * uniform(rng), uniform(rng)}, 0.3 * uniform(rng), 4.0);
  for (int i = 0; i < 3; ++i) {
    const double yaw = pi * uniform(rng);
    encounter.add_car({{25.0 + 15.0 * uniform(rng), 6.0 * uniform(rng)}, yaw},
                      rotated({8.0 + 7.0 * uniform(rng), 0.0}, yaw), 0.3 * uniform(rng));
  }
  encounter.scene.road.left_edge = 8.0;
  encounter.scene.road.left_beyond = Beyond::barrier;
  encounter.scene.road.right_edge = -7.0;
  encounter.scene.road.right_beyond = static_cast<Beyond>(rng() % 4);
  return encounter;
}

// Of one of the cars [J].
double energy(const world::Footprint& footprint, Vec2 v, double yaw_rate) {
  const collision::ImpactBody body = collision::free_body(1700.0, footprint);
  return 0.5 * 1700.0 * dot(v, v) + 0.5 * yaw_rate * yaw_rate / body.inverse_yaw_inertia;
}

// After the first impact nobody who was struck is driven, and the others keep their speed. Between
// the two poses around an impact a track knows only the mean velocity: one pose may tell too much
// or too little.
TEST(CollisionSequence, AfterTheFirstImpactEnergyOnlyFalls) {
  std::mt19937 rng(11);
  int stories = 0;
  for (int i = 0; i < 200; ++i) {
    const Encounter encounter = random_story(rng);
    const CollisionSequence sequence = encounter.sequence(model());
    if (!sequence.outcome.contact || sequence.outcome.end_time <= sequence.outcome.contact->time) {
      continue;
    }
    ++stories;
    const auto& ego = sequence.ego;
    EXPECT_EQ(norm(ego.v_B.back()), 0.0) << i;
    std::vector<double> total;
    for (std::size_t k = 0; k < ego.v_B.size(); ++k) {
      const double time = 0.01 * static_cast<double>(k);
      if (time > sequence.outcome.contact->time) {
        total.push_back(energy(encounter.scene.ego_footprint, ego.v_B[k], ego.yaw_rate[k]));
        for (const Track& track : sequence.others) {
          total.back() += energy(encounter.scene.ego_footprint, velocity_at(track, time + 0.005),
                                 yaw_rate_at(track, time + 0.005));
        }
      }
    }
    for (std::size_t k = 2; k + 1 < total.size(); ++k) {
      EXPECT_LT(std::min(total[k], total[k + 1]), std::max(total[k - 1], total[k - 2]) + 10.0)
          << i << " " << k;
    }
  }
  EXPECT_GT(stories, 40);
}

template <class Check>
void each_later(const collision::Outcome& a, const collision::Outcome& b, Check&& check) {
  ASSERT_EQ(a.contact.has_value(), b.contact.has_value());
  ASSERT_EQ(a.later.size(), b.later.size());
  if (a.contact) {
    check(*a.contact, *b.contact);
  }
  for (std::size_t i = 0; i < a.later.size(); ++i) {
    check(a.later[i], b.later[i]);
  }
}

TEST(CollisionSequence, DoesNotDependOnTheWorldsFrameToTheEnd) {
  std::mt19937 rng(12);
  std::size_t later = 0;
  for (int i = 0; i < 150; ++i) {
    const Encounter original = random_story(rng);
    const Pose X_VW{{-700.0, 900.0}, 2.1};
    Encounter turned = original;
    const auto map = [&](const Pose& X) { return X_VW * X; };
    auto& poses = turned.motion.track.X_WA;
    std::transform(poses.begin(), poses.end(), poses.begin(), map);
    for (Track& track : turned.tracks) {
      std::transform(track.X_WA.begin(), track.X_WA.end(), track.X_WA.begin(), map);
    }
    turned.scene.road.X_WL = X_VW * turned.scene.road.X_WL;
    const collision::Outcome a = original.judged(model());
    const collision::Outcome b = turned.judged(model());
    SCOPED_TRACE(i);
    EXPECT_NEAR(a.harm, b.harm, 1e-6);
    EXPECT_NEAR(a.end_time, b.end_time, 0.011);
    each_later(a, b, [&](const collision::Contact& one, const collision::Contact& same) {
      EXPECT_EQ(one.actor, same.actor);
      EXPECT_EQ(one.ego_face, same.ego_face);
      EXPECT_NEAR(one.time, same.time, 1e-5);
      EXPECT_LT(norm(X_VW * one.p_W - same.p_W), 1e-4);
      EXPECT_NEAR(one.ego_spin, same.ego_spin, 1e-4);
      EXPECT_NEAR(one.other_delta_v, same.other_delta_v, 1e-4);
    });
    later += a.later.size();
  }
  EXPECT_GT(later, 20U);
}

TEST(CollisionSequence, IsMirrorSymmetricToTheEnd) {
  std::mt19937 rng(13);
  const auto face = [](collision::Face one) {
    return one == collision::Face::left    ? collision::Face::right
           : one == collision::Face::right ? collision::Face::left
                                           : one;
  };
  for (int i = 0; i < 150; ++i) {
    const Encounter original = random_story(rng);
    Encounter flipped = original;
    const auto map = [](const Pose& X) { return Pose{{X.p.x, -X.p.y}, -X.yaw}; };
    auto& poses = flipped.motion.track.X_WA;
    std::transform(poses.begin(), poses.end(), poses.begin(), map);
    for (std::size_t k = 0; k < poses.size(); ++k) {
      flipped.motion.v_B[k].y = -flipped.motion.v_B[k].y;
      flipped.motion.yaw_rate[k] = -flipped.motion.yaw_rate[k];
    }
    for (Track& track : flipped.tracks) {
      std::transform(track.X_WA.begin(), track.X_WA.end(), track.X_WA.begin(), map);
    }
    world::Road& road = flipped.scene.road;
    road.left_edge = -original.scene.road.right_edge;
    road.right_edge = -original.scene.road.left_edge;
    std::swap(road.left_beyond, road.right_beyond);
    const collision::Outcome a = original.judged(model());
    const collision::Outcome b = flipped.judged(model());
    SCOPED_TRACE(i);
    EXPECT_NEAR(a.harm, b.harm, 1e-6);
    each_later(a, b, [&](const collision::Contact& one, const collision::Contact& same) {
      EXPECT_EQ(one.actor, same.actor);
      EXPECT_EQ(one.edge.has_value(), same.edge.has_value());
      EXPECT_EQ(one.ego_face, face(same.ego_face));
      EXPECT_NEAR(one.ego_spin, -same.ego_spin, 1e-4);
      EXPECT_NEAR(one.other_spin, -same.other_spin, 1e-4);
      EXPECT_NEAR(one.p_W.y, -same.p_W.y, 1e-4);
    });
  }
}

// The same story from the other's seat, with two cars alone.
TEST(CollisionSequence, FromTheOtherCarsSeatSwapsWhatItShouldToTheEnd) {
  std::mt19937 rng(14);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int contacts = 0;
  for (int i = 0; i < 200; ++i) {
    const Pose X_WO{{25.0 + 5.0 * uniform(rng), 4.0 * uniform(rng)}, pi * uniform(rng)};
    const Vec2 v_ego{12.0, 2.0 * uniform(rng)};
    const Vec2 v_other = rotated({8.0, 0.0}, X_WO.yaw);
    Encounter mine;
    mine.motion = steady_ego({}, v_ego, 0.0, 3.0);
    mine.add(ActorKind::car, mine.scene.ego_footprint, 1700.0, {X_WO, v_other, 0.0, 3.0});
    Encounter theirs;
    theirs.motion = steady_ego(X_WO, v_other, 0.0, 3.0);
    theirs.add(ActorKind::car, mine.scene.ego_footprint, 1700.0, {{}, v_ego, 0.0, 3.0});
    const collision::Outcome a = mine.judged(model());
    const collision::Outcome b = theirs.judged(model());
    SCOPED_TRACE(i);
    EXPECT_NEAR(a.harm, b.harm, 1e-3 * a.harm + 1e-9);
    each_later(a, b, [&](const collision::Contact& one, const collision::Contact& same) {
      ++contacts;
      EXPECT_EQ(one.ego_face, same.other_face);
      EXPECT_EQ(one.other_face, same.ego_face);
      EXPECT_NEAR(one.ego_delta_v, same.other_delta_v, 1e-2);
      EXPECT_NEAR(one.ego_spin, same.other_spin, 1e-2);
      EXPECT_NEAR(one.other_spin, same.ego_spin, 1e-2);
    });
  }
  EXPECT_GT(contacts, 20);
}

TEST(CollisionSequence, RefusesOthersThatAreNotThere) {
  Encounter encounter = along_x(10.0);
  encounter.add_car({{30.0, 0.0}, 0.0}, {});
  const collision::Others nobody = [](const manoeuvre::EgoMotion&) { return std::vector<Track>{}; };
  EXPECT_THROW((void)collision_sequence(encounter.motion, encounter.scene, nobody, model()),
               ContractViolation);
  EXPECT_THROW((void)collision_sequence({}, encounter.scene, nobody, model()), ContractViolation);
}

}  // namespace
}  // namespace saca::rollout::collision_sequence_test
