#include "saca/lab/encounter/recorded_driver.h"

#include <gmock/gmock.h>

#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"

namespace saca::encounter::recorded_driver_test {
namespace {

/// Drives at 15 m/s, from 2 s on with this acceleration and this speed to the left; 6 s.
scenario::Scenario drive(double acceleration, double aside) {
  scenario::Scenario scenario{.name = "drive", .car = "compact_rwd_ev", .duration = 8.0};
  scenario.road.left_edge = 10.0;
  scenario.road.right_edge = -10.0;
  scenario::Recording ego;
  for (int k = 0; k <= 60; ++k) {
    const double time = 0.1 * k;
    const double then = std::max(0.0, time - 2.0);
    const double speed = 15.0 + acceleration * then;
    ego.push_back({.time = time,
                   .X_WA = {{15.0 * time + 0.5 * acceleration * then * then, aside * then}, 0.0},
                   .speed = speed});
  }
  scenario.ego = ego;
  return scenario;
}

class RecordedDriverTest : public testing::Test {
 protected:
  std::optional<RecordedDriver> of(const scenario::Scenario& scenario, double from) {
    return recorded_driver(scenario, car_, harm_, from);
  }
  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = prepare::read_harm("data/harm.toml").value();
};

TEST_F(RecordedDriverTest, BrakingIsTheHardestOverHalfASecond) {
  EXPECT_NEAR(of(drive(-3.0, 0.0), 1.0)->braking, 3.0, 0.05);
  EXPECT_TRUE(brakes(*of(drive(-3.0, 0.0), 1.0)));
  EXPECT_FALSE(brakes(*of(drive(-1.9, 0.0), 1.0)));
  EXPECT_NEAR(of(drive(1.0, 0.0), 1.0)->braking, 0.0, 0.01);
}

TEST_F(RecordedDriverTest, SteeringIsHowFarAsideTheDriverCame) {
  EXPECT_NEAR(of(drive(0.0, 0.3), 1.0)->aside, 1.2, 0.02);
  EXPECT_EQ(steers(*of(drive(0.0, 0.3), 1.0)), 1);
  EXPECT_EQ(steers(*of(drive(0.0, -0.3), 1.0)), -1);
  EXPECT_EQ(steers(*of(drive(0.0, 0.1), 1.0)), 0);  // 0.4 m
}

TEST_F(RecordedDriverTest, CountsAsThePolicyThatComesNearest) {
  using manoeuvre::PolicyId;
  EXPECT_EQ(policy_of(*of(drive(0.0, 0.0), 1.0)), PolicyId::no_intervention);
  EXPECT_EQ(policy_of(*of(drive(-3.0, 0.0), 1.0)), PolicyId::aeb);
  EXPECT_EQ(policy_of(*of(drive(0.0, 0.3), 1.0)), PolicyId::aes_left);
  EXPECT_EQ(policy_of(*of(drive(0.0, -0.3), 1.0)), PolicyId::aes_right);
  EXPECT_EQ(policy_of(*of(drive(-3.0, 0.3), 1.0)), PolicyId::es_b_left);
  EXPECT_EQ(policy_of(*of(drive(-3.0, -0.3), 1.0)), PolicyId::es_b_right);
}

TEST_F(RecordedDriverTest, MeetsWhoStandsInTheWay) {
  scenario::Scenario scenario = drive(0.0, 0.0);
  scenario.actors.push_back(
      {.id = 1,
       .footprint = {.length = 4.5, .width = 1.8},
       .mass = 1'500.0,
       .motion = scenario::Script{.start = {.s = 60.0}, .behaviour = scenario::Behaviour::hold}});
  const auto driver = of(scenario, 1.0);
  ASSERT_TRUE(driver->outcome.contact.has_value());
  EXPECT_NEAR(driver->outcome.contact->relative_speed, 15.0, 0.1);
  EXPECT_EQ(driver->met.size(), 1U);
}

TEST_F(RecordedDriverTest, WhoWasNotRecordedDidNothing) {
  scenario::Scenario scenario = drive(0.0, 0.0);
  EXPECT_EQ(of(scenario, 5.95), std::nullopt);
  scenario.ego = scenario::EgoStart{.pose = {}, .speed = 10.0};
  EXPECT_EQ(of(scenario, 1.0), std::nullopt);
}

}  // namespace
}  // namespace saca::encounter::recorded_driver_test
