#include "saca/thinking/danger/avoidance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/thinking/danger/avoidance_for_test.h"

namespace saca::danger::avoidance_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double g = 9.80665;  // standard gravity [m/s^2]

/// The admissible inputs by the words of the problem: a polar grid of the disc, what the other two
/// limits cut off being moved onto them (they are straight lines), and their corners with the
/// circle.
std::vector<Acceleration> admissible(const Avoidance& car, double speed, int num_angles) {
  if (speed == 0.0) {
    return {{0.0, 0.0}};
  }
  const double disc = car.grip * g;
  const double drive = car.drive_share * disc;
  const double across = car.tightest_curvature * speed * speed;
  std::vector<Acceleration> inputs{{0.0, 0.0}};
  const auto add = [&](double a_x, double a_y) {
    inputs.push_back({std::min(a_x, drive), std::clamp(a_y, -across, across)});
  };
  for (int i = 0; i < num_angles; ++i) {
    const double angle = 2.0 * pi * i / num_angles;
    for (const double share : {0.5, 1.0}) {
      add(share * disc * std::cos(angle), share * disc * std::sin(angle));
    }
  }
  for (const double side : {-1.0, 1.0}) {
    add(drive, side * std::sqrt(disc * disc - drive * drive));
    if (across < disc) {
      add(std::sqrt(disc * disc - across * across), side * across);
      add(-std::sqrt(disc * disc - across * across), side * across);
    }
  }
  return inputs;
}

/// The least rate over those inputs, each with the differences of the sides to which it moves.
double enumerated(const Avoidance& system, const State& state, const State& left,
                  const State& right, int num_angles = 720) {
  const double speed = state[3];
  double least = 1e300;
  for (const Acceleration& input : admissible(system, speed, num_angles)) {
    const State rate{speed * std::cos(state[2]) - system.obstacle_speed, speed * std::sin(state[2]),
                     speed > 0.0 ? input.across / speed : 0.0, input.along};
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      sum += rate.at(i) * (rate.at(i) > 0.0 ? right.at(i) : left.at(i));
    }
    least = std::min(least, sum);
  }
  return least;
}

/// What 720 directions miss of the best one: its size times half a step squared, halved.
double missed(const Avoidance& system, const State& state, double course_slope,
              double speed_slope) {
  const double q = state[3] > 0.0 ? std::abs(course_slope) / state[3] : 0.0;
  return system.grip * g * std::hypot(q, speed_slope) * 0.5 * std::pow(pi / 720, 2) + 1e-9;
}

TEST(Avoidance, HamiltonianIsTheLeastRateOverEnumeratedInputs) {
  AvoidanceDraws draws{std::mt19937_64(11)};
  std::array<int, 3> num_bound{};  // by the disc alone, by the drive, by the curvature
  for (int i = 0; i < 4'000; ++i) {
    const Avoidance system = draws.system();
    const State state = draws.state();
    const State p = draws.gradient();
    const double found = hamiltonian(system, state, p);
    const double expected = enumerated(system, state, p, p);
    const double slack = missed(system, state, p[2], p[3]);
    EXPECT_LE(found, expected + 1e-9 * (1.0 + std::abs(expected))) << i;
    EXPECT_GE(found, expected - slack) << i << " speed " << state[3];

    const Acceleration best = best_input(system, state[3], p);
    const double disc = system.grip * g;
    num_bound[0] += std::hypot(best.along, best.across) > 0.9999 * disc ? 1 : 0;
    num_bound[1] += best.along > 0.0 && best.along > 0.9999 * system.drive_share * disc ? 1 : 0;
    num_bound[2] +=
        std::abs(best.across) > 0.9999 * system.tightest_curvature * state[3] * state[3] ? 1 : 0;
  }
  EXPECT_GT(*std::min_element(num_bound.begin(), num_bound.end()), 400);  // each limit binds
}

