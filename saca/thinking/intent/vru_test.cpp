#include "saca/thinking/intent/vru.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "saca/base/core/contract.h"
#include "tests/support/scenes.h"

namespace saca::intent::vru_test {
namespace {

using world::Actor;
using world::ActorKind;
using world::Scene;

const MotionLaw law;

/// One lane, kerbs at 1.75 m to either side.
Scene street() {
  return test::ego_at(14.0);
}

Actor vru(Vec2 p_W, Vec2 v_W, Vec2 a_W = {}) {
  Actor actor =
      test::car(1, p_W, v_W, a_W, {.shape = world::Shape::ellipse, .length = 0.5, .width = 0.5});
  actor.kind = ActorKind::pedestrian;
  actor.mass = 75.0;
  return actor;
}

Actor cyclist(Vec2 p_W, Vec2 v_W, Vec2 a_W = {}) {
  Actor actor = vru(p_W, v_W, a_W);
  actor.kind = ActorKind::bicycle;
  return actor;
}

double probability(const Actor& actor, Intention intention, double ahead = 0.0) {
  return vru_posterior(street(), actor, ahead)[static_cast<std::size_t>(intention)];
}

TEST(VruPosterior, IsADistributionOverWhatWalkersDo) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int i = 0; i < 1'000; ++i) {
    Actor actor = vru({30.0 * u(rng), 9.0 * u(rng)}, {4.0 * u(rng), 3.0 * u(rng)},
                      {3.0 * u(rng), 3.0 * u(rng)});
    actor.kind = i % 2 == 0 ? ActorKind::pedestrian : ActorKind::bicycle;
    actor.yaw_rate = u(rng);
    const IntentPosterior p = vru_posterior(street(), actor, i % 3 * 0.5);
    EXPECT_NEAR(std::accumulate(p.begin(), p.end(), 0.0), 1.0, 1e-12);
    for (const double each : p) {
      EXPECT_GE(each, 0.0);
    }
    for (const Intention intention : vehicle_intentions) {
      EXPECT_TRUE(intention == Intention::maintain ||
                  p[static_cast<std::size_t>(intention)] == 0.0);
    }
  }
}

TEST(VruPosterior, WhoStandsAtTheKerbMayStartAndWhoStandsFarAwayStays) {
  EXPECT_NEAR(probability(vru({20.0, 1.75}, {}), Intention::cross), 0.08, 1e-12);
  EXPECT_NEAR(probability(vru({20.0, -1.75}, {}), Intention::cross), 0.08, 1e-12);
  EXPECT_LT(probability(vru({20.0, 7.0}, {}), Intention::cross), 0.01);
  EXPECT_EQ(probability(vru({20.0, 1.75}, {}), Intention::stop), 0.0);  // it has
}

TEST(VruPosterior, WhoWalksToTheLaneCrossesItTheSoonerTheNearer) {
  EXPECT_GT(probability(vru({20.0, 2.0}, {0.0, -1.4}), Intention::cross), 0.5);
  double last = 1.0;
  for (double d = 2.0; d < 12.0; d += 1.0) {
    const double p = probability(vru({20.0, d}, {0.0, -1.4}), Intention::cross);
    EXPECT_LT(p, last);
    last = p;
  }
  EXPECT_LT(probability(vru({20.0, 3.0}, {0.0, 1.4}), Intention::cross), 0.01);  // away
}

TEST(VruPosterior, RidingAlongTheRoadIsMaintaining) {
  EXPECT_GT(probability(cyclist({20.0, -1.0}, {5.0, 0.0}), Intention::maintain), 0.95);
  EXPECT_GT(probability(cyclist({20.0, -1.0}, {5.0, 0.2}), Intention::maintain), 0.93);  // wobbles
  EXPECT_GT(probability(vru({20.0, -2.5}, {1.4, 0.0}), Intention::maintain), 0.93);
}

