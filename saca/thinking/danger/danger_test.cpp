#include "saca/thinking/danger/danger.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "saca/base/core/contract.h"
#include "saca/thinking/danger/coarse_table_for_test.h"

namespace saca::danger::danger_test {
namespace {

using world::Footprint;
using world::Shape;

constexpr Avoidance car{.grip = 0.9, .tightest_curvature = 0.235, .drive_share = 0.48};
constexpr Footprint disc{.shape = Shape::ellipse, .length = 2.0, .width = 2.0};
constexpr Footprint ego{.shape = Shape::ellipse, .length = 2.0, .width = 2.0};

/// Two discs of radius 1: h = 2 - distance.
DangerTable solved(double obstacle_speed) {
  Avoidance system = car;
  system.obstacle_speed = obstacle_speed;
  return coarse_table(system, ego, disc);
}

const DangerTable& at_rest() {
  static const DangerTable table = solved(0.0);
  return table;
}
const DangerModel& with_tables() {
  static const DangerModel model(car, ego, {solved(3.0), at_rest()});
  return model;
}
const DangerModel& without() {
  static const DangerModel model(car, ego, {});
  return model;
}

Meeting ahead(double distance, double speed) {
  return {.ego = ego,
          .obstacle = disc,
          .grip = 0.9,
          .obstacle_speed = 0.0,
          .state = {-distance, 0.0, 0.0, speed}};
}

/// By how much more than V may be told [m]: the solved value is off by about its error, which is
/// added to it; about: within a quarter of the grid's finest metre.
double told_too_much(const Meeting& meeting) {
  const DangerTable& table = at_rest();
  return 2.0 * table.values->at(grid_state(table.view, meeting.state)).error + 0.25;
}

// Braking alone comes to rest v^2 / 2 mu g before: no evasion can be worse than that.
TEST(Danger, IsNoMoreThanBrakingLeaves) {
  for (const DangerModel* model : {&with_tables(), &without()}) {
    for (const double v : {5.0, 10.0, 15.0}) {
      for (const double distance : {10.0, 16.0, 20.0}) {
        const double by_braking = 2.0 - (distance - v * v / (2.0 * 0.9 * 9.80665));
        const double slack = model == &without() ? 1e-3 : told_too_much(ahead(distance, v));
        EXPECT_LE(model->danger(ahead(distance, v)).value,
                  std::max(by_braking, 2.0 - distance) + slack)
            << v << ' ' << distance;
      }
    }
  }
}

// The few evasions are evasions: the exact value is below theirs.
TEST(Danger, OfATableIsNoMoreThanOfAFewEvasions) {
  for (const double v : {6.0, 12.0, 18.0}) {
    for (const double distance : {8.0, 14.0, 20.0}) {
      for (const double aside : {0.0, 1.0, -2.5}) {
        Meeting meeting = ahead(distance, v);
        meeting.state[1] = aside;
        const Danger exact = with_tables().danger(meeting);
        EXPECT_TRUE(exact.exact);
        const Danger few = without().danger(meeting);
        EXPECT_FALSE(few.exact);
        EXPECT_LT(exact.value, few.value + told_too_much(meeting))
            << v << ' ' << distance << ' ' << aside;
      }
    }
  }
}

TEST(Danger, IsTheSameToTheLeftAndToTheRight) {
  for (const double v : {6.0, 12.0}) {
    Meeting left = ahead(12.0, v);
    left.state = {-12.0, 1.3, 0.1, v};
    Meeting right = left;
    right.state = {-12.0, -1.3, -0.1, v};
    EXPECT_NEAR(with_tables().danger(left).value, with_tables().danger(right).value, 1e-6);
    EXPECT_NEAR(without().danger(left).value, without().danger(right).value, 1e-6);
  }
}

// On a quarter of the grip everything runs the same way at half the speed.
TEST(Danger, OnLessGripIsThatOfAHigherSpeed) {
  Meeting icy = ahead(14.0, 6.0);
  icy.grip = 0.225;
  EXPECT_NEAR(with_tables().danger(icy).value, with_tables().danger(ahead(14.0, 12.0)).value, 1e-9);
  EXPECT_NEAR(without().danger(icy).value, without().danger(ahead(14.0, 12.0)).value, 0.05);
}

// A motor-limited car does not gain what more grip would give.
TEST(Danger, MoreGripThanTheTablesIsTakenAsTheirs) {
  Meeting grippy = ahead(14.0, 12.0);
  grippy.grip = 1.2;
  EXPECT_EQ(with_tables().danger(grippy).value, with_tables().danger(ahead(14.0, 12.0)).value);
  EXPECT_EQ(without().danger(grippy).value, without().danger(ahead(14.0, 12.0)).value);
}

TEST(Danger, ATableServesItsSpeedButForRounding) {
  Meeting meeting = ahead(14.0, 12.0);
  meeting.obstacle_speed = 3.0;
  const double there = with_tables().exact(meeting).value();
  meeting.obstacle_speed = 3.0 + 1e-9;
  EXPECT_NEAR(with_tables().exact(meeting).value_or(0.0), there, 1e-6);
}

TEST(Danger, BetweenTwoObstacleSpeedsLiesBetweenThem) {
  Meeting meeting = ahead(14.0, 12.0);
  const double at_rest = with_tables().danger(meeting).value;
  meeting.obstacle_speed = 3.0;
  const double driving = with_tables().danger(meeting).value;
  meeting.obstacle_speed = 1.5;
  EXPECT_LT(driving, at_rest);
  EXPECT_GT(with_tables().danger(meeting).value, driving);
  EXPECT_LT(with_tables().danger(meeting).value, at_rest);
  meeting.obstacle_speed = 4.0;  // faster than any table
  EXPECT_FALSE(with_tables().danger(meeting).exact);
}

TEST(Danger, GrowsByWhatABodyReachesBeyondTheTables) {
  Meeting meeting = ahead(14.0, 12.0);
  const double usual = with_tables().danger(meeting).value;
  meeting.obstacle.length = meeting.obstacle.width = 2.6;
  EXPECT_NEAR(with_tables().danger(meeting).value, usual + std::hypot(0.3, 0.3), 1e-9);
  meeting.obstacle = disc;
  meeting.ego.length = meeting.ego.width = 2.4;
  EXPECT_NEAR(with_tables().danger(meeting).value, usual + std::hypot(0.2, 0.2), 1e-9);
}

// A disc of 1 m about a point 0.5 m ahead reaches 0.5 m beyond the same disc about the origin, also
// where neither its front nor its side does so alone.
TEST(Danger, GrowsByWhatABodyWithAnotherMiddleReachesBeyond) {
  Meeting meeting = ahead(14.0, 12.0);
  const double usual = with_tables().danger(meeting).value;
  meeting.ego.centre_x = 0.5;
  EXPECT_GE(with_tables().danger(meeting).value, usual + 0.5);
  const Footprint ellipse{.shape = Shape::ellipse, .length = 4.0, .width = 2.0};
  const DangerModel wide(car, ellipse, {{disc, 0.0, View::obstacle, at_rest().values}});
  meeting.ego.centre_x = 1.0;  // at 45 deg from its middle it is 0.13 m outside of the ellipse
  EXPECT_GE(wide.danger(meeting).value, usual + 0.13);
}

TEST(Danger, BeyondTheGridIsToldCarefullyAndFlagged) {
  const Danger far = with_tables().danger(ahead(60.0, 18.0));  // 42 m to go, 18.4 m to stop
  EXPECT_FALSE(far.exact);
  EXPECT_LT(far.value, -10.0);
  EXPECT_GE(far.value, 2.0 - 60.0);
  const Danger fast = with_tables().danger(ahead(30.0, 30.0));  // stops in 51 m
  EXPECT_FALSE(fast.exact);
  EXPECT_GT(fast.value, -3.0);
}

// 0.05 s before two discs lie on each other nothing moves one aside by more than 0.5 x 9 x 0.05^2 =
// 0.01 m; 0.05 s later they are apart again. No table has these speeds.
TEST(Danger, BeyondTheGridItIsLookedAtAllTheWay) {
  for (const double speed : {30.0, 45.0, 50.0}) {
    const Danger through = with_tables().danger(ahead(0.05 * speed, speed));
    EXPECT_FALSE(through.exact);
    EXPECT_NEAR(through.value, 2.0, 0.1) << speed;
  }
}

// Without tables and on ice: what only a swerve misses is not told by going straight or braking.
TEST(Danger, BeyondTheGridASwerveCounts) {
  const Danger swerved = with_tables().danger(ahead(38.0, 25.0));  // 1.5 s: 10 m aside; stop: 35 m
  EXPECT_FALSE(swerved.exact);
  EXPECT_LE(swerved.value, without().danger(ahead(38.0, 25.0)).value);
  EXPECT_LT(swerved.value, -4.0);
}

TEST(Danger, ExactIsTheTablesOrNothing) {
  EXPECT_EQ(with_tables().exact(ahead(14.0, 12.0)), with_tables().danger(ahead(14.0, 12.0)).value);
  EXPECT_EQ(with_tables().exact(ahead(60.0, 18.0)), std::nullopt);  // beyond the grid
  EXPECT_EQ(with_tables().exact(ahead(30.0, 30.0)), std::nullopt);
  Meeting meeting = ahead(14.0, 12.0);
  meeting.obstacle_speed = 4.0;  // faster than any table
  EXPECT_EQ(with_tables().exact(meeting), std::nullopt);
  EXPECT_EQ(without().exact(ahead(14.0, 12.0)), std::nullopt);
}

// What was learnt answers where no table does, and evasions where it does not know either.
TEST(Danger, LearntValuesFillWhereTablesEnd) {
  const Meeting beyond = ahead(60.0, 18.0);
  const auto told = [](const Meeting& meeting, const Motion& motion) {
    return meeting.state[3] > 17.0 ? std::optional(-3.0 - motion.yaw_rate) : std::nullopt;
  };
  const DangerModel model(car, ego, {}, told);
  EXPECT_EQ(model.danger(beyond, {.yaw_rate = 0.5}).value, -3.5);
  EXPECT_FALSE(model.danger(beyond).exact);
  EXPECT_EQ(model.known(beyond), -3.0);
  EXPECT_EQ(model.exact(beyond), std::nullopt);
  EXPECT_EQ(model.known(ahead(14.0, 12.0)), std::nullopt);
  EXPECT_EQ(model.danger(ahead(14.0, 12.0)).value, without().danger(ahead(14.0, 12.0)).value);
  EXPECT_EQ(with_tables().known(ahead(14.0, 12.0)), with_tables().exact(ahead(14.0, 12.0)));
  EXPECT_EQ(with_tables().known(beyond), std::nullopt);
}

TEST(Danger, RefusesWhatIsNoMeeting) {
  Meeting meeting = ahead(14.0, 12.0);
  meeting.state[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)with_tables().danger(meeting), ContractViolation);
  meeting = ahead(14.0, -1.0);
  EXPECT_THROW((void)with_tables().danger(meeting), ContractViolation);
  meeting = ahead(14.0, 1.0);
  meeting.grip = 0.0;
  EXPECT_THROW((void)with_tables().danger(meeting), ContractViolation);
  EXPECT_THROW((void)with_tables().exact(meeting), ContractViolation);
  EXPECT_THROW(DangerModel(car, ego, {{disc, 0.0, View::obstacle, nullptr}}), ContractViolation);
}

}  // namespace
}  // namespace saca::danger::danger_test
