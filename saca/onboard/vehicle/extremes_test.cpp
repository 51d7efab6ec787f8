// The vehicle model where nobody drives: random inputs into every corner, sliding sideways and
// backwards, a crawl, ice, and events between the integrator's steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/vehicle/vehicle.h"

namespace saca::vehicle::extremes_test {
namespace {

constexpr double dt = 1e-3;

// The default car with another drive.
Vehicle driven(double front_share) {
  Vehicle car = prepare::default_vehicle();
  car.motor_front_share = front_share;
  return car;
}

// Commands and grip, held for a while and then all different; some at a corner, some beyond it.
struct Violence {
  Command command;
  PerWheel grip{};
};

class Chance {
 public:
  explicit Chance(unsigned seed) : rng_(seed) {}

  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(rng_);
  }

  Violence violence(const Vehicle& car, bool with_motor) {
    Violence drawn;
    drawn.command.steering = corner(-1.3, 1.3) * car.steering_limit;
    for (std::size_t i = 0; i < num_wheels; ++i) {
      drawn.command.brake_torque[i] = corner(0.0, 1.3) * car.brake_limit;
      drawn.grip[i] = 0.05 + 1.15 * corner(0.0, 1.0);
    }
    drawn.command.motor_torque = with_motor ? corner(-1.3, 1.3) * car.motor_limit : 0.0;
    return drawn;
  }

  VehicleState tumbling() {
    VehicleState state;
    state.X_WB = {{(*this)(-50.0, 50.0), (*this)(-50.0, 50.0)}, (*this)(-3.0, 3.0)};
    state.v_B = {(*this)(-25.0, 25.0), (*this)(-12.0, 12.0)};
    state.yaw_rate = (*this)(-5.0, 5.0);
    for (double& speed : state.wheel_speed) {
      speed = (*this)(-90.0, 90.0);
    }
    return state;
  }

 private:
  // One third at the low end, one third at the high one.
  double corner(double low, double high) {
    const double drawn = (*this)(0.0, 3.0);
    return drawn < 1.0 ? low : drawn < 2.0 ? high : low + (drawn - 2.0) * (high - low);
  }

