#include "saca/onboard/collision/impact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "saca/onboard/collision/collision_impulse.h"
#include "saca/thinking/rollout/encounters_for_test.h"

namespace saca::collision::impact_test {
namespace {

constexpr double pi = std::numbers::pi;

const HarmModel& rules() {
  static const HarmModel it = rollout::shipped_harm();
  return it;
}

TEST(InstantAt, IsBetweenThePosesAndRestsBeyondTheEnd) {
  manoeuvre::EgoMotion motion = rollout::steady_ego({{}, pi / 2.0}, {0.0, 10.0}, 0.0, 0.1);
  motion.v_B[3] = {10.0, 0.0};
  motion.v_B[4] = {12.0, 1.0};
  const Instant now = instant_at(motion, 0.0325);
  EXPECT_NEAR(now.X_WB.p.y, 0.325, 1e-12);
  EXPECT_NEAR(now.v_W.y, 10.5, 1e-12);
  EXPECT_NEAR(now.v_W.x, -0.25, 1e-12);
  EXPECT_NEAR(norm(instant_at(motion, 0.1).v_W), 10.0, 1e-12);
  EXPECT_EQ(norm(instant_at(motion, 0.2).v_W), 0.0);
}

// What comes after is what was before and what the contact says has changed.
TEST(Meet, TheMotionAfterwardsIsThatBeforeAndTheChange) {
  rollout::Encounter encounter;
  encounter.add_car({{4.6, 0.9}, 2.8}, {-6.0, 1.0});
  const Instant ego{{}, {12.0, 0.0}, 0.1};
  const Instant other{{{4.6, 0.9}, 2.8}, {-6.0, 1.0}, -0.2};
  const Impact impact = meet(encounter.scene, 0, ego, other, 3.0, rules());
  EXPECT_EQ(impact.contact.time, 3.0);
  EXPECT_NEAR(norm(impact.ego_after.v_W - ego.v_W), impact.contact.ego_delta_v, 1e-9);
  EXPECT_NEAR(norm(impact.other_after.v_W - other.v_W), impact.contact.other_delta_v, 1e-9);
  EXPECT_NEAR(impact.ego_after.yaw_rate - 0.1, impact.contact.ego_spin, 1e-12);
  EXPECT_NEAR(impact.other_after.yaw_rate + 0.2, impact.contact.other_spin, 1e-12);
  EXPECT_GT(closing_speed(encounter.scene, 0, ego, other, rules()), 5.0);
  // Afterwards they part where they touched, at a tenth of the speed.
  EXPECT_NEAR(closing_speed(encounter.scene, 0, impact.ego_after, impact.other_after, rules()),
              -0.1 * closing_speed(encounter.scene, 0, ego, other, rules()), 1e-6);
}

// The ego at rest is struck in its right side, 1.2 m ahead of its centre; plastic, without
// friction. J = v / (1/m + 1/m + c^2 / I): it turns to the left, and the other, which hits with the
// middle of its front, not at all.
TEST(Meet, ATBoneSpinsTheStruckEgoToTheLeft) {
  HarmModel plain = rules();
  plain.law = {0.0, 0.0};
  rollout::Encounter encounter;
  encounter.add_car({{1.2, -3.3}, pi / 2.0}, {0.0, 10.0});
  const Impact impact =
      meet(encounter.scene, 0, {}, {{{1.2, -3.3}, pi / 2.0}, {0.0, 10.0}, 0.0}, 0.0, plain);
  const double inertia = 1700.0 * (4.7 * 4.7 + 1.9 * 1.9) / 12.0;
  const double J = 10.0 / (2.0 / 1700.0 + 1.2 * 1.2 / inertia);
  EXPECT_EQ(impact.contact.ego_face, Face::right);
  EXPECT_EQ(impact.contact.other_face, Face::front);
  EXPECT_NEAR(impact.contact.ego_delta_v, J / 1700.0, 1e-6);
  EXPECT_NEAR(impact.contact.ego_spin, 1.2 * J / inertia, 1e-6);
  EXPECT_NEAR(impact.contact.other_spin, 0.0, 1e-6);
  EXPECT_NEAR(impact.ego_after.v_W.y, J / 1700.0, 1e-6);
}

TEST(Leave, ABarrierThrowsBackTreesHoldAndAKerbLetsPass) {
  rollout::Encounter encounter;
  encounter.scene.road.left_edge = 1.0;
  const Instant ego{{{0.0, 0.05}, 0.0}, {12.0, 2.0}, 0.3};  // flat along the edge
  encounter.scene.road.left_beyond = world::Beyond::barrier;
  const Impact barrier = leave(encounter.scene, Side::left, ego, 1.0, rules());
  // Flat: in the middle. Friction stops half of 1.1 x 2 m/s; the side touches, turning at 0.3.
  EXPECT_NEAR(barrier.contact.p_W.x, 0.0, 1e-9);
  EXPECT_NEAR(barrier.contact.p_W.y, 1.0, 1e-9);
  EXPECT_LT(barrier.ego_after.v_W.y, 0.0);
  EXPECT_NEAR(closing_speed(encounter.scene, Side::left, ego, rules()), 2.0, 1e-9);
  EXPECT_NEAR(closing_speed(encounter.scene, Side::left, barrier.ego_after, rules()), -0.2, 1e-6);
  encounter.scene.road.left_beyond = world::Beyond::trees;
  const Impact trees = leave(encounter.scene, Side::left, ego, 1.0, rules());
  EXPECT_EQ(norm(trees.ego_after.v_W), 0.0);
  EXPECT_EQ(trees.ego_after.yaw_rate, 0.0);
  EXPECT_NEAR(trees.contact.ego_spin, -0.3, 1e-12);
  encounter.scene.road.left_beyond = world::Beyond::kerb;
  const Impact kerb = leave(encounter.scene, Side::left, ego, 1.0, rules());
  EXPECT_EQ(norm(kerb.ego_after.v_W - ego.v_W), 0.0);
}

// Two pushes one way hurt as one of their sum; there and back as none.
TEST(PressedOn, AddsChangesOfVelocityAsVectors) {
  Impact first;
  first.ego_change_W = {-3.0, 0.0};
  first.contact.ego_delta_v = 3.0;
  first.contact.ego_spin = 0.4;
  first.contact.time = 1.0;
  first.contact.ego_face = Face::left;
  Impact more = first;
  more.ego_change_W = {0.0, 4.0};
  more.contact.time = 1.1;
  const Impact both = pressed_on(first, more, rules());
  EXPECT_NEAR(both.contact.ego_delta_v, 5.0, 1e-12);
  EXPECT_NEAR(both.contact.ego_spin, 0.8, 1e-12);
  EXPECT_EQ(both.contact.time, 1.0);
  EXPECT_NEAR(weighted(rules(), both.ego), occupant_harm(rules(), Face::left, 5.0), 1e-12);
}

}  // namespace
}  // namespace saca::collision::impact_test