TEST(Avoidance, HamiltonianHasClosedFormsByHand) {
  const Avoidance system{.grip = 0.5, .tightest_curvature = 0.2, .drive_share = 0.6};
  const double disc = 0.5 * g;
  // At 20 m/s the curvature does not bind: the disc's support along (p_v, p_course / v) = (3, 4) a.
  EXPECT_NEAR(hamiltonian(system, {0.0, 0.0, 0.0, 20.0}, {0.0, 0.0, 80.0, 3.0}), -5.0 * disc, 1e-9);
  // Driving, the corner of drive 0.6 and across 0.8 is the best for (-3, 4) too, and stays so for
  // (-4, 3), where the disc alone would give 5.
  EXPECT_NEAR(hamiltonian(system, {0.0, 0.0, 0.0, 20.0}, {0.0, 0.0, 80.0, -3.0}), -5.0 * disc,
              1e-9);
  EXPECT_NEAR(hamiltonian(system, {0.0, 0.0, 0.0, 20.0}, {0.0, 0.0, 60.0, -4.0}),
              -(4.0 * 0.6 + 3.0 * 0.8) * disc, 1e-9);
  // At 1 m/s the course changes by at most 0.2 rad/s.
  EXPECT_NEAR(hamiltonian(system, {0.0, 0.0, 0.0, 1.0}, {0.0, 0.0, -7.0, 0.0}), -1.4, 1e-9);
  // A stopped car stays stopped, whatever the slopes; the obstacle comes nearer at 3 m/s.
  Avoidance moving = system;
  moving.obstacle_speed = 3.0;
  EXPECT_EQ(hamiltonian(moving, {0.0, 0.0, 1.0, 0.0}, {0.5, 9.0, 9.0, -9.0}), -1.5);
  EXPECT_EQ(hamiltonian(system, {0.0, 0.0, 1.0, 8.0}, {}), 0.0);
}

// With one-sided slopes the enumeration takes each from the side that its input moves to.
TEST(Avoidance, UpwindIsTheLeastOverInputsWithTheirOwnSides) {
  AvoidanceDraws draws{std::mt19937_64(12)};
  for (int i = 0; i < 4'000; ++i) {
    const Avoidance system = draws.system();
    const State state = draws.state();
    const State left = draws.gradient();
    const State right = draws.gradient();
    const double found = upwind(system, state, left, right);
    const double expected = enumerated(system, state, left, right);
    const double slack = missed(system, state, std::max(std::abs(left[2]), std::abs(right[2])),
                                std::max(std::abs(left[3]), std::abs(right[3])));
    EXPECT_LE(found, expected + 1e-9 * (1.0 + std::abs(expected))) << i;
    EXPECT_GE(found, expected - slack) << i;
  }
}

constexpr auto seen_by_obstacle = [](const Avoidance& car) { return car; };

TEST(Avoidance, UpwindFallsInTheLeftSlopesAndRisesInTheRightOnes) {
  expect_monotone(13, seen_by_obstacle);
}

TEST(Avoidance, ASlopeThatIsNoNumberIsNotPassedOver) {
  const Limits limits = limits_at({}, 10.0);
  for (std::size_t lost = 0; lost < 4; ++lost) {
    for (const double other : {-1.0, 0.0, 1.0}) {
      std::array<Number, 4> slopes{other, other, other, other};
      EXPECT_TRUE(std::isfinite(only(limits.gain(slopes[0], slopes[1], slopes[2], slopes[3]))));
      slopes[lost] = std::nan("");
      EXPECT_TRUE(std::isnan(only(limits.gain(slopes[0], slopes[1], slopes[2], slopes[3]))))
          << lost << ", others " << other;
    }
  }
}

TEST(Avoidance, SpeedsBoundTheHamiltoniansSlopes) {
  expect_bounded_by_speeds(14, seen_by_obstacle);
}

TEST(Avoidance, DirectionIsTheSignOfTheRatesThatNoInputChanges) {
  const Avoidance system{.obstacle_speed = 5.0};
  const auto row = system.row({0.0, 0.0, 2.5, 12.0});
  EXPECT_EQ(row.direction, (std::array<int, 4>{-1, 1, 0, 0}));
  EXPECT_EQ(system.row({0.0, 0.0, -0.5, 12.0}).direction, (std::array<int, 4>{1, -1, 0, 0}));
}