  std::mt19937 rng_;
};

TEST(Extremes, NoWheelLeavesItsCircleAndNoEnergyComesFromNowhere) {
  Chance chance(11);
  for (int run = 0; run < 60; ++run) {
    const Vehicle car = driven(0.5 * (run % 3));
    const bool with_motor = run % 2 == 1;
    VehicleState state = chance.tumbling();
    Violence now;
    double surplus = 0.0;
    for (int i = 0; i < 1500; ++i) {
      if (i % 75 == 0) {
        now = chance.violence(car, with_motor);
      }
      const VehicleState before = state;
      state = step(car, before, now.command, now.grip, dt);
      double work = 0.0;  // of the motor
      for (std::size_t k = 0; k < num_wheels; ++k) {
        const double share = 0.5 * (k < 2 ? car.motor_front_share : 1.0 - car.motor_front_share);
        work += 0.5 * dt * share *
                (before.motor_torque * before.wheel_speed[k] +
                 state.motor_torque * state.wheel_speed[k]);
      }
      const double gain = kinetic_energy(car, state) - kinetic_energy(car, before) - work;
      ASSERT_LE(gain, 1e-9 * kinetic_energy(car, before) + 1e-9) << run << ' ' << i;
      for (const WheelContact& wheel : contacts(car, state, now.grip)) {
        ASSERT_LE(norm(wheel.F_T), wheel.peak_force * (1.0 + 1e-12)) << run << ' ' << i;
        ASSERT_GE(wheel.load, 0.0);
      }
      surplus += gain;
    }
    EXPECT_LT(surplus, 0.0) << run;
  }
}

PerWheel mirrored(const PerWheel& wheels) {
  return {wheels[front_right], wheels[front_left], wheels[rear_right], wheels[rear_left]};
}

TEST(Extremes, LeftIsTheMirrorOfRightOnSplitGripToo) {
  Chance chance(12);
  for (int run = 0; run < 10; ++run) {
    const Vehicle car = driven(0.5 * (run % 3));
    VehicleState left = chance.tumbling();
    left.X_WB = {};
    VehicleState right = left;
    right.v_B.y = -left.v_B.y;
    right.yaw_rate = -left.yaw_rate;
    right.wheel_speed = mirrored(left.wheel_speed);
    Violence now;
    for (int i = 0; i < 1500; ++i) {
      if (i % 75 == 0) {
        now = chance.violence(car, true);
      }
      const Command other{-now.command.steering, mirrored(now.command.brake_torque),
                          now.command.motor_torque};
      left = step(car, left, now.command, now.grip, dt);
      right = step(car, right, other, mirrored(now.grip), dt);
    }
    EXPECT_NEAR(left.X_WB.p.x, right.X_WB.p.x, 1e-9) << run;
    EXPECT_NEAR(left.X_WB.p.y, -right.X_WB.p.y, 1e-9) << run;
    EXPECT_NEAR(wrap_angle(left.X_WB.yaw + right.X_WB.yaw), 0.0, 1e-9) << run;
    EXPECT_NEAR(left.wheel_speed[rear_left], right.wheel_speed[rear_right], 1e-8) << run;
  }
}

// Far away and turned by any angle: nothing that happens in the body's frame knows of it.
TEST(Extremes, TheWorldsFrameIsOfNoMatter) {
  Chance chance(13);
  for (int run = 0; run < 10; ++run) {
    const Vehicle car = driven(0.5 * (run % 3));
    const Pose X_VW{{chance(-2e3, 2e3), chance(-2e3, 2e3)}, chance(-3.1, 3.1)};
    VehicleState here = chance.tumbling();
    VehicleState there = here;
    there.X_WB = X_VW * here.X_WB;
    Violence now;
    for (int i = 0; i < 1500; ++i) {
      if (i % 75 == 0) {
        now = chance.violence(car, true);
      }
      here = step(car, here, now.command, now.grip, dt);
      there = step(car, there, now.command, now.grip, dt);
    }
    const Pose expected = X_VW * here.X_WB;
    EXPECT_EQ(here.v_B.x, there.v_B.x) << run;
    EXPECT_EQ(here.yaw_rate, there.yaw_rate) << run;
    EXPECT_EQ(here.wheel_speed, there.wheel_speed) << run;
    EXPECT_NEAR(expected.p.x, there.X_WB.p.x, 1e-8) << run;
    EXPECT_NEAR(expected.p.y, there.X_WB.p.y, 1e-8) << run;
    EXPECT_NEAR(wrap_angle(expected.yaw - there.X_WB.yaw), 0.0, 1e-9) << run;
  }
}

TEST(Extremes, RestStaysRestOnAnyRoadWithTurnedWheels) {
  Chance chance(14);
  for (int run = 0; run < 10; ++run) {
    const Vehicle car = driven(0.5 * (run % 3));
    VehicleState state;
    Violence now = chance.violence(car, false);
    for (int i = 0; i < 300; ++i) {
      state = step(car, state, now.command, now.grip, dt);
    }
    EXPECT_TRUE(at_rest(state)) << run;
    EXPECT_EQ(norm(state.X_WB.p), 0.0) << run;
  }
}

// How often a series of numbers turns round by more than rounding.
class Turns {
 public:
  explicit Turns(double least) : least_(least) {}
  void add(double value) {
    if (!started_) {
      started_ = true;
      extreme_ = value;
    }
    const double away = (value - extreme_) * direction_;
    if (direction_ == 0 ? std::abs(value - extreme_) > least_ : away < -least_) {
      count_ += direction_ == 0 ? 0 : 1;
      direction_ = value > extreme_ ? 1 : -1;
      extreme_ = value;
    } else if (away > 0.0) {
      extreme_ = value;
    }
  }
  [[nodiscard]] int count() const { return count_; }

