#include "saca/onboard/manoeuvre/drift.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "saca/base/core/angle.h"
#include "saca/base/core/units.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/controller.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/onboard/manoeuvre/ride.h"
#include "saca/onboard/vehicle/prototype.h"
#include "tests/support/scenes.h"

namespace saca::manoeuvre::drift_test {
namespace {

using test::ego_alone;

constexpr Plan left{PolicyId::t_drift_left, std::nullopt};
constexpr Plan right{PolicyId::t_drift_right, std::nullopt};

/// Where and when the car has come to rest.
struct End {
  Pose X_WB;
  double time = 0.0;
};

End drifted(const Plan& plan, const world::Scene& scene,
            const ParameterPerturbation& perturbation = {}) {
  Ride ride(prepare::default_car(), plan, scene, scene.grip, perturbation);
  End end;
  while (!ride.ended() && end.time < 30.0) {
    ride.step();
    end.time += vehicle::usual_step;
  }
  EXPECT_TRUE(vehicle::at_rest(ride.state()));
  end.X_WB = ride.state().X_WB;
  return end;
}

double heading_error(const End& end, double side) {
  return std::abs(side * to_degrees(end.X_WB.yaw) - 90.0);
}

// As near to the prototype as `saca physics` says; here from a road user's side: across the lane,
// in time, and with the room that it takes to each side.
TEST(TDrift, StopsAcrossTheLaneAsTheReferenceDoes) {
  for (const auto& [speed, time, forward] : vehicle::prototype_drifts) {
    const End end = drifted(left, ego_alone(speed, 0.9));
    EXPECT_NEAR(to_degrees(end.X_WB.yaw), 90.0, 5.0) << speed;
    EXPECT_NEAR(end.time, time, vehicle::drift_time_band * time) << speed;
    EXPECT_NEAR(end.X_WB.p.x, forward, vehicle::drift_forward_band) << speed;
    EXPECT_GE(end.X_WB.p.y, vehicle::drift_least_sideways) << speed;
    EXPECT_LE(end.X_WB.p.y, vehicle::drift_most_sideways) << speed;
  }
}

TEST(TDrift, EndsAcrossTheLaneWhateverItDoesNotKnow) {
  std::mt19937_64 rng(11);
  constexpr int num_draws = 60;
  for (const auto& [speed, grip] : {std::pair{10.0, 0.9}, {16.0, 0.9}, {14.0, 0.5}}) {
    int num_good = 0;
    for (int i = 0; i < num_draws; ++i) {
      num_good +=
          heading_error(drifted(left, ego_alone(speed, grip), draw(rng)), 1.0) <= 10.0 ? 1 : 0;
    }
    EXPECT_GE(num_good, 54) << speed << " m/s, grip " << grip;  // 90 %
  }
}

TEST(TDrift, EndsAcrossTheLaneAtTheCornersOfItsDomain) {
  const DriftDomain domain = prepare::default_car().tuning.domain;
  int num_possible = 0;
  for (std::size_t i = 0; i < DriftDomain::grips.size(); ++i) {
    if (domain.slowest[i] > domain.fastest[i]) {
      continue;
    }
    ++num_possible;
    const double grip = DriftDomain::grips[i];
    for (const double speed : {domain.slowest[i], domain.fastest[i]}) {
      for (const double bend : {-0.3, 0.0, 0.3}) {  // share of the grip that it takes
        world::Scene scene = ego_alone(speed, grip);
        scene.road.curvature = bend * grip * vehicle::gravity / (speed * speed);
        const End end = drifted(left, scene);
        const double heading = world::to_lane(scene.road, end.X_WB).heading;
        EXPECT_NEAR(to_degrees(heading), 90.0, bend == 0.0 ? 10.0 : 15.0)
            << speed << ' ' << grip << ' ' << bend;
      }
    }
  }
  EXPECT_GE(num_possible, 5);
}

TEST(TDrift, TurnsInByTheInnerBrakesAndTheFrontWheels) {
  const Car car = prepare::default_car();
  const DriftLaw law{.turning = 1.5,
                     .most_turning = 2.0,
                     .gain = 8.0,
                     .lead = 0.1,
                     .front_release = 0.5,
                     .rear_release = 0.2,
                     .outer_release = 0.6,
                     .motor_share = -0.9,
                     .steering = 0.25,
                     .slide_share = 0.9,
                     .lock_speed = 0.4};
  using vehicle::Wheel;
  DriftState memory;
  const vehicle::Command in = drift_left(car, law, 0.9, {.v_B = {14.0, 0.0}}, 1e-3, memory);
  EXPECT_NEAR(in.steering, 0.25, 1e-12);
  EXPECT_LT(in.motor_torque, 0.0);
  EXPECT_LT(in.brake_torque[Wheel::front_right], in.brake_torque[Wheel::front_left]);
  EXPECT_LT(in.brake_torque[Wheel::front_left], in.brake_torque[Wheel::rear_left]);
  // Turning faster than wanted, the other way round.
  memory = {.yaw_rate = 2.5};
  const vehicle::Command out =
      drift_left(car, law, 0.9, {.v_B = {14.0, 0.0}, .yaw_rate = 2.5}, 1e-3, memory);
  EXPECT_LT(out.brake_torque[Wheel::front_left], out.brake_torque[Wheel::front_right]);
  EXPECT_EQ(out.motor_torque, 0.0);
  memory = {};
  const vehicle::Command mirrored = drift_right(car, law, 0.9, {.v_B = {14.0, 0.0}}, 1e-3, memory);
  EXPECT_EQ(mirrored.steering, -in.steering);
  EXPECT_EQ(mirrored.brake_torque[Wheel::front_left], in.brake_torque[Wheel::front_right]);
  EXPECT_EQ(mirrored.brake_torque[Wheel::rear_right], in.brake_torque[Wheel::rear_left]);
}

TEST(TDrift, NeverDrivesASlowCarOff) {
  const Car car = prepare::default_car();
  DriftLaw law = car.tuning.drift;
  for (const double share : {-1.0, 1.0}) {
    law.motor_share = share;
    for (const double v_x : {-1.0, 1.0}) {
      DriftState memory;
      const vehicle::Command command = drift_left(
          car, law, 0.9, {.heading = 0.2, .v_B = {v_x, -0.5}}, vehicle::usual_step, memory);
      EXPECT_LE(command.motor_torque * v_x, 0.0) << share << ' ' << v_x;
    }
  }
}

TEST(TDrift, StartsFromWhatItFinds) {
  for (const double sign : {-1.0, 1.0}) {
    world::Scene scene = ego_alone(14.0, 0.9);
    scene.ego.X_WB.yaw = sign * from_degrees(4.0);
    scene.ego.v_B.y = sign * 0.3;
    scene.ego.yaw_rate = sign * 0.15;
    EXPECT_LE(heading_error(drifted(left, scene), 1.0), 8.0) << sign;
  }
}

TEST(TDrift, LeftAndRightAreMirrorImages) {
  world::Scene scene = ego_alone(13.0, 0.7);
  scene.ego.yaw_rate = 0.1;
  world::Scene mirrored = scene;
  mirrored.ego.yaw_rate = -0.1;
  const End a = drifted(left, scene);
  const End b = drifted(right, mirrored);
  EXPECT_EQ(a.time, b.time);
  EXPECT_NEAR(a.X_WB.p.x, b.X_WB.p.x, 1e-6);
  EXPECT_NEAR(a.X_WB.p.y, -b.X_WB.p.y, 1e-6);
  EXPECT_NEAR(a.X_WB.yaw, -b.X_WB.yaw, 1e-6);
}

// The lane decides what across means, not the world.
TEST(TDrift, IsAcrossTheLaneInAnyWorld) {
  world::Scene scene = ego_alone(14.0, 0.9);
  scene.road.X_WL = {{100.0, -40.0}, 2.0};
  scene.ego.X_WB = scene.road.X_WL;
  const End end = drifted(left, scene);
  EXPECT_NEAR(wrap_angle(end.X_WB.yaw - 2.0), 0.5 * std::numbers::pi, from_degrees(5.0));
}

TEST(TDrift, LocksAllWheelsWhereNothingIsToBeTurned) {
  const Car car = prepare::default_car();
  DriftState memory;
  const DriftLaw law{
      .turning = 1.0, .most_turning = 2.0, .gain = 5.0, .slide_share = 1.0, .lock_speed = 0.5};
  const vehicle::Command command = drift_left(
      car, law, 0.9, {.heading = 0.5 * std::numbers::pi, .v_B = {0.0, -5.0}}, 1e-3, memory);
  for (const double torque : command.brake_torque) {
    EXPECT_GT(torque, 0.9 * vehicle::gravity * 0.25 * car.mass * car.wheel_radius);
  }
  EXPECT_EQ(command.motor_torque, 0.0);
}

}  // namespace
}  // namespace saca::manoeuvre::drift_test
