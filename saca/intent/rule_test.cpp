#include "saca/intent/rule.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include "saca/core/contract.h"

namespace saca::intent {
namespace {

using world::Actor;
using world::ActorKind;
using world::Scene;

Scene road_scene() {
  Scene scene;
  scene.ego.v_B = {20.0, 0.0};
  scene.ego_footprint = {.length = 4.7, .width = 1.9};
  scene.ego_mass = 1'700.0;
  return scene;
}

Actor car(Vec2 p_W, Vec2 v_W, Vec2 a_W = {}) {
  Actor actor{.id = 1, .footprint = {.length = 4.5, .width = 1.8}, .mass = 1'500.0};
  actor.X_WA = {p_W, norm(v_W) > 0.0 ? std::atan2(v_W.y, v_W.x) : 0.0};
  actor.v_W = v_W;
  actor.a_W = a_W;
  return actor;
}

TEST(VehiclePosterior, IsADistribution) {
  constexpr std::array kinds{ActorKind::car, ActorKind::van, ActorKind::truck,
                             ActorKind::motorcycle, ActorKind::obstacle};
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    Actor actor = car({30.0 * u(rng), 9.0 * u(rng)}, {20.0 * u(rng), 9.0 * u(rng)},
                      {9.0 * u(rng), 3.0 * u(rng)});
    actor.kind = kinds.at(static_cast<std::size_t>(i) % kinds.size());
    actor.yaw_rate = u(rng);
    const IntentPosterior p = vehicle_posterior(road_scene(), actor);
    EXPECT_NEAR(std::accumulate(p.begin(), p.end(), 0.0), 1.0, 1e-12);
    for (const double each : p) {
      EXPECT_GE(each, 0.0);
    }
  }
}

TEST(VehiclePosterior, SteadyDrivingIsMaintain) {
  EXPECT_EQ(likeliest(vehicle_posterior(road_scene(), car({30.0, 0.0}, {20.0, 0.0}))),
            Intention::maintain);
}

TEST(VehiclePosterior, HardDecelerationIsBraking) {
  EXPECT_EQ(likeliest(vehicle_posterior(road_scene(), car({30.0, 0.0}, {20.0, 0.0}, {-5.0, 0.0}))),
            Intention::brake);
  EXPECT_EQ(likeliest(vehicle_posterior(road_scene(), car({30.0, 0.0}, {20.0, 0.0}, {5.0, 0.0}))),
            Intention::maintain);
}

TEST(VehiclePosterior, LateralSpeedIsALaneChangeToItsOwnLeft) {
  EXPECT_EQ(likeliest(vehicle_posterior(road_scene(), car({30.0, -3.5}, {15.0, 1.2}))),
            Intention::lane_left);
  EXPECT_EQ(likeliest(vehicle_posterior(road_scene(), car({30.0, 3.5}, {15.0, -1.2}, {-6.0, 0.0}))),
            Intention::brake_right);
  // Oncoming traffic that moves towards +y moves to its own right.
  EXPECT_EQ(likeliest(vehicle_posterior(road_scene(), car({60.0, 3.5}, {-15.0, 1.2}))),
            Intention::lane_right);
}

TEST(VehiclePosterior, WhoIsAtRestMaintains) {
  EXPECT_EQ(vehicle_posterior(road_scene(), car({20.0, 0.0}, {}))[0], 1.0);
}

TEST(VehiclePosterior, NobodyInAVehicleStopsOrCrossesAsAWalkerDoes) {
  const IntentPosterior p =
      vehicle_posterior(road_scene(), car({20.0, 4.0}, {0.0, -1.4}, {0.0, 3.0}));
  EXPECT_EQ(p[static_cast<std::size_t>(Intention::stop)], 0.0);
  EXPECT_EQ(p[static_cast<std::size_t>(Intention::cross)], 0.0);
}

TEST(VehiclePosterior, RefusesWalkers) {
  Actor walker = car({20.0, 4.0}, {0.0, -1.4});
  walker.kind = ActorKind::pedestrian;
  EXPECT_THROW((void)vehicle_posterior(road_scene(), walker), ContractViolation);
}

}  // namespace
}  // namespace saca::intent