 private:
  double least_;
  bool started_ = false;
  double extreme_ = 0.0;
  int direction_ = 0;
  int count_ = 0;
};

// A tall car in front of which nothing holds the roll: once its inner rear wheel has lifted, the
// front axle takes the rest, and the road carries the weight, no more, also at the point of
// turning over.
TEST(Extremes, ALiftedWheelDoesNotAddToTheWeight) {
  Vehicle car = prepare::default_vehicle();
  car.cg_height = 0.9;
  car.front_roll_stiffness_share = 0.3;
  const double weight = car.mass * gravity;
  const double rear = weight * car.cg_to_front_axle / (car.cg_to_front_axle + car.cg_to_rear_axle);
  // To the left: all of 1700 kg x 8 m/s^2 x 0.9 m / 1.6 m moves, 0.7 of it at the rear: too much.
  const double moved = car.mass * 8.0 * car.cg_height / car.track_width;
  ASSERT_GT(0.7 * moved, 0.5 * rear);
  const PerWheel loads = wheel_loads(car, {0.0, 8.0});
  EXPECT_NEAR(loads[rear_left], 0.0, 1e-9);
  EXPECT_NEAR(loads[rear_right], rear, 1e-9);
  EXPECT_NEAR(loads[front_right] - loads[front_left], 2.0 * (moved - 0.5 * rear), 1e-9);
  for (const double share : {0.0, 0.3, 1.0}) {
    car.front_roll_stiffness_share = share;
    for (const double a_x : {-30.0, -8.0, 0.0, 8.0, 30.0}) {
      for (const double a_y : {-30.0, -8.0, 0.0, 8.0, 30.0}) {
        const PerWheel all = wheel_loads(car, {a_x, a_y});
        EXPECT_NEAR(all[0] + all[1] + all[2] + all[3], weight, 1e-9) << a_x << ' ' << a_y;
        EXPECT_GE(*std::min_element(all.begin(), all.end()), 0.0) << a_x << ' ' << a_y;
      }
    }
  }
}

// The steering still moves while the car crawls, so a wheel's speed may turn round a few times; the
// car's never does. Its deceleration turns round twice for each wheel that locks, and at the stop.
TEST(Extremes, CrawlsWithoutChatter) {
  const Vehicle car = driven(0.5);
  for (const double speed : {0.05, 0.3, 1.0}) {
    for (const double steering : {0.0, 0.5}) {
      for (const double brakes : {0.0, 10.0, 60.0, 400.0}) {
        for (const PerWheel& grip : {PerWheel{0.05, 0.05, 0.05, 0.05}, PerWheel{0.9, 0.9, 0.9, 0.9},
                                     PerWheel{0.1, 0.9, 0.1, 0.9}}) {
          const Command command{.steering = steering,
                                .brake_torque = {brakes, brakes, brakes, brakes}};
          VehicleState state = prepare::rolling(car, speed);
          Turns speed_turns(1e-5);
          Turns deceleration_turns(0.02);
          std::array<Turns, num_wheels> wheel_turns{Turns(1e-3), Turns(1e-3), Turns(1e-3),
                                                    Turns(1e-3)};
          for (int i = 0; i < 3000; ++i) {
            state = step(car, state, command, grip, dt);
            speed_turns.add(norm(state.v_B));
            deceleration_turns.add(state.a_B.x);
            ASSERT_GE(state.v_B.x, 0.0);
            for (std::size_t k = 0; k < num_wheels; ++k) {
              wheel_turns[k].add(state.wheel_speed[k]);
            }
          }
          const auto label = testing::Message() << speed << " m/s, steering " << steering
                                                << ", brakes " << brakes << ", grip " << grip[0];
          EXPECT_EQ(speed_turns.count(), 0) << label;
          EXPECT_LE(deceleration_turns.count(), 9) << label;
          for (const Turns& turns : wheel_turns) {
            EXPECT_LE(turns.count(), 3) << label;
          }
          EXPECT_EQ(at_rest(state), brakes >= 60.0) << label;
        }
      }
    }
  }
}

// Grip as a share of the load on a locked wheel that slides at a speed.
double sliding_friction(const Vehicle& car, double grip, double speed) {
  const double slip = speed / std::max(speed, slip_speed_floor);
  return grip *
         std::sin(car.tyre.shape * std::atan(car.tyre.stiffness / (car.tyre.shape * grip) * slip));
}

// The friction of one wheel against the mass of the car and the spin of the other three: m dv / F
// over the speeds down to where the brakes hold the car, and the delays until the wheel is locked.
TEST(Extremes, StopsOnOneLockedWheel) {
  const Vehicle car = prepare::default_vehicle();
  const double speed = 3.0;
  VehicleState state = prepare::rolling(car, speed);
  const Command command{.brake_torque = {3000.0, 0.0, 0.0, 0.0}};
  double slowest = speed;
  int num_steps = 0;
  for (; num_steps < 3000 && !at_rest(state); ++num_steps) {
    state = step(car, state, command, 0.9, dt);
    ASSERT_LE(state.v_B.x, slowest + 1e-9) << num_steps;
    ASSERT_GE(state.v_B.x, 0.0) << num_steps;
    slowest = std::min(slowest, state.v_B.x);
  }
  EXPECT_TRUE(at_rest(state));
  EXPECT_GT(state.X_WB.yaw, 0.01);  // towards the locked wheel
  const double mass = car.mass + (car.front_wheel_inertia + 2.0 * car.rear_wheel_inertia) /
                                     (car.wheel_radius * car.wheel_radius);
  double expected = 0.0;
  for (int i = 0; i < 300; ++i) {
    const double v = hold_speed + (speed - hold_speed) * (i + 0.5) / 300.0;
    const double load = wheel_loads(car, {-2.0, 0.0})[front_left];
    expected += (speed - hold_speed) / 300.0 * mass / (sliding_friction(car, 0.9, v) * load);
  }
  // Locked once the torque is radius x friction: 0.04 s and the lag's logarithm.
  const double share = 0.9 * car.wheel_radius * wheel_loads(car, {})[front_left] / 3000.0;
  expected += car.brake_dead_time - car.brake_lag * std::log(1.0 - share);
  EXPECT_NEAR(num_steps * dt, expected, 0.05 * expected);
}

TEST(Extremes, StandsAgainstItsMotorUntilTheBrakesAreTheWeaker) {
  for (const double front_share : {0.0, 1.0}) {
    const Vehicle car = driven(front_share);
    VehicleState state;
    Command command{.brake_torque = {400.0, 400.0, 400.0, 400.0}};
    for (int i = 0; i < 400; ++i) {
      state = step(car, state, command, 0.9, dt);
    }
    command.motor_torque = 1500.0;  // less than 4 x 400 - 50
    for (int i = 0; i < 500; ++i) {
      state = step(car, state, command, 0.9, dt);
      ASSERT_TRUE(at_rest(state)) << i;
    }
    command.motor_torque = 3000.0;
    for (int i = 0; i < 1000; ++i) {
      state = step(car, state, command, 0.9, dt);
    }
    EXPECT_GT(state.v_B.x, 0.3);
  }
}

// Locked wheels on ice: v dv / a over the speeds, a by the magic formula with the library's sine;
// slip is 1 down to the floor of slip's speed, v / floor below.
TEST(Extremes, SlidesOnIceAsFarAsFrictionLetsIt) {
  const Vehicle car = prepare::default_vehicle();
  for (const double grip : {0.05, 0.1, 0.2}) {
    const double speed = 6.0;
    double expected = 0.0;
    constexpr int num_parts = 3000;
    for (int i = 0; i < num_parts; ++i) {
      const double v = speed * (i + 0.5) / num_parts;
      const double drag = 0.5 * 1.225 * car.drag_area * v * v / car.mass;
      expected += v / (gravity * sliding_friction(car, grip, v) + drag) * speed / num_parts;
    }
    VehicleState state = prepare::rolling(car, speed);
    state.wheel_speed = {};
    state.brake_torque.fill(1000.0);
    state.brake_line.torque.fill(state.brake_torque);
    for (int i = 0; i < 20'000 && !at_rest(state); ++i) {
      state = step(car, state, {.brake_torque = state.brake_torque}, grip, dt);
    }
    EXPECT_TRUE(at_rest(state));
    EXPECT_NEAR(state.X_WB.p.x, expected, 0.005 * expected) << grip;
  }
}

// ---- the integrator -------------------------------------------------------------------------

VehicleState after(const Vehicle& car, double speed, const Command& command, double seconds,
                   double step_size) {
  VehicleState state = prepare::rolling(car, speed);
  const auto num_steps = std::lround(seconds / step_size);
  for (int i = 0; i < num_steps; ++i) {
    state = step(car, state, command, 0.9, step_size);
  }
  return state;
}

// Error of the place after a drive [m], against steps of 1/64 ms.
class Errors {
 public:
  Errors(const Vehicle& car, double speed, const Command& command, double seconds)
      : place_([=](double step_size) {
          return after(car, speed, command, seconds, step_size).X_WB.p;
        }),
        exact_(place_(1e-3 / 64.0)) {}
  double operator()(double step_size) const { return norm(place_(step_size) - exact_); }

