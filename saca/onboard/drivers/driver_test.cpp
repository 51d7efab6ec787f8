#include "saca/onboard/drivers/driver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "saca/base/core/contract.h"

namespace saca::drivers::driver_test {
namespace {

using world::Footprint;
using world::Road;
using world::Track;

constexpr double step = 0.01;
constexpr double dry = 0.9;
constexpr Footprint car{.length = 4.0, .width = 1.8};

DriverLaw instant(double speed) {
  DriverLaw law = usual_driver(speed);
  law.reaction = 0.0;
  return law;
}

/// s_e(v) = (s0 + v T) / sqrt(1 - (v / v0)^4): where the model's acceleration is 0.
double equilibrium_gap(const DriverLaw& law, double speed) {
  const double share = std::pow(speed / law.desired_speed, 4.0);
  return (law.least_gap + speed * law.time_gap) / std::sqrt(1.0 - share);
}

TEST(Driver, SettlesAtTheEquilibriumGap) {
  for (const double reaction : {0.0, 1.25}) {
    for (const double speed : {5.0, 12.0, 20.0}) {
      DriverLaw law = usual_driver(speed);
      law.reaction = reaction;
      Driver driver(law, speed, dry, step);
      double gap = 1.5 * equilibrium_gap(law, speed);
      for (int k = 0; k < 60'000; ++k) {
        gap += speed * step - driver.advance({gap, speed});
      }
      EXPECT_NEAR(gap, equilibrium_gap(law, speed), 0.01) << speed;
      EXPECT_NEAR(driver.speed(), speed, 1e-4);
    }
  }
}

TEST(Driver, ModelAcceleratesAsItsEquationHasIt) {
  const DriverLaw law = usual_driver(20.0);
  EXPECT_NEAR(idm_acceleration(law, 0.0, {}), law.acceleration, 1e-12);   // from rest
  EXPECT_NEAR(idm_acceleration(law, law.desired_speed, {}), 0.0, 1e-12);  // free road
  const double gap = equilibrium_gap(law, 20.0);
  EXPECT_NEAR(idm_acceleration(law, 20.0, {gap, 20.0}), 0.0, 1e-12);
  // Towards who stands, far too near: the term v dv / (2 sqrt(a b)) of the wanted gap prevails.
  const double wanted = law.least_gap + 20.0 * law.time_gap +
                        400.0 / (2.0 * std::sqrt(law.acceleration * law.comfortable));
  const double free = law.acceleration * (1.0 - std::pow(20.0 / law.desired_speed, 4.0));
  EXPECT_NEAR(idm_acceleration(law, 20.0, {30.0, 0.0}),
              free - law.acceleration * std::pow(wanted / 30.0, 2.0), 1e-12);
}

TEST(Driver, ReachesItsDesiredSpeedOnAFreeRoad) {
  const DriverLaw law = usual_driver(20.0);
  Driver driver(law, 20.0, dry, step);
  for (int k = 0; k < 60'000; ++k) {
    driver.advance({});
  }
  EXPECT_NEAR(driver.speed(), 24.0, 1e-3);  // a fifth faster
}

// On a free road from rest the model says dv/dt = a (1 - (v / v0)^4); while v / v0 < 0.3 that is a
// within 1 %.
TEST(Driver, StartsWithItsAcceleration) {
  Driver driver(instant(0.0), 0.0, dry, step);
  for (int k = 0; k < 500; ++k) {
    driver.advance({});
  }
  EXPECT_NEAR(driver.speed(), 0.73 * 5.0, 0.01 * 0.73 * 5.0);
}

TEST(Driver, StopsBeforeWhatStands) {
  for (const double speed : {8.0, 15.0, 25.0}) {
    const DriverLaw law = instant(speed);
    Driver driver(law, speed, dry, step);
    // From far off: the deceleration that is needed stays near the comfortable one.
    double gap = 6.0 * speed + speed * speed / law.comfortable;
    double hardest = 0.0;
    for (int k = 0; k < 20'000; ++k) {
      const double before = driver.speed();
      gap -= driver.advance({gap, 0.0});
      hardest = std::max(hardest, (before - driver.speed()) / step);
    }
    EXPECT_LT(driver.speed(), 0.01);
    EXPECT_NEAR(gap, law.least_gap, 0.3) << speed;  // it creeps up to s0
    EXPECT_LT(hardest, 1.5 * law.comfortable) << speed;
  }
}

// Emergency: what stands appears where v^2 / (2 * 8 m/s^2) plus a little is left.
TEST(Driver, BrakesAsHardAsItMustAndCan) {
  Driver driver(instant(20.0), 20.0, dry, step);
  double gap = 20.0 * 20.0 / (2.0 * 8.0) + 1.0;
  for (int k = 0; k < 5'000; ++k) {
    const double before = driver.speed();
    gap -= driver.advance({gap, 0.0});
    EXPECT_LE(before - driver.speed(), 8.0 * step + 1e-12);
  }
  EXPECT_GT(gap, 0.0);
  Driver on_ice(instant(20.0), 20.0, 0.1, step);
  on_ice.advance({10.0, 0.0});
  EXPECT_NEAR(on_ice.speed(), 20.0 - 0.1 * 9.80665 * step, 1e-12);
}

// A small jolt dies out along a platoon of two, behind a leader at constant speed.
TEST(Driver, ASmallPerturbationDiesOut) {
  const DriverLaw law = instant(15.0);
  Driver first(law, 15.0, dry, step);
  Driver second(law, 15.0, dry, step);
  const double rest = equilibrium_gap(law, 15.0);
  double gap_1 = rest - 1.0;
  double gap_2 = rest;
  double largest_2 = 0.0;
  for (int k = 0; k < 30'000; ++k) {
    const double speed_1 = first.speed();
    const double way_1 = first.advance({gap_1, 15.0});
    const double way_2 = second.advance({gap_2, speed_1});
    gap_1 += 15.0 * step - way_1;
    gap_2 += way_1 - way_2;
    largest_2 = std::max(largest_2, std::abs(gap_2 - rest));
  }
  EXPECT_LT(largest_2, 1.0);
  EXPECT_NEAR(gap_1, rest, 1e-3);
  EXPECT_NEAR(gap_2, rest, 1e-3);
}

/// A leader at 20 m/s that brakes with 8 m/s^2 from 0.5 s on, and a driver behind it.
/// @return  closing speed when they touch
std::optional<double> rear_end(DriverLaw law, double gap) {
  constexpr double fine = 0.005;
  law = content_with(law, 20.0, gap);
  Driver driver(law, 20.0, dry, fine);
  for (int k = 0; k < 4'000; ++k) {
    const auto leader = [](double time) {
      return std::clamp(20.0 - 8.0 * (time - 0.5), 0.0, 20.0);
    };
    const double now = leader(k * fine);
    const double next = leader((k + 1) * fine);
    gap += 0.5 * (now + next) * fine - driver.advance({gap, now});
    if (gap <= 0.0) {
      return driver.speed() - next;
    }
  }
  return std::nullopt;
}

// 6 m are closed within the reaction time: t = sqrt(2 * 6 / 8) = 1.22 s after the braking began, at
// the closing speed 8 t = sqrt(2 * 8 * 6).
TEST(Driver, HitsAHardBrakerBeforeItReacts) {
  const auto closing = rear_end(usual_driver(20.0), 6.0);
  ASSERT_TRUE(closing.has_value());
  EXPECT_NEAR(*closing, std::sqrt(2.0 * 8.0 * 6.0), 8.0 * 0.005 * 2.0);  // two steps
}

// A driver that then brakes with 7 m/s^2 at once: after 1.25 s they close with 8 * 1.25 = 10 m/s
// and 12 - 8 * 1.25^2 / 2 = 5.75 m are left, closed at 1 m/s^2 more: sqrt(10^2 + 2 * 5.75).
TEST(Driver, HitsAHardBrakerBrakingTooLate) {
  DriverLaw law = usual_driver(20.0);
  law.comfortable = 1e-9;  // any closing is an emergency
  law.hardest = 7.0;
  const auto closing = rear_end(law, 12.0);
  ASSERT_TRUE(closing.has_value());
  EXPECT_NEAR(*closing, std::sqrt(100.0 + 2.0 * 5.75), 8.0 * 0.005 * 2.0);
  law.reaction = 0.2;
  EXPECT_FALSE(rear_end(law, 12.0).has_value());
}

// 1 s behind at 15 m/s, the one ahead brakes with 4 m/s^2 to a stop. After 1.25 s the gap has
// shrunk by 4 * 1.25^2 / 2 = 3.1 m, so that braking with 15^2 / (2 * (15 + 28.1 - 18.75)) = 4.6
// m/s^2 is enough: any driver manages.
TEST(Driver, StopsBehindWhoBrakesModerately) {
  const DriverLaw law = content_with(usual_driver(15.0), 15.0, 15.0);
  Driver driver(law, 15.0, dry, step);
  double gap = 15.0;
  for (int k = 0; k < 2'000; ++k) {
    const auto leader = [](double time) {
      return std::clamp(15.0 - 4.0 * (time - 1.0), 0.0, 15.0);
    };
    const double now = leader(k * step);
    gap += 0.5 * (now + leader((k + 1) * step)) * step - driver.advance({gap, now});
    EXPECT_GT(gap, 0.0) << k;
  }
  EXPECT_LT(driver.speed(), 0.1);
}

TEST(Driver, NeverReverses) {
  Driver driver(usual_driver(3.0), 3.0, dry, step);
  double gap = 1.0;
  for (int k = 0; k < 2'000; ++k) {
    const double way = driver.advance({gap, -2.0});  // what is ahead comes back
    gap -= way + 2.0 * step;
    EXPECT_GE(way, 0.0);
    EXPECT_GE(driver.speed(), 0.0);
  }
  EXPECT_EQ(driver.speed(), 0.0);
}

TEST(ContentWith, MakesTheGapItsEquilibrium) {
  for (const double gap : {0.5, 4.0, 11.0}) {
    const DriverLaw law = content_with(usual_driver(20.0), 20.0, gap);
    Driver driver(law, 20.0, dry, step);
    driver.advance({gap, 20.0});
    // At 0.5 m there is no time gap left to give: it falls back, slowly.
    EXPECT_NEAR(driver.speed(), 20.0, gap < 1.0 ? 0.01 : 1e-9) << gap;
  }
  const DriverLaw usual = usual_driver(20.0);
  EXPECT_EQ(content_with(usual, 20.0, 200.0).time_gap, usual.time_gap);
  EXPECT_EQ(content_with(usual, 0.0, 1.0).least_gap, 1.0);
}

TEST(Driver, RefusesALawThatIsNone) {
  DriverLaw law = usual_driver(10.0);
  EXPECT_THROW(Driver(law, -1.0, dry, step), ContractViolation);
  EXPECT_THROW(Driver(law, 10.0, 0.0, step), ContractViolation);
  EXPECT_THROW(Driver(law, 10.0, dry, 1e-3), ContractViolation);  // memory is 300 steps
  law.time_gap = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Driver(law, 10.0, dry, step), ContractViolation);
  law = usual_driver(10.0);
  law.reaction = 3.5;
  EXPECT_THROW(Driver(law, 10.0, dry, step), ContractViolation);
}

/// A track along x at constant speed, `from` its start.
Track line(Pose from, double speed, double seconds = 20.0) {
  Track track{.start = 0.0, .step = step, .X_WA = {}};
  for (int k = 0; k <= static_cast<int>(seconds / step); ++k) {
    track.X_WA.push_back({from * Vec2{speed * k * step, 0.0}, from.yaw});
  }
  return track;
}

world::Actor driver_at(const Pose& X_WA, double speed) {
  return {.footprint = car, .mass = 1'500.0, .X_WA = X_WA, .v_W = rotated({speed, 0.0}, X_WA.yaw)};
}

Track react(const Road& road, const world::Actor& driver, const std::vector<Body>& others) {
  return reacting_track(road, driver, usual_driver(norm(driver.v_W)), others,
                        {.start = 0.0, .duration = 15.0, .step = step, .grip = dry});
}

TEST(ReactingTrack, StopsBehindAWreck) {
  const Track wreck{.X_WA = {{{120.0, 0.0}, 0.3}}};
  const Track track = react({}, driver_at({{0.0, 0.5}, 0.0}, 15.0), {{&car, &wreck}});
  EXPECT_DOUBLE_EQ(world::end_time(track), 15.0);
  const Pose end = track.X_WA.back();
  const double nose = end.p.x + 2.0;
  const double tail = 120.0 - 2.0 * std::cos(0.3) - 0.9 * std::sin(0.3);
  EXPECT_NEAR(nose, tail - 2.0, 1.5);  // its least gap; the last of it takes long
  EXPECT_LT(nose, tail);
  EXPECT_EQ(end.p.y, 0.5);
}

TEST(ReactingTrack, WhoIsBesideOrBehindDoesNotCount) {
  const world::Actor driver = driver_at({{0.0, 0.0}, 0.0}, 20.0);
  const Track alone = react({}, driver, {});
  const Track beside{.X_WA = {{{60.0, 1.81}, 0.0}}};  // 1 cm beside the lane it sweeps
  const Track behind = line({{-8.0, 0.0}, 0.0}, 25.0, 0.5);
  EXPECT_EQ(react({}, driver, {{&car, &beside}, {&car, &behind}}).X_WA.back().p.x,
            alone.X_WA.back().p.x);
  const Track in_the_way{.X_WA = {{{60.0, 1.79}, 0.0}}};
  EXPECT_LT(react({}, driver, {{&car, &in_the_way}}).X_WA.back().p.x, 60.0);
}

// The vehicle ahead leaves the lane; from then on the one before it counts.
TEST(ReactingTrack, WhoLeavesTheLaneIsNoLongerAhead) {
  const world::Actor driver = driver_at({{0.0, 0.0}, 0.0}, 15.0);
  const Track leader = line({{30.0, 0.0}, 0.0}, 15.0);
  Track leaving = leader;
  for (std::size_t k = 100; k < leaving.X_WA.size(); ++k) {
    leaving.X_WA[k].p.y = std::min(3.5, 0.02 * static_cast<double>(k - 100));  // 2 m/s
  }
  const Track wreck{.X_WA = {{{150.0, 0.0}, 0.0}}};
  const Track left = react({}, driver, {{&car, &leaving}, {&car, &wreck}});
  EXPECT_LT(left.X_WA.back().p.x + 2.0, 148.0);  // it stops for the wreck
  EXPECT_GT(left.X_WA.back().p.x + 2.0, 140.0);
  const Track stayed = react({}, driver, {{&car, &leader}});
  EXPECT_GT(stayed.X_WA.back().p.x, 150.0);
}

// What happens after a time cannot be known before, and is acted on a reaction time later.
TEST(ReactingTrack, IsCausal) {
  const world::Actor driver = driver_at({{0.0, 0.0}, 0.0}, 15.0);
  const Track goes_on = line({{25.0, 0.0}, 0.0}, 15.0);
  Track stops = goes_on;
  for (std::size_t k = 301; k < stops.X_WA.size(); ++k) {
    stops.X_WA[k] = stops.X_WA[300];
  }
  const Track a = react({}, driver, {{&car, &goes_on}});
  const Track b = react({}, driver, {{&car, &stops}});
  for (std::size_t k = 0; k <= 300 + 125; ++k) {
    EXPECT_EQ(a.X_WA[k].p.x, b.X_WA[k].p.x) << k;
  }
  EXPECT_LT(b.X_WA[500].p.x, a.X_WA[500].p.x - 0.1);
}

TEST(ReactingTrack, FollowsACurveAndTheOtherDirection) {
  Road road;
  road.curvature = 1.0 / 80.0;
  const auto along = [&](double s, double d, double heading) {
    return world::from_lane(road, {.s = s, .d = d, .heading = heading});
  };
  const Track wreck{.X_WA = {along(60.0, 3.5, 0.0)}};
  const Track oncoming =
      react(road, driver_at(along(150.0, 3.5, std::numbers::pi), 12.0), {{&car, &wreck}});
  for (const Pose& X_WA : oncoming.X_WA) {
    const world::LanePose at = world::to_lane(road, X_WA);
    EXPECT_NEAR(at.d, 3.5, 1e-9);
    EXPECT_NEAR(std::abs(at.heading), std::numbers::pi, 1e-9);
  }
  // At d = 3.5 m inside the bend, one metre of s is 1 - 3.5 / 80 m of road.
  const double gap =
      (world::to_lane(road, oncoming.X_WA.back()).s - 60.0) * (1.0 - 3.5 / 80.0) - 4.0;
  EXPECT_GT(gap, 0.0);
  EXPECT_NEAR(gap, 2.0, 1.5);
}

TEST(ReactingTrack, IsTheSameInAnyWorldFrameAndMirrored) {
  const Track leader = line({{40.0, 1.0}, 0.0}, 5.0);
  const Track here = react({}, driver_at({{0.0, 0.3}, 0.0}, 18.0), {{&car, &leader}});
  const Pose X_VW{{1'000.0, -300.0}, 2.0};
  Track moved = leader;
  for (Pose& X_WA : moved.X_WA) {
    X_WA = X_VW * X_WA;
  }
  Road road;
  road.X_WL = X_VW;
  const Track there = react(road, driver_at(X_VW * Pose{{0.0, 0.3}, 0.0}, 18.0), {{&car, &moved}});
  const Track mirrored_leader = line({{40.0, -1.0}, 0.0}, 5.0);
  const Track mirrored = react({}, driver_at({{0.0, -0.3}, 0.0}, 18.0), {{&car, &mirrored_leader}});
  for (std::size_t k = 0; k < here.X_WA.size(); k += 50) {
    EXPECT_NEAR(norm((inverse(X_VW) * there.X_WA[k]).p - here.X_WA[k].p), 0.0, 1e-6);
    EXPECT_EQ(mirrored.X_WA[k].p.x, here.X_WA[k].p.x);
  }
}

// 20 m/s, a wall 15 m ahead and a second to react: it is hit, and stands there from then on.
TEST(Driver, WhoRunsIntoSomethingDoesNotDriveThroughIt) {
  DriverLaw law = usual_driver(20.0);
  law.reaction = 1.0;
  Driver driver(law, 20.0, 0.9, 0.01);
  double place = 0.0;
  for (int k = 0; k < 500; ++k) {
    place += driver.advance({15.0 - place, 0.0});
  }
  EXPECT_EQ(driver.speed(), 0.0);
  EXPECT_GE(place, 15.0);
  EXPECT_LE(place, 15.0 + 20.0 * 0.01);  // one step deep at most
}

}  // namespace
}  // namespace saca::drivers::driver_test