TEST(Avoidance, BestInputIsAdmissibleAndReachesTheHamiltonian) {
  AvoidanceDraws draws{std::mt19937_64(15)};
  for (int i = 0; i < 4'000; ++i) {
    const Avoidance system = draws.system();
    const State state = draws.state();
    const double speed = state[3];
    const State p = draws.gradient();
    const Acceleration best = best_input(system, speed, p);
    const double disc = system.grip * g;
    EXPECT_LE(std::hypot(best.along, best.across), disc * (1.0 + 1e-12));
    EXPECT_LE(best.along, system.drive_share * disc * (1.0 + 1e-12));
    EXPECT_LE(std::abs(best.across), system.tightest_curvature * speed * speed * (1.0 + 1e-12));
    const double turning = speed > 0.0 ? best.across / speed : 0.0;
    const double rate = p[0] * (speed * std::cos(state[2]) - system.obstacle_speed) +
                        p[1] * speed * std::sin(state[2]) + p[2] * turning + p[3] * best.along;
    EXPECT_NEAR(rate, hamiltonian(system, state, p), 1e-9 * (1.0 + std::abs(rate))) << i;
  }
}

// V(x, y, course, v; grip, T) = V0(x, y, course, f v; grip0, T / f) has the slopes p_v = f p_v0 and
// the rate V_T = V0_T / f: the two equations are one if H = H0 / f.
TEST(Avoidance, AnotherGripIsTheSameProblemAtAnotherPace) {
  AvoidanceDraws draws{std::mt19937_64(16)};
  for (int i = 0; i < 4'000; ++i) {
    const Avoidance system = draws.system();
    const State state = draws.state();
    const State p = draws.gradient();
    const ScaledAvoidance scaled = scaled_to(system, 0.9);
    State there = state;
    there[3] *= scaled.speed_factor;
    State slopes = p;
    slopes[3] /= scaled.speed_factor;
    EXPECT_NEAR(hamiltonian(system, state, p),
                hamiltonian(scaled.system, there, slopes) * scaled.time_factor, 1e-9)
        << i;
  }
  // By hand: grip 0.4 is 0.9 at 1.5 times the speed, in two thirds of the time.
  const ScaledAvoidance scaled = scaled_to({.grip = 0.4, .obstacle_speed = 8.0}, 0.9);
  EXPECT_NEAR(scaled.speed_factor, 1.5, 1e-12);
  EXPECT_NEAR(scaled.time_factor, 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(scaled.system.obstacle_speed, 12.0, 1e-12);
}

// Beside an edge along x nothing depends on x: the same rates with p_x = 0.
TEST(EdgeAvoidance, IsTheSameCarWithoutX) {
  AvoidanceDraws draws{std::mt19937_64(17)};
  for (int i = 0; i < 1'000; ++i) {
    const Avoidance car = draws.system();
    const State state = draws.state();
    State left = draws.gradient();
    State right = draws.gradient();
    left[0] = right[0] = 0.0;
    const auto row = EdgeAvoidance{car}.row({state[1], state[2], state[3]});
    const auto last = [](const State& p) {
      return std::array<Number, 3>{Number(p[1]), Number(p[2]), Number(p[3])};
    };
    EXPECT_EQ(only(row.upwind(Number(0.0), last(left), last(right))),
              upwind(car, state, left, right));
    EXPECT_EQ(only(row.speeds(Number(0.0))[1]), only(car.row(state).speeds(Number(0.0))[2]));
  }
}

TEST(Avoidance, RefusesWhatIsNoCar) {
  EXPECT_THROW((void)limits_at({.grip = 0.0}, 1.0), ContractViolation);
  EXPECT_THROW((void)limits_at({.tightest_curvature = -1.0}, 1.0), ContractViolation);
  EXPECT_THROW((void)limits_at({.drive_share = 1.5}, 1.0), ContractViolation);
  EXPECT_THROW((void)limits_at({}, -1.0), ContractViolation);
  EXPECT_THROW((void)scaled_to({}, std::nan("")), ContractViolation);
}

}  // namespace
}  // namespace saca::danger::avoidance_test
