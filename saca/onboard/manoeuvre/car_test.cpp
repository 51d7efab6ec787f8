#include "saca/onboard/manoeuvre/car.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <vector>

#include "saca/base/core/file.h"
#include "saca/base/core/units.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/drive.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/onboard/manoeuvre/ride.h"
#include "tests/support/scenes.h"

namespace saca::manoeuvre::car_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// Every policy that changes lanes, on every car, at the corners of its domain, from a start that is
// not straight: it ends where the road says, in the road's direction.
TEST(Car, ChangesLanesWhicheverItIs) {
  for (const char* name : prepare::shipped_cars) {
    const Car car = prepare::shipped_car(name);
    for (const PolicyId policy :
         {PolicyId::aes_left, PolicyId::aes_right, PolicyId::es_b_left, PolicyId::es_b_right}) {
      for (const double speed : {5.0, 12.0, 25.0}) {
        for (const double grip : {0.2, 0.5, 1.0}) {
          world::Scene scene = test::ego_alone(speed, grip);
          scene.ego.X_WB.yaw = from_degrees(1.5);
          scene.ego.yaw_rate = 0.05;
          const Plan plan = default_plan(policy, speed);
          const EgoMotion motion = drive(car, plan, scene, grip, 20.0);
          EXPECT_TRUE(motion.ended)
              << name << ' ' << saca::manoeuvre::name(policy) << ' ' << speed << ' ' << grip;
          const world::LanePose end = world::to_lane(scene.road, motion.track.X_WA.back());
          EXPECT_NEAR(end.d, side(policy) * scene.road.lane_width, 0.25)
              << name << ' ' << speed << ' ' << grip;
        }
      }
    }
  }
}

/// What is not known, so many standard deviations off, each by its own.
ParameterPerturbation off_by(const std::array<double, 6>& sds) {
  const ParameterPerturbation& sd = perturbation_sd;
  return {.grip = 1.0 + sds[0] * sd.grip,
          .mass = 1.0 + sds[1] * sd.mass,
          .yaw_inertia = 1.0 + sds[2] * sd.yaw_inertia,
          .stiffness = 1.0 + sds[3] * sd.stiffness,
          .lag = sds[4] * sd.lag,
          .speed = sds[5] * sd.speed};
}

// Each thing that it does not know three standard deviations off, which is as far as they are
// drawn, and all together two: the lane is still reached, and kept for two seconds more.
TEST(Car, ChangesLanesWhateverItDoesNotKnow) {
  std::vector<std::array<double, 6>> cases;
  for (std::size_t i = 0; i < 6; ++i) {
    for (const double sign : {-3.0, 3.0}) {
      cases.push_back({});
      cases.back()[i] = sign;
    }
  }
  for (unsigned mix = 0; mix < 64; ++mix) {
    cases.push_back({});
    for (std::size_t i = 0; i < 6; ++i) {
      cases.back()[i] = (mix >> i & 1U) != 0 ? 2.0 : -2.0;
    }
  }
  for (const char* name : prepare::shipped_cars) {
    const Car car = prepare::shipped_car(name);
    for (const PolicyId policy : {PolicyId::aes_left, PolicyId::es_b_right}) {
      const world::Scene scene = test::ego_alone(20.0, 0.5);
      const Plan plan = default_plan(policy, 20.0);
      const double lane = side(policy) * scene.road.lane_width;
      const double room = 0.5 * (scene.road.lane_width - footprint(car).width);  // within its lines
      for (std::size_t i = 0; i < cases.size(); ++i) {
        Ride ride(car, plan, scene, 0.5, off_by(cases[i]));
        for (int k = 0; !ride.ended() && k < 15'000; ++k) {
          ride.step();
        }
        EXPECT_TRUE(ride.ended()) << name << ' ' << i;
        for (int k = 0; k < 2'000; ++k) {
          ASSERT_NEAR(ride.state().X_WB.p.y, lane, room) << name << ' ' << i;
          ride.step();
        }
        EXPECT_NEAR(to_degrees(ride.state().X_WB.yaw), 0.0, 1.0) << name << ' ' << i;
      }
    }
  }
}

}  // namespace
}  // namespace saca::manoeuvre::car_test