 private:
  std::function<Vec2(double)> place_;
  Vec2 exact_;
};

TEST(Integrator, IsOfFourthOrderForEveryDrive) {
  for (const double front_share : {0.6, 1.0}) {
    const Command command{.steering = 0.045, .motor_torque = 900.0};
    const Errors error(driven(front_share), 15.0, command, 0.5);
    EXPECT_LT(error(1e-3), 1e-6) << front_share;
    EXPECT_NEAR(std::log2(error(1e-3) / error(0.25e-3)) / 2.0, 4.0, 0.4) << front_share;
  }
}

// A wheel that locks, the steering's rate limit and the last standstill happen somewhere between
// two steps: first order is left, with errors of micrometres.
TEST(Integrator, IsOfFirstOrderAcrossEvents) {
  Command locking;
  locking.brake_torque.fill(3000.0);
  locking.steering = 0.04;
  struct Drive {
    const char* name;
    double speed;
    Command command;
    double seconds;
    double largest;  // error at 1 ms [m]
  };
  for (const Drive& drive : {Drive{"wheels lock", 20.0, locking, 0.5, 3e-6},
                             Drive{"steering's rate", 20.0, {.steering = 0.2}, 0.5, 1e-8},
                             Drive{"comes to rest", 3.0, locking, 1.0, 4e-5}}) {
    const Errors error(prepare::default_vehicle(), drive.speed, drive.command, drive.seconds);
    for (const double part : {1.0, 0.5, 0.25, 1.0 / 16.0}) {
      EXPECT_LT(error(part * 1e-3), part * drive.largest) << drive.name << ' ' << part;
    }
  }
}

}  // namespace
}  // namespace saca::vehicle::extremes_test
