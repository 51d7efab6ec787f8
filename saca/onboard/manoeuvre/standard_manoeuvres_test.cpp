// Standard manoeuvres, closed loop: the severe lane change of ISO 3888-2 and braking on split grip.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "saca/base/core/units.h"
#include "saca/base/world/footprint.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/controller.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "tests/support/scenes.h"

namespace saca::manoeuvre::standard_manoeuvres_test {
namespace {

using vehicle::Vehicle;
using vehicle::VehicleState;

constexpr double dt = 1e-3;

// ---- severe lane change ---------------------------------------------------------------------

// A stretch of ISO 3888-2:2011 between two rows of cones, which the car must not touch.
struct Lane {
  double from;   // [m]
  double to;     // [m]
  double right;  // [m]
  double left;   // [m]
};

// Sections 1, 3 and 5: 12, 11 and 12 m long, 13.5 and 12.5 m apart, 61 m in all; 1.1 b + 0.25, b +
// 1 and max(3, 1.3 b + 0.25) m wide for a car b wide, the second 1 m to the left of the first, edge
// to edge. The third is taken as centred on the first.
std::array<Lane, 3> obstacle_avoidance_track(double width) {
  const double entry = 0.5 * (1.1 * width + 0.25);
  const double exit = 0.5 * std::max(3.0, 1.3 * width + 0.25);
  return {{{0.0, 12.0, -entry, entry},
           {25.5, 36.5, entry + 1.0, entry + 2.0 + width},
           {49.0, 61.0, -exit, exit}}};
}

// How a driver goes through: a path of two smooth shifts, its curvature seen ahead, and what the
// car lacks in place and course.
struct Driver {
  double out_from, out_to;    // x of the first shift [m]
  double back_from, back_to;  // of the second [m]
  double out_d, back_d;       // where the first and the second end [m]
  double preview;             // [s]
  double place_gain;          // [rad/m]
  double course_gain;         // [-]
};

struct PathPoint {
  double y, slope, curvature;
};

PathPoint operator+(const PathPoint& p, const PathPoint& q) {
  return {p.y + q.y, p.slope + q.slope, p.curvature + q.curvature};
}

// 10 u^3 - 15 u^4 + 6 u^5 of the height, with its derivatives over x.
PathPoint shift_at(double x, double from, double to, double height) {
  const double length = to - from;
  const double u = std::clamp((x - from) / length, 0.0, 1.0);
  const double v = 1.0 - u;
  return {height * u * u * u * (10.0 + u * (6.0 * u - 15.0)),
          height / length * 30.0 * u * u * v * v,
          height / (length * length) * 60.0 * u * v * (1.0 - 2.0 * u)};
}

PathPoint path_at(const Driver& driver, double x) {
  return shift_at(x, driver.out_from, driver.out_to, driver.out_d) +
         shift_at(x, driver.back_from, driver.back_to, driver.back_d - driver.out_d);
}

struct Passage {
  bool clean = true;     // no cone touched, no lane left out
  double hardest = 0.0;  // largest lateral acceleration [m/s^2]
};

// Enters the first section with `speed` and rolls: neither throttle nor brakes, as in the
// standard's annex, only without an engine's drag.
Passage drive_through(const Vehicle& car, const Driver& driver, double speed, double grip) {
  const auto lanes = obstacle_avoidance_track(car.body_width);
  const world::Footprint body = footprint(car);
  VehicleState state = prepare::rolling(car, speed);
  state.X_WB.p.x = -car.front_end;
  Passage passage;
  const double rear_end = car.body_length - car.front_end;
  for (int i = 0; i < 8000 && state.X_WB.p.x < lanes[2].to + rear_end && passage.clean; ++i) {
    const double x = state.X_WB.p.x;
    const PathPoint here = path_at(driver, x);
    const double curvature = path_at(driver, x + state.v_B.x * driver.preview).curvature;
    const Vec2 v_W = rotated(state.v_B, state.X_WB.yaw);
    vehicle::Command command;
    command.steering = (car.cg_to_front_axle + car.cg_to_rear_axle) * curvature +
                       driver.place_gain * (here.y - state.X_WB.p.y) +
                       driver.course_gain * (std::atan(here.slope) - std::atan2(v_W.y, v_W.x));
    state = vehicle::step(car, state, command, grip, dt);
    passage.hardest = std::max(passage.hardest, std::abs(state.a_B.y));
    if (i % 10 != 0) {
      continue;
    }
    for (const Lane& lane : lanes) {
      for (const double edge : {lane.right, lane.left}) {
        const world::Footprint cones{.length = lane.to - lane.from, .width = 1e-3};
        const Pose X_WC{{0.5 * (lane.from + lane.to), edge}, 0.0};
        passage.clean =
            passage.clean && world::separation(body, state.X_WB, cones, X_WC).distance > 0.0;
      }
      const bool beside = x > lane.from && x < lane.to;
      const double y = state.X_WB.p.y;
      passage.clean = passage.clean && (!beside || (y > lane.right && y < lane.left));
    }
  }
  passage.clean = passage.clean && state.X_WB.p.x >= lanes[2].to;
  return passage;
}

// Found by random search for the default car at grip 0.9; no other source.
constexpr Driver driver{.out_from = 10.2,
                        .out_to = 27.6,
                        .back_from = 31.5,
                        .back_to = 56.8,
                        .out_d = 3.47,
                        .back_d = -0.32,
                        .preview = 0.22,
                        .place_gain = 0.08,
                        .course_gain = 1.27};

// All entry speeds from 45 km/h (at grip 0.9) to this one are passed, in steps of 1 % [m/s].
double highest_entry_speed(const Vehicle& car, double grip) {
  const double fastest = 25.0 * std::sqrt(grip / 0.9);
  double highest = 0.0;
  for (int percent = 50; percent <= 100; ++percent) {
    const double speed = 0.01 * percent * fastest;
    if (!drive_through(car, driver, speed, grip).clean) {
      break;
    }
    highest = speed;
  }
  return highest;
}

// km77.com drives cars through this track: a Honda HR-V at 74 km/h, a Toyota GR Supra at 77 km/h
// (reported by automotivetip.com and automototale.com); 70 km/h is what the Swedish test of this
// kind asks (bilmagasinet.dk). This driver, whose path is the same at all speeds, is not as good.
TEST(SevereLaneChange, IsDrivenUntilTheGripEnds) {
  const Vehicle car = prepare::default_vehicle();
  const double highest = highest_entry_speed(car, 0.9);
  EXPECT_GT(to_kmh(highest), 58.0);
  EXPECT_LT(to_kmh(highest), 77.0);
  // Load sensitivity takes some percent of 0.9 g = 8.83 m/s^2.
  EXPECT_GT(drive_through(car, driver, highest, 0.9).hardest, 0.92 * 0.9 * vehicle::gravity);
  // On the same path forces go with speed squared: grip limits speed by its square root.
  for (const double grip : {0.7, 0.8, 1.0}) {
    EXPECT_NEAR(highest_entry_speed(car, grip), highest * std::sqrt(grip / 0.9), 0.05 * highest)
        << grip;
  }
}

// ---- split grip -----------------------------------------------------------------------------

struct Stop {
  double distance = 0.0;
  double most_heading = 0.0;
  double most_d = 0.0;
  double end_d = 0.0;
};

// Full braking by policy 0, which knows one grip only.
Stop emergency_stop(const Car& car, double speed, const vehicle::PerWheel& grip, double estimate) {
  const world::Scene scene = test::ego_alone(speed, estimate);
  const Plan plan{PolicyId::aeb, {}};
  ControllerState memory = begin(car, plan, scene);
  VehicleState state = rolling_state(car, scene.ego, estimate);
  Stop stop;
  for (int i = 0; i < 15'000 && !finished(state, memory); ++i) {
    const vehicle::Command command = control(car, scene.road, estimate, state, memory, dt);
    state = vehicle::step(car, state, command, grip, dt);
    stop.most_heading = std::max(stop.most_heading, std::abs(state.X_WB.yaw));
    stop.most_d = std::max(stop.most_d, std::abs(state.X_WB.p.y));
  }
  stop.distance = state.X_WB.p.x;
  stop.end_d = state.X_WB.p.y;
  return stop;
}

// The better side's wheels pull the car round; front and rear axle hold against that moment with
// sideways forces, so the car goes straight on, but askew and steered. The mean grip is what both
// sides could give at most: mean grip x g and a little air drag.
TEST(SplitGrip, EmergencyBrakingKeepsTheLane) {
  const Car car = prepare::default_car();
  constexpr double mean = 0.55 * vehicle::gravity;
  for (const double speed : {10.0, 15.0, 20.0, 25.0}) {
    for (const double estimate : {0.55, 0.9}) {
      const Stop stop = emergency_stop(car, speed, {0.2, 0.9, 0.2, 0.9}, estimate);
      const double delay = car.brake_dead_time + car.brake_lag;
      const double deceleration = speed * speed / (2.0 * (stop.distance - delay * speed));
      EXPECT_LT(stop.most_heading, from_degrees(5.0)) << speed << ' ' << estimate;
      EXPECT_LT(stop.most_d, 0.2) << speed << ' ' << estimate;
      EXPECT_LT(deceleration, 1.02 * mean) << speed << ' ' << estimate;
      EXPECT_GT(deceleration, (estimate > 0.8 ? 0.8 : 0.6) * mean) << speed << ' ' << estimate;
      const Stop other = emergency_stop(car, speed, {0.9, 0.2, 0.9, 0.2}, estimate);
      EXPECT_NEAR(other.end_d, -stop.end_d, 1e-6) << speed;
      EXPECT_NEAR(other.distance, stop.distance, 1e-6) << speed;
    }
  }
}

}  // namespace
}  // namespace saca::manoeuvre::standard_manoeuvres_test
