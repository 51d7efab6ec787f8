#include "saca/lab/learned_danger/perceived.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>

#include "saca/lab/learned_danger/acting.h"
#include "saca/lab/learned_danger/learned.h"
#include "saca/lab/learned_danger/networks_for_test.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/danger/risk.h"
#include "tests/support/scenes.h"

namespace saca::learned_danger::perceived_test {
namespace {

/// V = h + log(1 + exp(v_x / 20 + steering / 0.2)), where both are positive.
Network network() {
  formats::Tensors all = networks_that_hand_on();
  all.tensors.at("v.0.weight").values[0] = 1.0F;
  all.tensors.at("v.0.weight").values[5] = 1.0F;
  return Network::from(all, "weights").value();
}

world::Scene scene_at(double speed) {
  return test::ego_at(speed, manoeuvre::footprint(prepare::default_car()));
}

// In a steady turn of radius r the front wheels of a car without slip stand at atan(wheelbase / r).
TEST(PerceivedEgo, HasTheControlsThatItsMotionNeeds) {
  const manoeuvre::Car car = prepare::default_car();
  constexpr double r = 50.0;
  const Ego turning = perceived_ego(car, {.v_B = {10.0, 0.0}, .yaw_rate = -10.0 / r, .a_B = {}});
  EXPECT_NEAR(turning.steering, -std::atan((car.cg_to_front_axle + car.cg_to_rear_axle) / r),
              1e-12);
  EXPECT_EQ(turning.braking, 0.0);
  const Ego braking = perceived_ego(car, {.v_B = {10.0, 0.0}, .a_B = {-4.0, 0.0}});
  EXPECT_EQ(braking.braking, 4.0);
  EXPECT_EQ(braking.driving, 0.0);
  EXPECT_EQ(perceived_ego(car, {.v_B = {10.0, 0.0}, .a_B = {2.0, 0.0}}).driving, 2.0);
  const Ego at_rest = perceived_ego(car, {.v_B = {0.0, 0.0}, .yaw_rate = 1.0, .a_B = {}});
  EXPECT_EQ(at_rest.steering, 0.0);
}

TEST(MostDangerous, AreThreeOfFourWithTheHighestValue) {
  world::Scene scene = scene_at(10.0);
  for (const double x : {70.0, 20.0, 90.0, 9.0}) {
    scene.actors.push_back(test::car(static_cast<std::uint8_t>(scene.actors.size() + 1), {x, 0.0}));
  }
  const State state = most_dangerous(network(), prepare::default_car(), scene);
  ASSERT_EQ(state.obstacles.size(), 3U);
  EXPECT_EQ(state.obstacles[0].X_WO.p.x, 9.0);
  EXPECT_EQ(state.obstacles[1].X_WO.p.x, 20.0);
  EXPECT_EQ(state.obstacles[2].X_WO.p.x, 70.0);
}

TEST(MostDangerous, NobodyIsNobody) {
  EXPECT_TRUE(most_dangerous(network(), prepare::default_car(), scene_at(10.0)).obstacles.empty());
}

// One scene by two ways: in the world's frame, and in the obstacle's.
TEST(MostDangerous, TellsWhatTheObstaclesFrameTells) {
  const manoeuvre::Car car = prepare::default_car();
  world::Scene scene = scene_at(14.0);
  scene.ego.X_WB = {{3.0, -2.0}, 0.4};
  scene.ego.v_B = {14.0, 0.5};
  scene.ego.yaw_rate = 0.2;
  world::Actor other = test::car(1, {25.0, 6.0}, {-3.0, 4.0});
  other.X_WA.yaw = std::atan2(4.0, -3.0);
  scene.actors.push_back(other);
  std::array<double, num_bins> none{};
  const auto learned =
      learned_value(std::make_shared<const Network>(network()), Margins(none), car);
  const auto in_its_frame = learned(danger::meeting_of(scene, scene.actors[0]),
                                    danger::motion_of(scene, scene.actors[0]));
  ASSERT_TRUE(in_its_frame.has_value());
  EXPECT_NEAR(joint_v(network(), scene.ego_footprint, most_dangerous(network(), car, scene)),
              *in_its_frame, 1e-4);
}

}  // namespace
}  // namespace saca::learned_danger::perceived_test