TEST(VruPosterior, WhoSlowsDownStops) {
  EXPECT_GT(probability(vru({20.0, 3.0}, {0.0, -1.2}, {0.0, 1.6}), Intention::stop), 0.9);
  EXPECT_GT(probability(cyclist({20.0, -1.0}, {5.0, 0.0}, {-2.7, 0.0}), Intention::stop), 0.9);
  EXPECT_LT(probability(cyclist({20.0, -1.0}, {5.0, 0.0}, {-0.5, 0.0}), Intention::stop), 0.1);
  // Unprovoked, those who cross are likelier to wait than those who go along.
  EXPECT_GT(probability(vru({20.0, 3.0}, {0.0, -1.4}), Intention::stop), 0.10);
  EXPECT_LT(probability(vru({20.0, 3.0}, {1.4, 0.0}), Intention::stop), 0.05);
}

TEST(VruPosterior, SoonIsNowOfWhoWentOn) {
  // 1.4 m/s for half a second: 0.7 m nearer.
  const Actor now = vru({20.0, 4.0}, {0.0, -1.4});
  EXPECT_NEAR(probability(now, Intention::cross, 0.5),
              probability(vru({20.0, 3.3}, {0.0, -1.4}), Intention::cross), 1e-9);
  // Slowing by 1.4 m/s^2 for a second, it stands 0.7 m on.
  const Actor slows = vru({20.0, 4.0}, {0.0, -1.4}, {0.0, 1.4});
  EXPECT_NEAR(probability(slows, Intention::cross, 1.0),
              probability(vru({20.0, 3.3}, {}), Intention::cross), 1e-9);
}

TEST(VruPosterior, IsTheSameInAMirrorAndInATurnedWorld) {
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const Vec2 p{30.0 * u(rng), 6.0 * u(rng)};
    const Vec2 v{3.0 * u(rng), 3.0 * u(rng)};
    const Vec2 a{u(rng), u(rng)};
    const IntentPosterior here = vru_posterior(street(), vru(p, v, a));
    const IntentPosterior mirrored =
        vru_posterior(street(), vru({p.x, -p.y}, {v.x, -v.y}, {a.x, -a.y}));
    const Pose X{{50.0, -20.0}, 3.0 * u(rng)};
    Scene turned_street = street();
    turned_street.road.X_WL = X;
    const Actor turned = vru(X * p, rotated(v, X.yaw), rotated(a, X.yaw));
    const IntentPosterior there = vru_posterior(turned_street, turned);
    for (std::size_t k = 0; k < num_intentions; ++k) {
      EXPECT_NEAR(here[k], mirrored[k], 1e-9);
      EXPECT_NEAR(here[k], there[k], 1e-9);
    }
  }
}

TEST(VruMotion, MaintainingAPedestrianGoesStraightAndACyclistFollowsTheLane) {
  Scene scene = street();
  scene.road.curvature = 0.02;
  const auto end = [&](const Actor& actor) {
    return pose_at(motion_under(scene, actor, Intention::maintain, 4.0, law).track, 4.0).p;
  };
  const Vec2 walked = end(vru({0.0, -1.0}, {1.4, 0.0}));
  EXPECT_NEAR(walked.x, 5.6, 1e-9);
  EXPECT_NEAR(walked.y, -1.0, 1e-9);
  const world::LanePose ridden =
      world::to_lane(scene.road, {end(cyclist({0.0, -1.0}, {5.0, 0.0})), 0.0});
  EXPECT_NEAR(ridden.d, -1.0, 1e-6);
  EXPECT_NEAR(ridden.s, 20.0 / 1.02, 1e-6);  // longer on the outside of the bend
}

TEST(VruMotion, StoppingTakesAStepOnFootAndMoreOnABicycle) {
  const auto way = [&](const Actor& actor) {
    return norm(pose_at(motion_under(street(), actor, Intention::stop, 6.0, law).track, 6.0).p -
                actor.X_WA.p);
  };
  EXPECT_NEAR(way(vru({0.0, 5.0}, {0.0, -1.4})), 1.96 / (2.0 * law.walking_stop), 1e-9);
  EXPECT_NEAR(way(cyclist({0.0, 0.0}, {5.0, 0.0})), 25.0 / (2.0 * law.cycling_stop), 1e-9);
  EXPECT_NEAR(way(cyclist({0.0, 0.0}, {5.0, 0.0}, {-5.0, 0.0})), 2.5, 1e-9);  // as measured
}

