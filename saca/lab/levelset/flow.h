#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "saca/thinking/danger/grid.h"

/// What the solver must know about a system: how its value changes, a row of cells at a time.
///
/// A system is written as a struct of this shape (this one: `examples/own_dynamics`) and made into
/// a `Flow` by `flow_of` (`flow_of.h`):
///
///     struct Brake {  // x' = v, v' = a, |a| <= strongest
///       static constexpr std::size_t dimensions = 2;
///       double strongest;
///       struct Row {  // cells along the first axis
///         double v, strongest;
///         template <class N>
///         N hamiltonian(const N& /*x*/, const std::array<N, 2>& p) const {
///           return v * p[0] - strongest * abs(p[1]);  // the best of all inputs: f . p
///         }
///         template <class N>
///         std::array<N, 2> speeds(const N& /*x*/) const {
///           return {std::abs(v), strongest};  // |dH/dp_i| at most, for any gradient
///         }
///       };
///       // x[0] is not set: it goes along the row
///       Row row(const std::array<double, 2>& x) const { return {x[1], strongest}; }
///     };
///
/// Two members of a row are optional:
///
///     std::array<int, 2> direction;
///
/// the sign of each state's rate where every input has the same all along the row, else 0: that
/// axis takes one difference, which is exact; and, in place of Lax-Friedrichs,
///
///     template <class N>
///     N upwind(const N& x, const std::array<N, 2>& left, const std::array<N, 2>& right) const;
///
/// a monotone numerical Hamiltonian in closed form, falling in `left` and rising in `right`.
///
/// What one of them throws ends the solver's step and comes out of it.
///
/// The value obeys V_tau = H(x, grad V), tau being the time to go: H = min over u of f . grad V
/// where inputs avoid what is unsafe (V >= 0), max where they seek it.
namespace saca::levelset {

/// One-sided differences, by the smoothness that they make use of.
enum class Differences : std::uint8_t { upwind1, eno2, eno3, weno5 };
constexpr std::array<std::string_view, 4> difference_names{"upwind1", "eno2", "eno3", "weno5"};

/// Runge-Kutta steps that keep the variation from growing.
enum class Steps : std::uint8_t { euler, tvd_rk2, tvd_rk3 };
constexpr std::array<std::string_view, 3> step_names{"euler", "rk2", "rk3"};

/// What is done with the values from step to step.
enum class Tube : std::uint8_t {
  set,      ///< nothing: states that are unsafe after exactly that time
  tube,     ///< none falls: unsafe once is unsafe for good
  highest,  ///< none is below h: the running maximum of h (eq. 1 of the paper); h may have any
            ///< slope
};

/// One Runge-Kutta stage over some rows: out = keep x old + (1 - keep) x (values + dt x rate).
template <class Real>
struct Stage {
  const Real* values = nullptr;
  const Real* old = nullptr;
  const Real* h = nullptr;  ///< read for Tube::highest alone
  Real* out = nullptr;      ///< none of the others
  double keep = 0.0;
  double dt = 0.0;
  Tube tube = Tube::highest;
  std::size_t first_row = 0, end_row = 0;
  std::array<double, danger::max_dimensions>
      steepness{};          ///< along each axis, of h: greatest difference
                            ///< between neighbours, > 0; scales WENO's weights
  Real* scratch = nullptr;  ///< `scratch_needed` numbers of this thread's own
};

/// Numbers beyond the last cell of each array that a sweep may read (and never uses).
constexpr std::size_t readable_beyond = 64;

[[nodiscard]] inline std::size_t scratch_needed(const danger::Grid& grid) {
  const std::size_t row = static_cast<std::size_t>(grid.axes[0].points) + 2 * readable_beyond;
  return 10 * row;  // the padded row, and three rows beyond an edge of each other axis
}

/// What came out of some rows.
struct Swept {
  double greatest_change = 0.0;            ///< of |out - old|
  std::optional<std::size_t> broken_cell;  ///< the first whose value is no number
};

/// A system on a grid, ready to be solved; made by `flow_of`.
template <class Real>
struct Flow {
  std::size_t dimensions = 0;
  /// Sweeps some rows; called from several threads with rows of their own.
  std::function<Swept(const Stage<Real>&)> sweep;
  /// Largest sum over the axes of speed / spacing, over all cells [1/s].
  double crossings_per_second = 0.0;
};

}  // namespace saca::levelset
