#pragma once

#include <array>
#include <cmath>

#include "saca/lab/levelset/flow.h"
#include "saca/thinking/danger/grid.h"

/// Systems whose values are known in closed form.
namespace saca::verification {

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

/// A known system with inner loops that are compiled once, always optimised: under a sanitiser too,
/// where those of `flow_of` in a test take minutes.
///
/// @tparam System  ConstantMotion, AnyDirection<1 to 3> or DoubleIntegrator; in doubles, the last
/// of
///                 AnyDirection and DoubleIntegrator in floats too
/// @throws ContractViolation  as `flow_of` (`flow_of.h`)
template <class Real, class System>
[[nodiscard]] levelset::Flow<Real> known_flow(
    const danger::Grid& grid, const System& system,
    levelset::Differences differences = levelset::Differences::weno5);

extern template levelset::Flow<double> known_flow(const danger::Grid&, const ConstantMotion&,
                                                  levelset::Differences);
extern template levelset::Flow<double> known_flow(const danger::Grid&, const AnyDirection<1>&,
                                                  levelset::Differences);
extern template levelset::Flow<double> known_flow(const danger::Grid&, const AnyDirection<2>&,
                                                  levelset::Differences);
extern template levelset::Flow<double> known_flow(const danger::Grid&, const AnyDirection<3>&,
                                                  levelset::Differences);
extern template levelset::Flow<float> known_flow(const danger::Grid&, const AnyDirection<3>&,
                                                 levelset::Differences);
extern template levelset::Flow<double> known_flow(const danger::Grid&, const DoubleIntegrator&,
                                                  levelset::Differences);
extern template levelset::Flow<float> known_flow(const danger::Grid&, const DoubleIntegrator&,
                                                 levelset::Differences);

}  // namespace saca::verification