TEST(VruMotion, CrossingEndsAtRightAnglesToTheLaneAtWalkingSpeedAtLeast) {
  struct Start {
    Actor actor;
    double yaw;
    double speed;
  };
  constexpr double right = -0.5 * std::numbers::pi;
  for (const Start& start :
       {Start{vru({20.0, 3.0}, {}), right, 1.4}, Start{vru({20.0, -3.0}, {}), -right, 1.4},
        Start{vru({20.0, 3.0}, {1.0, 0.0}), right, 1.4},
        Start{vru({20.0, 3.0}, {0.0, -2.5}), right, 2.5},
        Start{vru({20.0, 0.5}, {0.0, 1.4}), -right, 1.4},  // goes on to its side
        Start{cyclist({20.0, -1.9}, {5.0, 0.0}), -right, 5.0}}) {
    const Forecast forecast = motion_under(street(), start.actor, Intention::cross, 6.0, law);
    const Vec2 v = velocity_at(forecast.track, 5.9);
    EXPECT_NEAR(std::atan2(v.y, v.x), start.yaw, 1e-9);
    EXPECT_NEAR(norm(v), start.speed, 1e-9);
    for (int k = 0; k < 120; ++k) {
      EXPECT_LE(norm(velocity_at(forecast.track, 0.05 * k)), start.speed + 1e-9);
    }
  }
}

// 2 m/s^2 sideways at 5 m/s: a quarter of a circle of 12.5 m radius.
TEST(VruMotion, ACyclistTurnsInACircle) {
  const Forecast forecast =
      motion_under(street(), cyclist({0.0, -20.0}, {5.0, 0.0}), Intention::cross, 8.0, law);
  const double turned = 0.5 * std::numbers::pi * 5.0 / law.turning;
  const Vec2 at = pose_at(forecast.track, turned).p;
  EXPECT_NEAR(at.x, 12.5, 0.02);
  EXPECT_NEAR(at.y, -20.0 + 12.5, 0.02);
  EXPECT_NEAR(pose_at(forecast.track, 8.0).p.x, 12.5, 0.02);
}

TEST(VruMotion, IsAsUnsureToTheSideAsAhead) {
  Actor actor = vru({0.0, 4.0}, {1.4, 0.0});
  actor.position_sd = 0.1;
  for (const Intention intention : {Intention::maintain, Intention::cross}) {
    const Forecast forecast = motion_under(street(), actor, intention, 3.0, law);
    EXPECT_EQ(forecast.spread.at[0].along_sd, 0.1);
    EXPECT_NEAR(spread_at(forecast.spread, 2.0).across_sd,
                std::hypot(0.1, ornstein_uhlenbeck_sd(law.walking, 2.0)), 1e-9);
    EXPECT_EQ(spread_at(forecast.spread, 2.0).along_sd, spread_at(forecast.spread, 2.0).across_sd);
  }
}

TEST(VruMotion, RefusesWhatIsNotForThem) {
  Actor car = vru({0.0, 4.0}, {1.4, 0.0});
  car.kind = ActorKind::car;
  EXPECT_THROW((void)motion_under(street(), car, Intention::cross, 1.0, law), ContractViolation);
  EXPECT_THROW((void)vru_posterior(street(), car), ContractViolation);
  EXPECT_THROW((void)crossing_motion(street(), car, 1.0, law), ContractViolation);
  const Actor foot = vru({0.0, 4.0}, {1.4, 0.0});
  EXPECT_THROW((void)motion_under(street(), foot, Intention::lane_left, 1.0, law),
               ContractViolation);
  EXPECT_THROW((void)vru_posterior(street(), foot, -1.0), ContractViolation);
}

}  // namespace
}  // namespace saca::intent::vru_test
