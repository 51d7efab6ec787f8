// Standard manoeuvres, open loop: steady cornering (ISO 4138), step and sine steer (ISO 7401) and
// split grip. What is expected comes from the linear single-track model (M. Mitschke, H.
// Wallentowitz, Dynamik der Kraftfahrzeuge, 5th ed., 2014, part C; H. B. Pacejka, Tire and Vehicle
// Dynamics, 3rd ed., 2012, ch. 1) and, near the limit, from axle characteristics with the standard
// library's sine and arc tangent: nothing of the model but its parameters.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/vehicle/vehicle.h"

namespace saca::vehicle::standard_manoeuvres_test {
namespace {

constexpr double dt = 1e-3;

struct NamedCar {
  const char* name;
  Vehicle car;
};

// Another car: heavy in front, long, tall, softer and less even tyres, front-driven. Design values.
Vehicle front_heavy() {
  return {
      .mass = 2600.0,
      .yaw_inertia = 4600.0,
      .cg_to_front_axle = 1.25,
      .cg_to_rear_axle = 1.95,
      .track_width = 1.7,
      .cg_height = 0.68,
      .front_roll_stiffness_share = 0.62,
      .load_transfer_lag = 0.12,
      .drag_area = 1.1,
      .wheel_radius = 0.37,
      .front_wheel_inertia = 2.3,
      .rear_wheel_inertia = 1.9,
      .tyre = {.stiffness = 14.0, .shape = 1.3, .load_sensitivity = 0.12, .nominal_load = 6000.0},
      .steering_lag = 0.08,
      .steering_rate = 0.8,
      .steering_limit = 0.6,
      .brake_dead_time = 0.02,
      .brake_lag = 0.09,
      .brake_limit = 6000.0,
      .motor_limit = 5000.0,
      .motor_front_share = 1.0,
      .motor_lag = 0.05,
      .body_length = 5.3,
      .body_width = 2.0,
      .front_end = 2.2};
}

double wheelbase_of(const Vehicle& car) {
  return car.cg_to_front_axle + car.cg_to_rear_axle;
}

double air_drag(const Vehicle& car, double speed) {
  return 0.5 * air_density * car.drag_area * speed * speed;
}

// Rolling ahead, the motor against air drag.
VehicleState cruising(const Vehicle& car, double speed) {
  VehicleState state = prepare::rolling(car, speed);
  state.motor_torque = air_drag(car, speed) * car.wheel_radius;
  return state;
}

// ---- steady cornering -----------------------------------------------------------------------

// The motor torque that holds a speed; steady cornering adds the drag of the turned front wheels.
double holding(const Vehicle& car, const VehicleState& state, double speed) {
  constexpr double gain = 4.0;  // [1/s]
  return (air_drag(car, speed) + gain * car.mass * (speed - state.v_B.x)) * car.wheel_radius;
}

// ISO 4138, constant speed: the steering rises slowly to `steering` and stays.
VehicleState corner_at_speed(const Vehicle& car, const PerWheel& grip, double speed,
                             double steering) {
  VehicleState state = cruising(car, speed);
  for (int i = 0; i < 5000; ++i) {
    const double rising = std::min(1.0, i / 2000.0);
    state =
        step(car, state,
             {.steering = rising * steering, .motor_torque = holding(car, state, speed)}, grip, dt);
  }
  return state;
}

// ISO 4138, constant radius: the steering integrates what the curvature of the path lacks.
VehicleState corner_on_circle(const Vehicle& car, const PerWheel& grip, double speed,
                              double radius) {
  VehicleState state = cruising(car, speed);
  double steering = 0.0;
  for (int i = 0; i < 9000; ++i) {
    const double curvature = state.yaw_rate / norm(state.v_B);
    steering += 2.0 * wheelbase_of(car) * (1.0 / radius - curvature) * dt;
    state = step(car, state, {.steering = steering, .motor_torque = holding(car, state, speed)},
                 grip, dt);
  }
  return state;
}

// An axle in a steady turn: its static load, what roll moves, the grip under both wheels.
struct Axle {
  double load;   // [N]
  double moved;  // [N], from the inner to the outer wheel
  double grip;
};

double peak_of(const Tyre& tyre, double load, double grip) {
  return grip * (1.0 + tyre.load_sensitivity * (1.0 - load / tyre.nominal_load));
}

double axle_force(const Tyre& tyre, const Axle& axle, double slip) {
  double force = 0.0;
  for (const double side : {-1.0, 1.0}) {
    const double load = 0.5 * axle.load + side * axle.moved;
    const double peak = peak_of(tyre, load, axle.grip);
    force +=
        peak * load * std::sin(tyre.shape * std::atan(tyre.stiffness * slip / tyre.shape / peak));
  }
  return force;
}

// Slip angle [rad] that gives a sideways force, by bisection below the peak.
double slip_of(const Tyre& tyre, const Axle& axle, double force) {
  double low = 0.0;
  double high =
      0.9 * axle.grip * tyre.shape / tyre.stiffness * std::tan(0.5 * std::numbers::pi / tyre.shape);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (axle_force(tyre, axle, middle) < force ? low : high) = middle;
  }
  return low;
}

// The angle of the road wheels that a steady turn needs, by axles: the handling curve (Pacejka, 3rd
// ed., section 1.3) steering = wheelbase / radius + front slip - rear slip, with what is of second
// order: the centripetal acceleration's part along the car moves load to the rear; turned front
// wheels pull back, the outer one harder; the driven axle also pulls.
double steering_needed(const Vehicle& car, const PerWheel& grip, double a_y, double speed) {
  const double weight = car.mass * gravity;
  const double moved = car.mass * a_y * car.cg_height / car.track_width;
  const double curvature = a_y / (speed * speed);
  double a_x = 0.0;
  double steering = 0.0;
  double pull = 0.0;        // of the front axle across its own plane
  double difference = 0.0;  // of the outer and the inner front wheel in that
  const auto slip_angle = [&](const Axle& axle, double across, double along) {
    const double force = std::hypot(across, along);
    return std::asin(slip_of(car.tyre, axle, force) * across / force);
  };
  for (int i = 0; i < 12; ++i) {
    const double front_load =
        (weight * car.cg_to_rear_axle - car.mass * a_x * car.cg_height) / wheelbase_of(car);
    const Axle front{front_load, car.front_roll_stiffness_share * moved, grip[front_left]};
    const Axle rear{weight - front_load, (1.0 - car.front_roll_stiffness_share) * moved,
                    grip[rear_left]};
    const double drive = car.mass * a_x + air_drag(car, speed) + pull * std::sin(steering);
    const double front_drive = car.motor_front_share * drive;
    const double front_force = (car.cg_to_rear_axle * car.mass * a_y +
                                0.5 * car.track_width * difference * std::sin(steering)) /
                               wheelbase_of(car);
    pull = (front_force - front_drive * std::sin(steering)) / std::cos(steering);
    difference = pull * 2.0 * front.moved / front.load;
    const double front_angle = slip_angle(front, pull, front_drive);
    const double rear_angle = slip_angle(rear, car.mass * a_y - front_force, drive - front_drive);
    const double sideslip = car.cg_to_rear_axle * curvature - std::tan(rear_angle);
    a_x = -a_y * sideslip;
    steering = front_angle + std::atan(sideslip + car.cg_to_front_axle * curvature);
  }
  return steering;
}

class Manoeuvre : public testing::TestWithParam<NamedCar> {
 protected:
  const Vehicle car_ = GetParam().car;
  const double wheelbase_ = wheelbase_of(car_);
};

constexpr PerWheel dry{0.9, 0.9, 0.9, 0.9};

// What the steering has more than the geometry of the turn needs.
double excess(const Vehicle& car, double steering, const VehicleState& end) {
  return steering - wheelbase_of(car) * end.yaw_rate / end.v_B.x;
}

// The understeer gradient m (b / C_f - a / C_r) / wheelbase, with the axles' cornering stiffness
// C = stiffness x load: 1 / (stiffness g) - 1 / (stiffness g) = 0. Every car of this model is
// neutral at small accelerations, wherever its mass lies, however its roll is shared, whatever the
// grip: stiffness knows none of them.
TEST_P(Manoeuvre, IsNeutralAtSmallLateralAcceleration) {
  for (const double shift : {-0.3, 0.0, 0.3}) {
    Vehicle car = car_;
    car.cg_to_front_axle += shift;
    car.cg_to_rear_axle -= shift;
    for (const PerWheel& grip : {dry, PerWheel{0.5, 0.5, 0.9, 0.9}}) {
      const double speed = 25.0;
      const VehicleState end =
          corner_at_speed(car, grip, speed, wheelbase_ * 0.6 / (speed * speed));
      const double a_y = end.yaw_rate * end.v_B.x;
      ASSERT_NEAR(a_y, 0.6, 0.01);
      // 0.03 degrees per g; passenger cars have some degrees per g.
      EXPECT_LT(std::abs(excess(car, end.steering, end)) / a_y, 5e-5) << shift << ' ' << grip[0];
    }
  }
}

// Further up, load sensitivity makes the axle with the larger share of roll the weaker one.
TEST_P(Manoeuvre, FollowsTheHandlingCurveAtConstantSpeed) {
  double before = -1.0;
  for (const double share : {0.25, 0.5, 0.75}) {
    Vehicle car = car_;
    car.front_roll_stiffness_share = share;
    double last = 0.0;  // excess at the largest acceleration
    for (const double wanted : {2.0, 4.0, 5.5}) {
      const double speed = 25.0;
      const VehicleState end =
          corner_at_speed(car, dry, speed, steering_needed(car, dry, wanted, speed));
      const double a_y = end.yaw_rate * end.v_B.x;
      EXPECT_NEAR(a_y, wanted, 0.01 * wanted) << share;
      const double expected = steering_needed(car, dry, a_y, end.v_B.x);
      last = excess(car, end.steering, end);
      EXPECT_NEAR(last, excess(car, expected, end), 3e-4) << share << ' ' << wanted;
    }
    EXPECT_GT(last, before);
    before = last;
  }
}

// Poorer grip under one axle: it slips more, so the car understeers or oversteers; no other force
// shifts the balance as much.
TEST_P(Manoeuvre, FollowsTheHandlingCurveOnACircle) {
  const double radius = 100.0;
  const auto end_excess = [&](const PerWheel& grip) {
    double last = 0.0;
    for (const double wanted : {1.0, 3.0, 5.0}) {
      const VehicleState end = corner_on_circle(car_, grip, std::sqrt(wanted * radius), radius);
      EXPECT_NEAR(norm(end.v_B) / end.yaw_rate, radius, 0.01);
      const double a_y = end.yaw_rate * end.v_B.x;
      const double expected = steering_needed(car_, grip, a_y, end.v_B.x);
      last = excess(car_, end.steering, end);
      EXPECT_NEAR(last, excess(car_, expected, end), 2e-4) << grip[0] << ' ' << grip[2];
    }
    return last;
  };
  const double even = end_excess(dry);
  EXPECT_GT(end_excess({0.75, 0.75, 0.9, 0.9}), even + 1e-3);
  EXPECT_LT(end_excess({0.9, 0.9, 0.75, 0.75}), even - 1e-3);
}

// The front axle limits: each of its wheels gives grip (1 + s (1 - N / N_0)) N, s the load
// sensitivity, less what driving takes of its circle; the rear balances the moment, less the one by
// which the outer front wheel, turned, pulls back harder than the inner one.
TEST_P(Manoeuvre, CornersAsHardAsItsFrontAxleHolds) {
  const double speed = 30.0;
  for (const double share : {0.55, 0.7}) {
    Vehicle car = car_;
    car.front_roll_stiffness_share = share;
    VehicleState state = cruising(car, speed);
    VehicleState hardest = state;
    for (int i = 0; i < 15'000; ++i) {
      state = step(car, state, {.steering = 1e-5 * i, .motor_torque = holding(car, state, speed)},
                   dry, dt);
      if (state.a_B.y > hardest.a_B.y) {
        hardest = state;
      }
    }
    const auto [a_x, most] = hardest.a_B;
    const double sine = std::sin(hardest.steering);
    const double moved = share * car.mass * most * car.cg_height / car.track_width;
    const double load =
        0.5 * car.mass * (gravity * car.cg_to_rear_axle - a_x * car.cg_height) / wheelbase_;
    const double outer_peak = peak_of(car.tyre, load + moved, 0.9) * (load + moved);
    const double inner_peak = peak_of(car.tyre, load - moved, 0.9) * (load - moved);
    const double drive =
        car.motor_front_share * (car.mass * a_x + air_drag(car, hardest.v_B.x) +
                                 (outer_peak + inner_peak) * sine);  // of both, half by each
    const double outer = std::sqrt(outer_peak * outer_peak - 0.25 * drive * drive);
    const double inner = std::sqrt(inner_peak * inner_peak - 0.25 * drive * drive);
    const double front = (outer + inner) * std::cos(hardest.steering) + drive * sine;
    const double expected = (front * wheelbase_ - 0.5 * car.track_width * (outer - inner) * sine) /
                            (car.cg_to_rear_axle * car.mass);
    EXPECT_NEAR(most, expected, 0.01 * expected) << share;
  }
}

// ---- step and sine steer --------------------------------------------------------------------

// The linear single-track model: x = (v_y, yaw rate), x' = A x + b steering. Each wheel's spin
// follows the yaw rate, +-half the track away, and adds its inertia x (track / 2 / radius)^2.
struct LinearCar {
  double a11, a12, a21, a22, b1, b2;
};

double yaw_inertia_with_wheels(const Vehicle& car) {
  const double arm = 0.5 * car.track_width / car.wheel_radius;
  return car.yaw_inertia + 2.0 * (car.front_wheel_inertia + car.rear_wheel_inertia) * arm * arm;
}

LinearCar linear(const Vehicle& car, double speed) {
  const double L = wheelbase_of(car);
  const double front = car.tyre.stiffness * car.mass * gravity * car.cg_to_rear_axle / L;
  const double rear = car.tyre.stiffness * car.mass * gravity * car.cg_to_front_axle / L;
  const double moment = car.cg_to_front_axle * front - car.cg_to_rear_axle * rear;
  const double inertia = yaw_inertia_with_wheels(car);
  return {.a11 = -(front + rear) / (car.mass * speed),
          .a12 = -speed - moment / (car.mass * speed),
          .a21 = -moment / (inertia * speed),
          .a22 = -(car.cg_to_front_axle * car.cg_to_front_axle * front +
                   car.cg_to_rear_axle * car.cg_to_rear_axle * rear) /
                 (inertia * speed),
          .b1 = front / car.mass,
          .b2 = car.cg_to_front_axle * front / inertia};
}

// Columns: what has become of a little v_y and of a little yaw rate, after a time.
struct Matrix {
  double m11, m12, m21, m22;
};

Matrix operator*(const Matrix& p, const Matrix& q) {
  return {p.m11 * q.m11 + p.m12 * q.m21, p.m11 * q.m12 + p.m12 * q.m22,
          p.m21 * q.m11 + p.m22 * q.m21, p.m21 * q.m12 + p.m22 * q.m22};
}

Matrix inverse(const Matrix& p) {
  const double det = p.m11 * p.m22 - p.m12 * p.m21;
  return {p.m22 / det, -p.m12 / det, -p.m21 / det, p.m11 / det};
}

Matrix free_motion(const Vehicle& car, double speed, int num_steps) {
  constexpr double small = 1e-4;
  const auto end = [&](Vec2 start) {
    VehicleState state = cruising(car, speed);
    state.v_B.y = small * start.x;
    state.yaw_rate = small * start.y;
    for (int i = 0; i < num_steps; ++i) {
      state = step(car, state, {.motor_torque = state.motor_torque}, dry, dt);
    }
    return Vec2{state.v_B.y / small, state.yaw_rate / small};
  };
  const Vec2 first = end({1.0, 0.0});
  const Vec2 second = end({0.0, 1.0});
  return {first.x, second.x, first.y, second.y};
}

// Once the wheels' spin has settled, 4 ms of free motion are exp(0.004 A). Equal stiffness over
// load gives A's frequency k g / V x sqrt(m a b / I), and its damping (1 + m a b / I) / (2 sqrt(m a
// b / I)): at least 1, and the same at every speed.
TEST_P(Manoeuvre, HasTheFrequencyAndDampingOfTheLinearCar) {
  for (const double speed : {10.0, 15.0, 20.0, 25.0, 30.0}) {
    Matrix little = free_motion(car_, speed, 64) * inverse(free_motion(car_, speed, 60));
    little.m11 -= 1.0;
    little.m22 -= 1.0;
    Matrix A{};  // log(1 + E) = E - E^2 / 2 + E^3 / 3 - ..., E about 0.1
    Matrix power = little;
    for (int n = 1; n <= 12; ++n) {
      const double factor = (n % 2 == 1 ? 1.0 : -1.0) / (n * 4.0 * dt);
      A = {A.m11 + factor * power.m11, A.m12 + factor * power.m12, A.m21 + factor * power.m21,
           A.m22 + factor * power.m22};
      power = power * little;
    }
    const LinearCar expected = linear(car_, speed);
    EXPECT_NEAR(A.m11, expected.a11, 0.005 * std::abs(expected.a11)) << speed;
    EXPECT_NEAR(A.m12, expected.a12, 0.005 * speed) << speed;
    EXPECT_NEAR(A.m21, 0.0, 0.01) << speed;  // neutral: sideslip alone does not turn the car
    EXPECT_NEAR(A.m22, expected.a22, 0.005 * std::abs(expected.a22)) << speed;
    const double ratio =
        car_.mass * car_.cg_to_front_axle * car_.cg_to_rear_axle / yaw_inertia_with_wheels(car_);
    const double frequency = std::sqrt(A.m11 * A.m22 - A.m12 * A.m21);
    EXPECT_NEAR(frequency, car_.tyre.stiffness * gravity / speed * std::sqrt(ratio),
                0.005 * frequency);
    EXPECT_NEAR(-(A.m11 + A.m22) / (2.0 * frequency), (1.0 + ratio) / (2.0 * std::sqrt(ratio)),
                0.005);
  }
}

// A neutral car's yaw rate answers with one time constant, T = V / (stiffness g m a b / I), behind
// the steering's own: it never overshoots.
TEST_P(Manoeuvre, AnswersAStepAsTheLinearCar) {
  for (const double speed : {10.0, 15.0, 20.0, 25.0, 30.0}) {
    const double steering = 0.4 * wheelbase_ / (speed * speed);  // 0.4 m/s^2
    const double end = steering * speed / wheelbase_;
    const LinearCar line = linear(car_, speed);
    const double T = -1.0 / line.a22;
    const double lag = car_.steering_lag;
    const auto expected = [&](double t) {
      return end * (1.0 - (T * std::exp(-t / T) - lag * std::exp(-t / lag)) / (T - lag));
    };
    VehicleState state = cruising(car_, speed);
    double most = 0.0;
    double off = 0.0;
    for (int i = 1; i <= 1500; ++i) {
      state =
          step(car_, state, {.steering = steering, .motor_torque = state.motor_torque}, dry, dt);
      most = std::max(most, state.yaw_rate);
      off = std::max(off, std::abs(state.yaw_rate - expected(i * dt)));
    }
    EXPECT_LT(off, 0.005 * end) << speed;
    EXPECT_LT(most, 1.003 * end) << speed;
    EXPECT_NEAR(state.yaw_rate, end, 0.003 * end) << speed;
  }
}

// At larger angles the tyres give less than they promise: the gain falls as the axles say.
TEST_P(Manoeuvre, LosesYawRateGainWithLargerSteps) {
  const double speed = 25.0;
  double gain = 1.001;
  for (const double steering : {0.01, 0.02, 0.03, 0.04}) {
    const VehicleState end = corner_at_speed(car_, dry, speed, steering);
    const double neutral = end.v_B.x / wheelbase_;
    const double needed = steering_needed(car_, dry, end.yaw_rate * end.v_B.x, end.v_B.x);
    const double relative = end.yaw_rate / steering / neutral;
    EXPECT_NEAR(relative, end.yaw_rate / needed / neutral, 0.02) << steering;
    EXPECT_LT(relative, gain) << steering;
    gain = relative;
  }
  EXPECT_LT(gain, 0.95);
}

TEST_P(Manoeuvre, AnswersASineAsTheLinearCar) {
  using Complex = std::complex<double>;
  for (const double speed : {15.0, 28.0}) {
    const LinearCar line = linear(car_, speed);
    const double amplitude = 0.6 * wheelbase_ / (speed * speed);
    for (const double frequency : {0.25, 0.5, 1.0, 2.0, 4.0}) {
      const double omega = 2.0 * std::numbers::pi * frequency;
      const Complex s{0.0, omega};
      const Complex angle = 1.0 / (1.0 + s * car_.steering_lag);
      const Complex det = (s - line.a11) * (s - line.a22) - line.a12 * line.a21;
      const Complex v_y = ((s - line.a22) * line.b1 + line.a12 * line.b2) / det * angle;
      const Complex yaw_rate = ((s - line.a11) * line.b2 + line.a21 * line.b1) / det * angle;
      // Two periods to settle, and one second more; then two periods are measured.
      const auto period = std::lround(1.0 / (frequency * dt));
      const long start = 2 * period + 1000;
      VehicleState state = cruising(car_, speed);
      Complex v_sum;
      Complex yaw_sum;
      for (long i = 0; i < start + 2 * period; ++i) {
        // Held for a step, a command is its value in the middle.
        const Command command{
            .steering = amplitude * std::sin(omega * (static_cast<double>(i) + 0.5) * dt),
            .motor_torque = state.motor_torque};
        state = step(car_, state, command, dry, dt);
        if (i >= start) {
          // sin = Re(-j e^jwt)
          const Complex turn = Complex{0.0, 1.0} *
                               std::exp(-s * (static_cast<double>(i + 1) * dt)) *
                               (1.0 / (static_cast<double>(period) * amplitude));
          v_sum += state.v_B.y * turn;
          yaw_sum += state.yaw_rate * turn;
        }
      }
      EXPECT_NEAR(std::abs(yaw_sum / yaw_rate), 1.0, 0.01) << speed << ' ' << frequency;
      EXPECT_NEAR(std::arg(yaw_sum / yaw_rate), 0.0, 0.01) << speed << ' ' << frequency;
      EXPECT_LT(std::abs(v_sum - v_y), 0.01 * std::abs(line.b1 / line.a11))
          << speed << ' ' << frequency;
    }
  }
}

// ---- split grip -----------------------------------------------------------------------------

// All wheels locked, ice on the left: slip 1 under each, so that each side's force is known, and
// half the track is their arm.
TEST_P(Manoeuvre, TurnsOnSplitGripByHalfTheTrackTimesTheDifference) {
  const PerWheel grip{0.2, 0.9, 0.2, 0.9};
  const double speed = 20.0;
  VehicleState state = prepare::rolling(car_, speed);
  state.wheel_speed = {};
  state.brake_torque.fill(3000.0);
  state.brake_line.torque.fill(state.brake_torque);
  const Command command{.brake_torque = state.brake_torque};
  const double weight = car_.mass * gravity;
  double sum = air_drag(car_, speed);
  double moment = 0.0;
  for (std::size_t i = 0; i < num_wheels; ++i) {
    const double load =
        0.5 * weight * (i < 2 ? car_.cg_to_rear_axle : car_.cg_to_front_axle) / wheelbase_;
    const double peak = peak_of(car_.tyre, load, grip[i]);
    const double force =
        peak * load *
        std::sin(car_.tyre.shape * std::atan(car_.tyre.stiffness / (car_.tyre.shape * peak)));
    sum += force;
    moment += (i % 2 == 0 ? 0.5 : -0.5) * car_.track_width * force;
  }
  state = step(car_, state, command, grip, dt);
  EXPECT_NEAR(state.yaw_rate / dt, moment / car_.yaw_inertia,
              1e-3 * std::abs(moment) / car_.yaw_inertia);
  EXPECT_NEAR((speed - state.v_B.x) / dt, sum / car_.mass, 1e-3 * sum / car_.mass);
  for (int i = 1; i < 200; ++i) {
    state = step(car_, state, command, grip, dt);
  }
  // Locked wheels push against their motion: turning is damped by force x arm^2 / speed alone.
  EXPECT_NEAR(state.yaw_rate, moment / car_.yaw_inertia * 0.2, 0.05 * std::abs(state.yaw_rate));
}

INSTANTIATE_TEST_SUITE_P(Cars, Manoeuvre,
                         testing::Values(NamedCar{"Default", prepare::default_vehicle()},
                                         NamedCar{"FrontHeavy", front_heavy()}),
                         [](const auto& named) { return std::string(named.param.name); });

}  // namespace
}  // namespace saca::vehicle::standard_manoeuvres_test
