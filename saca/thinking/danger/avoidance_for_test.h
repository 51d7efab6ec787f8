#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>

#include "saca/lab/levelset/pack.h"
#include "saca/thinking/danger/avoidance.h"
#include "saca/thinking/danger/grid.h"

/// What holds for the avoidance problem in whatever coordinates.
namespace saca::danger {

using Number = levelset::Pack<double, xsimd::default_arch>;

inline std::array<Number, 4> packed(const State& p) {
  return {Number(p[0]), Number(p[1]), Number(p[2]), Number(p[3])};
}
inline double only(const Number& number) {
  std::array<double, Number::size> values{};
  number.store(values.data());
  return values[0];
}

template <class System>
double hamiltonian(const System& system, const State& state, const State& p) {
  return only(system.row(state).hamiltonian(Number(state[0]), packed(p)));
}
template <class System>
double upwind(const System& system, const State& state, const State& left, const State& right) {
  return only(system.row(state).upwind(Number(state[0]), packed(left), packed(right)));
}

/// Cars, states and slopes at the limits and between them.
struct AvoidanceDraws {
  std::mt19937_64 engine;

  double in(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  Avoidance system() {
    return {.grip = in(0.2, 1.0),
            .tightest_curvature = in(0.05, 0.3),
            .drive_share = engine() % 8 == 0 ? static_cast<double>(engine() % 2) : in(0.0, 1.0),
            .obstacle_speed = engine() % 2 == 0 ? 0.0 : in(-20.0, 20.0)};
  }
  /// Two places [m], an angle [rad] and the ego's speed [m/s].
  State state() {
    const std::array<double, 4> speeds{0.0, in(0.0, 0.01), in(0.0, 8.0), in(0.0, 40.0)};
    return {in(-50.0, 50.0), in(-50.0, 50.0), in(-std::numbers::pi, std::numbers::pi),
            speeds.at(engine() % 4)};
  }
  State gradient() {
    State p{in(-1.0, 1.0), in(-1.0, 1.0), in(-9.0, 9.0), in(-1.0, 1.0)};
    for (double& slope : p) {
      slope *= engine() % 5 == 0 ? 0.0 : 1.0;
    }
    return p;
  }
};

/// Upwind rates fall in the left slopes and rise in the right ones.
/// @param system_of  makes the system of a drawn car
void expect_monotone(unsigned seed, const auto& system_of) {
  AvoidanceDraws draws{std::mt19937_64(seed)};
  for (int i = 0; i < 20'000; ++i) {
    const auto system = system_of(draws.system());
    const State state = draws.state();
    const State left = draws.gradient();
    const State right = draws.gradient();
    const double before = upwind(system, state, left, right);
    State steeper = left;
    steeper.at(draws.engine() % 4) += draws.in(0.0, 2.0);
    EXPECT_LE(upwind(system, state, steeper, right), before + 1e-9) << i;
    steeper = right;
    steeper.at(draws.engine() % 4) += draws.in(0.0, 2.0);
    EXPECT_GE(upwind(system, state, left, steeper), before - 1e-9) << i;
  }
}

/// A slope changes the Hamiltonian by no more than its axis' speed times as much.
void expect_bounded_by_speeds(unsigned seed, const auto& system_of) {
  AvoidanceDraws draws{std::mt19937_64(seed)};
  for (int i = 0; i < 4'000; ++i) {
    const auto system = system_of(draws.system());
    const State state = draws.state();
    const State p = draws.gradient();
    const auto bounds = system.row(state).speeds(Number(state[0]));
    for (std::size_t axis = 0; axis < 4; ++axis) {
      State other = p;
      other.at(axis) += draws.in(-1.0, 1.0);
      const double change = hamiltonian(system, state, other) - hamiltonian(system, state, p);
      EXPECT_LE(std::abs(change),
                only(bounds.at(axis)) * std::abs(other.at(axis) - p.at(axis)) + 1e-9)
          << i << " axis " << axis;
    }
  }
}

}  // namespace saca::danger
