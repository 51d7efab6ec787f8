#include "saca/lab/learned_danger/learned.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>

#include "saca/base/formats/tensors.h"
#include "saca/lab/learned_danger/networks_for_test.h"
#include "saca/lab/learned_danger/state.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::learned_danger::learned_test {
namespace {

/// Layers that hand on the first input, v_x / 20, and the sixth, the steering / 0.2: V = h +
/// log(1 + exp(first + sixth)), as long as both are positive.
formats::Tensors handing_on() {
  formats::Tensors all = networks_that_hand_on();
  for (const char* const name : {"v.", "q1.", "q2."}) {
    std::vector<float>& first = all.tensors.at(name + std::string("0.weight")).values;
    first[0] = 1.0F;
    first[5] = 1.0F;
  }
  return all;
}

class Learned : public testing::Test {
 protected:
  Learned() {
    metres_.fill(0.25);
    metres_[bin_of(false, 15.0, 0.9, 1)] = 0.75;
    metres_[bin_of(true, 0.5, 0.9, 1)] = 0.05;
    metres_[bin_of(false, 25.0, 0.3, 1)] = Margins::none;
  }
  [[nodiscard]] danger::LearnedValue value() const {
    return learned_value(
        std::make_shared<const Network>(Network::from(handing_on(), "weights").value()),
        Margins(metres_), car_);
  }
  /// A standing car of 4.5 m, `gap` [m] before the ego's front.
  [[nodiscard]] danger::Meeting ahead(double gap, double speed) const {
    const world::Footprint body = manoeuvre::footprint(car_);
    const double distance = body.centre_x + 0.5 * body.length + gap + 2.25;
    return {.ego = body,
            .obstacle = {.length = 4.5, .width = 1.8},
            .grip = 0.9,
            .state = {-distance, 0.0, 0.0, speed}};
  }

  const manoeuvre::Car car_ = prepare::default_car();
  std::array<double, num_bins> metres_{};
};

TEST_F(Learned, AddsTheMarginOfItsBin) {
  EXPECT_NEAR(value()(ahead(6.0, 15.0), {}).value(), -6.0 + std::log1p(std::exp(0.75)) + 0.75,
              1e-4);
  EXPECT_NEAR(value()(ahead(6.0, 25.0), {}).value(), -6.0 + std::log1p(std::exp(1.25)) + 0.25,
              1e-4);
  EXPECT_NEAR(value()(ahead(6.0, 0.5), {}).value(), -6.0 + std::log1p(std::exp(0.025)) + 0.05, 1e-4)
      << "braking straight is enough";
  danger::Meeting slippery = ahead(6.0, 25.0);
  slippery.grip = 0.3;
  EXPECT_FALSE(value()(slippery, {}).has_value()) << "no margin is enough there";
  slippery = ahead(0.5, 25.0);
  slippery.grip = 0.3;
  EXPECT_NEAR(value()(slippery, {}).value(), -0.5 + std::log1p(std::exp(1.25)), 1e-4)
      << "danger needs none";
}

TEST_F(Learned, SeesHowTheEgoTurns) {
  // On a curve of 20 m the wheels are turned by atan(2.8 / 20).
  const danger::Motion turning{.yaw_rate = 15.0 / 20.0};
  const double steering = std::atan((car_.cg_to_front_axle + car_.cg_to_rear_axle) / 20.0) / 0.2;
  EXPECT_NEAR(value()(ahead(6.0, 15.0), turning).value(),
              -6.0 + std::log1p(std::exp(0.75 + steering)) + 0.75, 1e-4);
  // Sliding at 60 degrees the body stands across its way: v_x is half of the speed.
  danger::Meeting sliding = ahead(9.0, 20.0);
  const danger::Motion slip{.sideslip = std::numbers::pi / 3.0};
  const double told = value()(sliding, slip).value();
  State state;
  state.ego.X_WB = {{sliding.state[0], 0.0}, -std::numbers::pi / 3.0};
  state.obstacles.push_back({.body = sliding.obstacle});
  EXPECT_NEAR(told, intrusion(manoeuvre::footprint(car_), state) + std::log1p(std::exp(0.5)) + 0.25,
              1e-4);
}

TEST_F(Learned, TakesTheBoxAroundWhatIsNoBox) {
  danger::Meeting disc = ahead(6.0, 15.0);
  disc.obstacle = {.shape = world::Shape::ellipse, .length = 4.5, .width = 1.8};
  EXPECT_EQ(value()(disc, {}), value()(ahead(6.0, 15.0), {}));
}

TEST_F(Learned, DoesNotKnowWhatItHasNotLearnt) {
  const auto knows = [&](const danger::Meeting& meeting, const danger::Motion& motion = {}) {
    return value()(meeting, motion).has_value();
  };
  const danger::Meeting usual = ahead(6.0, 15.0);
  ASSERT_TRUE(knows(usual));
  danger::Meeting slow = ahead(6.0, 5.0);
  slow.grip = 0.3;
  EXPECT_TRUE(knows(slow));
  slow.state[0] -= 24.0;
  EXPECT_FALSE(knows(slow)) << "told by more than 14 m";
  EXPECT_FALSE(knows(ahead(6.0, 40.5)));
  danger::Meeting other = usual;
  other.grip = 0.15;
  EXPECT_FALSE(knows(other)) << "ice";
  other = usual;
  other.grip = 1.2;
  EXPECT_EQ(value()(other, {}), [&] {
    other.grip = 1.0;
    return value()(other, {});
  }()) << "more grip is no worse";
  other = usual;
  other.obstacle.length = 0.2;
  EXPECT_FALSE(knows(other));
  other = usual;
  other.obstacle_speed = 41.0;
  EXPECT_FALSE(knows(other));
  EXPECT_TRUE(knows(usual, {.obstacle_acceleration = -8.0}));
  EXPECT_FALSE(knows(usual, {.obstacle_acceleration = -10.0}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const danger::Motion& motion :
       {danger::Motion{.yaw_rate = nan}, danger::Motion{.sideslip = nan},
        danger::Motion{.a_B = {nan, 0.0}}, danger::Motion{.obstacle_acceleration = nan},
        danger::Motion{.obstacle_curvature = nan}}) {
    EXPECT_FALSE(knows(usual, motion));
  }
  other.obstacle_speed = 20.0;
  EXPECT_FALSE(knows(other, {.obstacle_curvature = 0.1})) << "40 m/s2 across";
}

TEST_F(Learned, NamesTheCarByItsNumbers) {
  manoeuvre::Car tuned = car_;
  manoeuvre::Car heavier = car_;
  heavier.mass += 1.0;
  EXPECT_EQ(vehicle_word(tuned), vehicle_word(car_));
  EXPECT_NE(vehicle_word(heavier), vehicle_word(car_));
}

}  // namespace
}  // namespace saca::learned_danger::learned_test
