#include "saca/onboard/forecast/prepared_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/thinking/rollout/collision_sequence.h"
#include "saca/thinking/rollout/concatenated.h"
#include "saca/thinking/rollout/encounters_for_test.h"

namespace saca::forecast::prepared_motion_test {
namespace {

using manoeuvre::EgoMotion;
using world::Track;

const collision::HarmModel& harm() {
  static const collision::HarmModel shipped = rollout::shipped_harm();
  return shipped;
}

/// 15 m/s in the middle of five cars that go everywhere, between a kerb and a barrier.
rollout::Encounter random_encounter(std::mt19937& rng) {
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  rollout::Encounter encounter;
  encounter.scene.road.left_edge = 6.0;
  encounter.scene.road.right_edge = -4.0;
  encounter.scene.road.left_beyond = world::Beyond::kerb;
  encounter.scene.road.right_beyond = world::Beyond::barrier;
  encounter.motion = rollout::steady_ego({}, {15.0, 0.0}, 0.1 * u(rng), 3.0);
  encounter.motion.ended = u(rng) > 0.0;
  for (int i = 0; i < 5; ++i) {
    encounter.add_car({{20.0 + 25.0 * u(rng), 6.0 * u(rng)}, u(rng)}, {12.0 * u(rng), 3.0 * u(rng)},
                      0.2 * u(rng));
  }
  return encounter;
}

void expect_same(const collision::Outcome& a, const collision::Outcome& b) {
  EXPECT_EQ(a.harm, b.harm);
  EXPECT_EQ(a.collision_loss, b.collision_loss);
  EXPECT_EQ(a.end_time, b.end_time);
  EXPECT_EQ(a.later.size(), b.later.size());
  ASSERT_EQ(a.contact.has_value(), b.contact.has_value());
  if (a.contact) {
    EXPECT_EQ(a.contact->time, b.contact->time);
    EXPECT_EQ(a.contact->actor, b.contact->actor);
    EXPECT_EQ(a.contact->edge, b.contact->edge);
  }
}

// Prepared once, held against one motion of the others after the other, or made anew each time.
TEST(PreparedMotion, TellsTheSameHoweverOftenItIsHeldAgainstOthers) {
  std::mt19937 rng(4);
  int contacts = 0;
  for (int i = 0; i < 30; ++i) {
    const rollout::Encounter encounter = random_encounter(rng);
    PreparedMotion prepared(encounter.motion, encounter.scene);
    for (int k = 0; k < 4; ++k) {
      const std::vector<Track> tracks = random_encounter(rng).tracks;
      const collision::Outcome outcome =
          rollout::judge_contacts(prepared, movers_of(encounter.scene, tracks), harm());
      expect_same(outcome,
                  rollout::judge_contacts(encounter.motion, encounter.scene, tracks, harm()));
      contacts += outcome.contact ? 1 : 0;
    }
  }
  EXPECT_GT(contacts, 30);
}

/// The first of the others stays behind the ego, however that moves.
Track trailing(const Track& X_WB) {
  Track track = X_WB;
  for (Pose& pose : track.X_WA) {
    pose = pose * Pose{{-9.0, 0.0}, 0.0};
  }
  return track;
}

// Who reacts is told the same way of the ego as by the function that is told of all of it, and what
// comes of it is the same.
TEST(PreparedMotion, WhoReactsIsToldWhatTheEgoReallyDoes) {
  std::mt19937 rng(6);
  int asked_again = 0;
  for (int i = 0; i < 60; ++i) {
    const rollout::Encounter encounter = random_encounter(rng);
    std::vector<Track> told;
    const collision::Outcome reference = rollout::judge_contacts(
        encounter.motion, encounter.scene,
        [&](const EgoMotion& ego) {
          told.push_back(ego.track);
          std::vector<Track> tracks = encounter.tracks;
          tracks[0] = trailing(ego.track);
          return tracks;
        },
        harm());
    PreparedMotion prepared(encounter.motion, encounter.scene);
    Track track;
    std::optional<collision::Mover> mover;
    std::size_t calls = 0;
    const rollout::Reaction reaction = [&](const Track& X_WB, std::span<const bool> struck,
                                           std::span<const collision::Mover*> others) {
      ASSERT_LT(calls, told.size());
      EXPECT_EQ(X_WB.step, told[calls].step);
      ASSERT_EQ(X_WB.X_WA.size(), told[calls].X_WA.size());
      for (std::size_t k = 0; k < X_WB.X_WA.size(); ++k) {
        EXPECT_EQ(X_WB.X_WA[k].p.x, told[calls].X_WA[k].p.x);
        EXPECT_EQ(X_WB.X_WA[k].yaw, told[calls].X_WA[k].yaw);
      }
      ++calls;
      if (!struck[0]) {
        track = trailing(X_WB);
        others[0] = &mover.emplace(encounter.scene.actors[0].footprint, track);
      }
    };
    const auto movers = movers_of(encounter.scene, encounter.tracks);
    expect_same(rollout::judge_contacts(prepared, movers, harm(), reaction), reference);
    EXPECT_EQ(calls, told.size());
    asked_again += calls > 1 ? 1 : 0;
  }
  EXPECT_GT(asked_again, 10);
}

TEST(PreparedMotion, GoesOnAlongTheLaneWhereItHasEndedAndMoves) {
  EgoMotion motion = rollout::steady_ego({}, {10.0, 0.0}, 0.0, 1.0);
  const world::Scene scene = rollout::empty_scene();
  EXPECT_EQ(end_time(PreparedMotion(motion, scene).intended().track), 1.0);
  motion.ended = true;
  PreparedMotion prepared(motion, scene);
  EXPECT_NEAR(end_time(prepared.intended().track), 3.0, 1e-9);
  EXPECT_NEAR(prepared.intended().track.X_WA.back().p.x, 30.0, 1e-9);
  EXPECT_EQ(end_time(prepared.given().track), 1.0);
}

// At 45 degrees and 10 m/s: the corner, 1 m ahead and 0.5 m aside of the centre, has
// 7 m - (1 + 0.5) / sqrt(2) m to go sideways.
TEST(PreparedMotion, CrossesAnEdgeWithItsForemostCorner) {
  world::Scene scene = rollout::empty_scene();
  scene.ego_footprint = {.length = 2.0, .width = 1.0};
  scene.road.left_edge = 7.0;
  const double course = 0.25 * std::numbers::pi;
  const EgoMotion motion =
      rollout::steady_ego({{}, course}, rotated({10.0, 0.0}, course), 0.0, 3.0);
  PreparedMotion prepared(motion, scene);
  const double expected = (7.0 - 1.5 * std::sqrt(0.5)) / (10.0 * std::sqrt(0.5));
  EXPECT_NEAR(prepared.crossing(collision::Side::left).value(), expected, 1e-4);
  EXPECT_FALSE(prepared.crossing(collision::Side::right));
}

TEST(PreparedMotion, ItsStepsAreWhatASlideIsJoinedTo) {
  const EgoMotion motion = rollout::steady_ego({}, {10.0, 1.0}, 0.3, 1.0);
  EgoMotion thin = motion;
  thin.track.step = 0.05;
  const world::Scene scene = rollout::empty_scene();
  for (const EgoMotion& one : {motion, thin}) {
    PreparedMotion prepared(one, scene);
    const Track& finer = prepared.in_steps_of(0.04);
    EXPECT_GE(end_time(finer), end_time(one.track));
    for (const double impact : {0.33, 7.0}) {
      const Track slide{
          .start = impact, .step = 0.04, .X_WA = {{{3.0, 0.0}, 0.1}, {{3.1, 0.0}, 0.2}}};
      const Track reference = rollout::concatenated(one.track, slide);
      const Track all = rollout::concatenated(finer, slide);
      ASSERT_EQ(all.X_WA.size(), reference.X_WA.size());
      EXPECT_EQ(all.step, reference.step);
      for (std::size_t k = 0; k < all.X_WA.size(); ++k) {
        EXPECT_EQ(all.X_WA[k].p.x, reference.X_WA[k].p.x) << k;
        EXPECT_EQ(all.X_WA[k].yaw, reference.X_WA[k].yaw) << k;
      }
    }
  }
}

TEST(PreparedMotion, RefusesWhatDoesNotFitTogether) {
  EgoMotion motion = rollout::steady_ego({}, {10.0, 0.0}, 0.0, 1.0);
  const rollout::Encounter encounter;
  PreparedMotion prepared(motion, encounter.scene);
  const Track track{.X_WA = {{}}};
  EXPECT_THROW((void)movers_of(encounter.scene, {&track, 1}), ContractViolation);
  const collision::Mover mover(encounter.scene.ego_footprint, track);
  EXPECT_THROW((void)rollout::judge_contacts(prepared, {&mover, 1}, harm()), ContractViolation);
  motion.yaw_rate.pop_back();
  EXPECT_THROW(PreparedMotion(motion, encounter.scene), ContractViolation);
}

}  // namespace
}  // namespace saca::forecast::prepared_motion_test
