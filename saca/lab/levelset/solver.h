#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/levelset/flow.h"
#include "saca/thinking/danger/grid.h"

namespace saca::levelset {

struct Settings {
  Tube tube = Tube::highest;
  Steps steps = Steps::tvd_rk3;
  double cfl = 0.75;  ///< share of the longest stable step, in (0, 1]
  int threads = 1;
};

/// Bytes that a solver takes: h, the values and the stages' values.
[[nodiscard]] std::size_t memory_needed(const danger::Grid& grid, std::size_t bytes_per_value,
                                        const Settings& settings);

/// Marches V(x, tau) from V(x, 0) = h onwards.
///
/// @tparam Real  float or double
template <class Real>
class Solver {
 public:
  /// @param flow  of this grid
  /// @param h     what is unsafe (>= 0), or what is to be reached, at every cell
  /// @throws ContractViolation  if the grid breaks a rule, h or the flow does not fit it, h holds
  ///                            what is no number, or a setting is out of range
  Solver(const danger::Grid& grid, Flow<Real> flow, std::span<const Real> h,
         const Settings& settings);

  /// Goes on from values that another solver left at time `tau`.
  void resume(double tau, std::span<const Real> values);

  /// One step, never beyond `until`; a step that would leave a sliver takes half of the rest.
  /// @param until  [s], > time()
  /// @return       an error that names the cell when a value is no number; values are then those
  ///               before the step
  /// @throws       what the system threw (the last of several threads'); the values are likewise
  ///               those before the step
  [[nodiscard]] Result<double> step(double until);

  [[nodiscard]] double time() const { return time_; }  ///< tau [s]
  [[nodiscard]] std::span<const Real> values() const { return {now_.data(), cells_}; }
  /// Greatest change of a value in the last step, per second.
  [[nodiscard]] double greatest_rate() const { return greatest_rate_; }
  [[nodiscard]] const danger::Grid& grid() const { return grid_; }

 private:
  [[nodiscard]] Swept stage(const std::vector<Real>& values, std::vector<Real>& out, double keep,
                            double dt);

  danger::Grid grid_;
  Flow<Real> flow_;
  Settings settings_;
  std::size_t cells_ = 0;
  std::vector<Real> h_, now_, first_, second_, scratch_;
  std::array<double, danger::max_dimensions> steepness_{};
  double time_ = 0.0;
  double longest_step_ = 0.0;  // by the CFL rule [s]
  double greatest_rate_ = 0.0;
};

extern template class Solver<float>;
extern template class Solver<double>;

}  // namespace saca::levelset
