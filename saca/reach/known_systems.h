#pragma once

#include <array>
#include <cmath>

#include "saca/reach/flow_of.h"

/// Systems whose values are known in closed form.
namespace saca::reach {

/// x' = velocity: V(x, tau) = h(x + velocity tau).
struct ConstantMotion {
  static constexpr std::size_t dimensions = 2;
  double vx = 0.0, vy = 0.0;
  struct Row {
    double vx, vy;
    template <class N>
    [[nodiscard]] N hamiltonian(const N& /*x*/, const std::array<N, 2>& p) const {
      return vx * p[0] + vy * p[1];
    }
    template <class N>
    [[nodiscard]] std::array<N, 2> speeds(const N& /*x*/) const {
      return {N(std::abs(vx)), N(std::abs(vy))};
    }
  };
  [[nodiscard]] Row row(const std::array<double, 2>& /*x*/) const { return {vx, vy}; }
};

/// |x'| <= speed, towards what is unsafe (speed > 0, it grows) or away from it (speed < 0).
template <std::size_t D>
struct AnyDirection {
  static constexpr std::size_t dimensions = D;
  double speed = 1.0;
  struct Row {
    double speed;
    template <class N>
    [[nodiscard]] N hamiltonian(const N& /*x*/, const std::array<N, D>& p) const {
      N sum = p[0] * p[0];
      for (std::size_t d = 1; d < D; ++d) {
        sum = sum + p[d] * p[d];
      }
      return speed * sqrt(sum);
    }
    template <class N>
    [[nodiscard]] std::array<N, D> speeds(const N& /*x*/) const {
      std::array<N, D> all;
      all.fill(N(std::abs(speed)));
      return all;
    }
  };
  [[nodiscard]] Row row(const std::array<double, D>& /*x*/) const { return {speed}; }
};

/// x' = v, v' = a, |a| <= strongest, avoiding.
struct DoubleIntegrator {
  static constexpr std::size_t dimensions = 2;
  double strongest = 1.0;
  struct Row {
    double v, strongest;
    template <class N>
    [[nodiscard]] N hamiltonian(const N& /*x*/, const std::array<N, 2>& p) const {
      return v * p[0] - strongest * abs(p[1]);
    }
    template <class N>
    [[nodiscard]] std::array<N, 2> speeds(const N& /*x*/) const {
      return {N(std::abs(v)), N(strongest)};
    }
  };
  [[nodiscard]] Row row(const std::array<double, 2>& x) const { return {x[1], strongest}; }
};

}  // namespace saca::reach
