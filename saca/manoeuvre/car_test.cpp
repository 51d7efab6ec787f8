#include "saca/manoeuvre/car.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "saca/core/file.h"
#include "saca/core/units.h"
#include "saca/manoeuvre/default_car.h"
#include "saca/manoeuvre/draws.h"
#include "saca/manoeuvre/drive.h"
#include "saca/vehicle/default_car.h"

namespace saca::manoeuvre {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(Car, IsItsParametersAndTheTuningBesideThem) {
  const fs::path tree = fs::path(__FILE__).parent_path().parent_path().parent_path();
  const auto car = read_car(tree / "data/vehicles/compact_rwd_ev.toml");
  ASSERT_TRUE(car.has_value()) << car.error().message;
  EXPECT_EQ(car.value().mass, vehicle::default_car().mass);
  const auto tuning = read_tuning(tree / "data/vehicles/compact_rwd_ev.tuning.toml");
  ASSERT_TRUE(tuning.has_value());
  EXPECT_EQ(car.value().tuning.drift.turning, tuning.value().drift.turning);
}

TEST(Car, WithoutTuningSaysWhatMakesIt) {
  const fs::path tree = fs::path(__FILE__).parent_path().parent_path().parent_path();
  const fs::path alone = fs::path(testing::TempDir()) / "saca_car_alone.toml";
  ASSERT_EQ(write_file(alone, read_file(tree / "data/vehicles/compact_rwd_ev.toml").value()),
            std::nullopt);
  const auto car = read_car(alone);
  fs::remove(alone);
  ASSERT_FALSE(car.has_value());
  EXPECT_THAT(car.error().message, HasSubstr("saca_car_alone.tuning.toml"));
  EXPECT_THAT(car.error().message, HasSubstr("saca tune --car"));
}

// Every policy that changes lanes, on every car, at the corners of its domain, from a start that is
// not straight: it ends where the road says, in the road's direction.
TEST(Car, ChangesLanesWhicheverItIs) {
  for (const char* name : shipped_cars) {
    const Car car = shipped_car(name);
    for (const PolicyId policy :
         {PolicyId::aes_left, PolicyId::aes_right, PolicyId::es_b_left, PolicyId::es_b_right}) {
      for (const double speed : {5.0, 12.0, 25.0}) {
        for (const double grip : {0.2, 0.5, 1.0}) {
          world::Scene scene;
          scene.ego.v_B = {speed, 0.0};
          scene.ego.X_WB.yaw = from_degrees(1.5);
          scene.ego.yaw_rate = 0.05;
          scene.grip = grip;
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

// A grip 18 % less than known, a heavier car, slower actuators: the lane is still reached and kept.
TEST(Car, ChangesLanesWhateverItDoesNotKnow) {
  for (const char* name : shipped_cars) {
    const Car car = shipped_car(name);
    for (const PolicyId policy : {PolicyId::aes_left, PolicyId::es_b_right}) {
      world::Scene scene;
      scene.ego.v_B = {20.0, 0.0};
      scene.grip = 0.5;
      for (const Ending& ending :
           draw_endings(car, default_plan(policy, 20.0), scene, 0.5, 15.0, 20, 5, 0, 2)) {
        EXPECT_TRUE(ending.ended) << name;
        EXPECT_NEAR(ending.X_WB.p.y, side(policy) * scene.road.lane_width, 0.3) << name;
      }
    }
  }
}

}  // namespace
}  // namespace saca::manoeuvre
