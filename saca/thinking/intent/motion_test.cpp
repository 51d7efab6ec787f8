#include "saca/thinking/intent/motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "saca/base/core/contract.h"
#include "tests/support/scenes.h"

namespace saca::intent::motion_test {
namespace {

using test::car;
using test::ego_at;
using world::Actor;
using world::ActorKind;
using world::Scene;
using world::Track;

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-9;
const MotionLaw law;

Track track_of(const Actor& actor, Intention intention, double horizon) {
  return motion_under(ego_at(20.0), actor, intention, horizon, law).track;
}

TEST(MotionUnder, MaintainKeepsSpeedAndLane) {
  const Track track = track_of(car(1, {30.0, 0.5}, {20.0, 0.0}), Intention::maintain, 4.0);
  const Pose end = pose_at(track, 4.0);
  EXPECT_NEAR(end.p.x, 110.0, rounding);
  EXPECT_NEAR(end.p.y, 0.5, rounding);
}

TEST(MotionUnder, WhoBrakesAlreadyStopsAfterTheTextbookWay) {
  const Track track = track_of(car(1, {}, {20.0, 0.0}, {-5.0, 0.0}), Intention::brake, 6.0);
  EXPECT_NEAR(pose_at(track, 6.0).p.x, 400.0 / 10.0, rounding);
}

// Speed v falls by b r / 2 while the deceleration rises to b within r, on v r - b r^2 / 6.
TEST(MotionUnder, WhoDoesNotBrakeYetNeedsTheRiseAsWell) {
  const Track track = track_of(car(1, {}, {20.0, 0.0}), Intention::brake, 12.0);
  const double left = 20.0 - 0.5 * law.braking * law.braking_rise;
  const double way = 20.0 * law.braking_rise -
                     law.braking * law.braking_rise * law.braking_rise / 6.0 +
                     left * left / (2.0 * law.braking);
  EXPECT_NEAR(pose_at(track, 12.0).p.x, way, rounding);
}

// In tiny steps, from the acceleration that is measured; also where it rests before the rise ends.
TEST(MotionUnder, BrakingGrowsFromWhatIsMeasured) {
  for (const double speed : {20.0, 3.0, 0.6}) {
    const Track track = track_of(car(1, {}, {speed, 0.0}, {-1.2, 0.0}), Intention::brake, 5.0);
    double v = speed;
    double x = 0.0;
    constexpr double dt = 1e-5;
    for (int k = 0; k < 500'000; ++k) {
      if (k % 50'000 == 0) {
        EXPECT_NEAR(pose_at(track, k * dt).p.x, x, 1e-3) << speed << ' ' << k * dt;
      }
      const double share = std::min(1.0, k * dt / law.braking_rise);
      const double before = v;
      v = std::max(0.0, v - (1.2 + (law.braking - 1.2) * share) * dt);
      x += 0.5 * (before + v) * dt;
    }
  }
}

TEST(MotionUnder, ALaneChangeEndsInTheNextLane) {
  const Track left = track_of(car(1, {30.0, -3.5}, {15.0, 0.5}), Intention::lane_left, 8.0);
  EXPECT_NEAR(pose_at(left, 8.0).p.y, 0.0, 1e-6);
  EXPECT_NEAR(pose_at(left, 8.0).yaw, 0.0, 1e-6);
  // Already across the marking: the lane that it enters, not the one after.
  const Track entering = track_of(car(1, {30.0, 1.5}, {15.0, -0.5}), Intention::lane_right, 5.0);
  EXPECT_NEAR(pose_at(entering, 5.0).p.y, 0.0, 1e-6);
  // Half a lane width is 1.75 m; 0.5 m off the centre counts as being there: one lane further.
  const Track further = track_of(car(1, {30.0, 0.5}, {15.0, -0.5}), Intention::lane_right, 8.0);
  EXPECT_NEAR(pose_at(further, 8.0).p.y, -3.5, 1e-6);
}

// From the middle between two lanes half of the usual time is left.
TEST(MotionUnder, ALaneChangeUnderWayIsFinished) {
  const Track track = track_of(car(1, {0.0, 1.76}, {20.0, -1.0}), Intention::lane_right, 4.0);
  EXPECT_GT(pose_at(track, 0.45 * law.lane_change).p.y, 0.001);
  EXPECT_NEAR(pose_at(track, 0.55 * law.lane_change).p.y, 0.0, 1e-6);
}

TEST(MotionUnder, LateralSpeedDoesNotJump) {
  for (const double lateral : {-0.4, 0.0, 0.7, 1.5}) {
    for (const Intention intention : {Intention::lane_left, Intention::brake_left}) {
      const Track track = track_of(car(1, {0.0, -2.9}, {18.0, lateral}), intention, 6.0);
      const double dt = track.step;
      // Without lateral acceleration at first, the way w aside departs from a line by O(dt^3):
      // 10 w (dt / T)^3, less than 0.3 mm, and a little for the speed that fades.
      EXPECT_NEAR(track.X_WA[1].p.y - track.X_WA[0].p.y, lateral * dt, 4e-4) << lateral;
      EXPECT_NEAR(track.X_WA[1].yaw, std::atan2(lateral, 18.0), 5e-3);
    }
  }
}

TEST(MotionUnder, ALaneChangeDoesNotOvershoot) {
  for (const double lateral : {0.3, 1.0, 2.0, 3.0}) {
    const Track track = track_of(car(1, {0.0, 2.0}, {18.0, lateral}), Intention::lane_left, 6.0);
    for (const Pose& X : track.X_WA) {
      EXPECT_LE(X.p.y, 3.5 + 1e-9) << lateral;
    }
  }
}

TEST(MotionUnder, WhoHasCrossedTheMarkingEndsItsLaneChangeEvenWhenItMaintains) {
  const Track track = track_of(car(1, {0.0, 2.2}, {18.0, 0.8}), Intention::maintain, 4.0);
  EXPECT_NEAR(pose_at(track, 4.0).p.y, 3.5, 1e-6);
  EXPECT_NEAR(track.X_WA[1].p.y, 2.2 + 0.8 * track.step, 4e-4);
  const Track leaving = track_of(car(1, {0.0, 1.3}, {18.0, 0.8}), Intention::maintain, 4.0);
  EXPECT_NEAR(pose_at(leaving, 4.0).p.y, 1.3, 1e-9);  // away from its lane's centre
}

TEST(MotionUnder, OncomingTrafficKeepsItsDirection) {
  Scene scene = ego_at(20.0);
  scene.road.curvature = 0.01;
  const Pose X_WA = world::from_lane(scene.road, {.s = 60.0, .d = 3.5, .heading = pi});
  const Actor actor = car(1, X_WA.p, rotated({10.0, 0.0}, X_WA.yaw));
  const Track track = motion_under(scene, actor, Intention::maintain, 2.0, law).track;
  const world::LanePose end = world::to_lane(scene.road, pose_at(track, 2.0));
  EXPECT_NEAR(end.d, 3.5, 1e-6);
  EXPECT_NEAR(end.s, 60.0 - 20.0 / 0.965, 1e-6);  // shorter on the inside
}

TEST(MotionUnder, CrossingTrafficGoesStraightAndBrakesStraight) {
  const Actor truck = car(1, {16.0, 6.4}, {0.0, -7.5});
  const Pose end = pose_at(track_of(truck, Intention::maintain, 2.0), 2.0);
  EXPECT_NEAR(end.p.x, 16.0, rounding);
  EXPECT_NEAR(end.p.y, -8.6, rounding);
  EXPECT_NEAR(end.yaw, -pi / 2.0, rounding);
  const Pose braked = pose_at(track_of(truck, Intention::brake, 4.0), 4.0);
  EXPECT_NEAR(braked.p.x, 16.0, rounding);
}

TEST(MotionUnder, NoSegmentIsFasterThanTheActorIs) {
  for (const double curvature : {0.0, 0.01, -0.02}) {
    Scene scene = ego_at(20.0);
    scene.road.curvature = curvature;
    for (const double speed : {0.3, 4.0, 18.0}) {
      for (const Intention intention : vehicle_intentions) {
        const Track track =
            motion_under(scene, car(1, {3.0, 0.0}, {speed, 0.02 * speed}), intention, 6.0, law)
                .track;
        for (int k = 0; k < 120; ++k) {
          EXPECT_LE(norm(velocity_at(track, 0.05 * k)), speed * std::hypot(1.0, 0.02) + 1e-6)
              << name(intention) << ' ' << speed << ' ' << k;
        }
      }
    }
  }
}

TEST(MotionUnder, NoLaneChangeEndsBroadside) {
  for (const double speed : {0.3, 2.0, 15.0}) {
    const Track track = track_of(car(1, {30.0, 0.0}, {speed, 0.0}), Intention::brake_left, 6.0);
    for (const Pose& X : track.X_WA) {
      EXPECT_LT(std::abs(X.yaw), pi / 6.0 + 1e-6);
    }
  }
}

TEST(MotionUnder, WhoIsAtRestStays) {
  Actor wreck = car(1, {30.0, 0.0}, {});
  wreck.kind = ActorKind::obstacle;
  wreck.position_sd = 0.2;
  wreck.velocity_sd = 0.5;
  const Forecast forecast = motion_under(ego_at(20.0), wreck, Intention::maintain, 4.0, law);
  EXPECT_EQ(pose_at(forecast.track, 4.0).p.x, 30.0);
  EXPECT_EQ(spread_at(forecast.spread, 4.0).along_sd, 0.2);
  // A car that stands is perceived to: it may be rolling.
  wreck.kind = ActorKind::car;
  EXPECT_NEAR(spread_at(motion_under(ego_at(20.0), wreck, Intention::brake, 4.0, law).spread, 4.0)
                  .across_sd,
              std::hypot(0.2, 2.0), rounding);
}

TEST(MotionUnder, TurnsWithTheWorld) {
  std::mt19937 rng(2);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int round = 0; round < 60; ++round) {
    Scene scene = ego_at(20.0);
    scene.road.curvature = 0.01 * u(rng);
    Actor actor = car(1, {30.0 * u(rng), 6.0 * u(rng)}, {20.0 * u(rng), 4.0 * u(rng)},
                      {4.0 * u(rng), u(rng)});
    actor.yaw_rate = 0.2 * u(rng);
    const Pose X{{100.0 * u(rng), 100.0 * u(rng)}, 3.0 * u(rng)};
    Scene turned = scene;
    turned.road.X_WL = X * scene.road.X_WL;
    Actor also = actor;
    also.X_WA = X * actor.X_WA;
    also.v_W = rotated(actor.v_W, X.yaw);
    also.a_W = rotated(actor.a_W, X.yaw);
    const Intention intention = vehicle_intentions[static_cast<std::size_t>(round) % 6];
    const Forecast a = motion_under(scene, actor, intention, 4.0, law);
    const Forecast b = motion_under(turned, also, intention, 4.0, law);
    for (std::size_t k = 0; k < a.track.X_WA.size(); ++k) {
      const Pose want = X * a.track.X_WA[k];
      EXPECT_NEAR(norm(b.track.X_WA[k].p - want.p), 0.0, 1e-6);
      EXPECT_NEAR(wrap_angle(b.track.X_WA[k].yaw - want.yaw), 0.0, 1e-6);
      EXPECT_NEAR(a.spread.at[k].along_sd, b.spread.at[k].along_sd, 1e-6);
    }
  }
}

TEST(MotionUnder, IsMirroredInAMirror) {
  const auto mirrored = [](Intention intention) {
    constexpr std::array<Intention, 6> other{Intention::maintain,    Intention::lane_right,
                                             Intention::lane_left,   Intention::brake,
                                             Intention::brake_right, Intention::brake_left};
    return other[static_cast<std::size_t>(intention)];
  };
  for (const Intention intention : vehicle_intentions) {
    const Actor actor = car(1, {10.0, -0.6}, {15.0, 0.4}, {-1.0, 0.0});
    const Actor other = car(1, {10.0, 0.6}, {15.0, -0.4}, {-1.0, 0.0});
    const Forecast a = motion_under(ego_at(20.0), actor, intention, 5.0, law);
    const Forecast b = motion_under(ego_at(20.0), other, mirrored(intention), 5.0, law);
    for (std::size_t k = 0; k < a.track.X_WA.size(); ++k) {
      EXPECT_NEAR(a.track.X_WA[k].p.x, b.track.X_WA[k].p.x, rounding);
      EXPECT_NEAR(a.track.X_WA[k].p.y, -b.track.X_WA[k].p.y, rounding);
      EXPECT_NEAR(a.spread.at[k].across_sd, b.spread.at[k].across_sd, rounding);
    }
  }
}

TEST(Spread, BeginsAsPerceivedAndNeverShrinks) {
  Actor actor = car(1, {10.0, -0.6}, {15.0, 0.4}, {-1.0, 0.0});
  actor.position_sd = 0.3;
  actor.velocity_sd = 0.2;
  for (const Intention intention : vehicle_intentions) {
    const Forecast forecast = motion_under(ego_at(20.0), actor, intention, 6.0, law);
    ASSERT_EQ(forecast.spread.at.size(), forecast.track.X_WA.size());
    EXPECT_EQ(forecast.spread.at[0].along_sd, 0.3);
    EXPECT_EQ(forecast.spread.at[0].across_sd, 0.3);
    for (std::size_t k = 1; k < forecast.spread.at.size(); ++k) {
      EXPECT_GE(forecast.spread.at[k].along_sd, forecast.spread.at[k - 1].along_sd)
          << name(intention);
      EXPECT_GE(forecast.spread.at[k].across_sd, forecast.spread.at[k - 1].across_sd)
          << name(intention);
    }
  }
}

TEST(Spread, IsThatOfPlaceAndSpeedWhereNothingElseIsUnknown) {
  Actor actor = car(1, {10.0, 0.0}, {15.0, 0.0});
  actor.position_sd = 0.3;
  actor.velocity_sd = 0.2;
  MotionLaw known = law;
  known.driving.sd = known.braking_log_sd = known.lane_change_log_sd = 0.0;
  const Forecast forecast = motion_under(ego_at(20.0), actor, Intention::lane_left, 6.0, known);
  EXPECT_NEAR(spread_at(forecast.spread, 3.0).along_sd, std::hypot(0.3, 0.6), rounding);
  EXPECT_NEAR(spread_at(forecast.spread, 3.0).across_sd, std::hypot(0.3, 0.6), rounding);
  EXPECT_NEAR(spread_at(forecast.spread, -1.0).along_sd, 0.3, rounding);
  EXPECT_NEAR(spread_at(forecast.spread, 9.0).along_sd, std::hypot(0.3, 1.2), rounding);
}

// Var x(t) = sd^2 sum over s, u of (t - s) (t - u) exp(-|s - u| / tau) ds du.
TEST(Spread, OfAWaveringAccelerationIsItsTwofoldIntegral) {
  MotionLaw slow = law;
  slow.driving.time = 1.7;
  const Forecast forecast =
      motion_under(ego_at(20.0), car(1, {}, {15.0, 0.0}), Intention::maintain, 6.0, slow);
  for (const double t : {0.05, 0.5, 2.0, 6.0}) {
    constexpr int n = 400;
    const double dt = t / n;
    double variance = 0.0;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const double s = (i + 0.5) * dt;
        const double u = (j + 0.5) * dt;
        variance += (t - s) * (t - u) * std::exp(-std::abs(s - u) / slow.driving.time);
      }
    }
    const double want = slow.driving.sd * dt * std::sqrt(variance);
    EXPECT_NEAR(spread_at(forecast.spread, t).along_sd, want, 1e-3 * want) << t;
  }
}

// To first order: how far the way moves when the deceleration is a little harder.
TEST(Spread, OfBrakingIsThatOfTheDeceleration) {
  const Actor actor = car(1, {}, {12.0, 0.0}, {-0.8, 0.0});
  const Forecast forecast = motion_under(ego_at(20.0), actor, Intention::brake, 4.0, law);
  constexpr double little = 1e-5;
  MotionLaw harder = law;
  harder.braking *= 1.0 + little;
  const Forecast other = motion_under(ego_at(20.0), actor, Intention::brake, 4.0, harder);
  for (std::size_t k = 1; k < forecast.spread.at.size(); ++k) {  // it rests after 2.1 s
    const double slope = (forecast.track.X_WA[k].p.x - other.track.X_WA[k].p.x) / little;
    EXPECT_NEAR(forecast.spread.at[k].along_sd, law.braking_log_sd * slope, 1e-3) << k;
  }
}

TEST(Spread, OfALaneChangeIsThatOfItsDuration) {
  const Actor actor = car(1, {}, {15.0, 0.0});
  const Forecast forecast = motion_under(ego_at(20.0), actor, Intention::lane_left, 6.0, law);
  constexpr double little = 1e-5;
  MotionLaw slower = law;
  slower.lane_change *= 1.0 + little;
  const Forecast other = motion_under(ego_at(20.0), actor, Intention::lane_left, 6.0, slower);
  const auto largest = static_cast<std::size_t>(0.6 * law.lane_change / forecast.track.step);
  for (std::size_t k = 1; k <= largest; ++k) {
    const double slope = (forecast.track.X_WA[k].p.y - other.track.X_WA[k].p.y) / little;
    EXPECT_NEAR(forecast.spread.at[k].across_sd, law.lane_change_log_sd * slope, 1e-3) << k;
  }
  EXPECT_EQ(forecast.spread.at.back().across_sd, forecast.spread.at[largest + 1].across_sd);
}

TEST(MotionUnder, RefusesAnEmptyHorizonAndALawOutOfRange) {
  const Actor actor = car(1, {}, {1.0, 0.0});
  EXPECT_THROW((void)track_of(actor, Intention::maintain, 0.0), ContractViolation);
  MotionLaw broken = law;
  broken.braking = std::nan("");
  EXPECT_THROW((void)motion_under(ego_at(20.0), actor, Intention::brake, 1.0, broken),
               ContractViolation);
  EXPECT_THROW((void)world::spread_at({}, 0.0), ContractViolation);
}

}  // namespace
}  // namespace saca::intent::motion_test
