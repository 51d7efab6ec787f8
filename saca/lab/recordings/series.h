#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace saca::recordings {

// Noisy series of equal steps: what an importer does to recordings before anyone differentiates
// them.

/// A value that is missing.
constexpr double missing = std::numeric_limits<double>::quiet_NaN();

struct FilledSeries {
  std::vector<double> values;  ///< none missing
  std::size_t num_filled = 0;  ///< how many were missing
};

/// Missing values on the straight line between their neighbours; before the first and after the
/// last one seen, that one.
/// @throws ContractViolation  if all are missing
[[nodiscard]] FilledSeries filled(const std::vector<double>& series);

/// Removes (makes NaN) each value farther than `bound` from what its neighbours within `half` steps
/// predict: the median of their values, each moved along its own measured slope.
/// @param slopes  [1/s], as many as values
/// @param step    [s], > 0
/// @return        how many were removed
std::size_t remove_outliers(std::vector<double>& series, const std::vector<double>& slopes,
                            double step, std::size_t half, double bound);

/// A slow sensor's last value, held until the next: keeps the first of each run of equal values,
/// and of a run longer than `longest_hold` steps (truly constant, then) all but the last so many;
/// makes the others NaN, to be filled.
[[nodiscard]] std::vector<double> without_holds(const std::vector<double>& series,
                                                std::size_t longest_hold);

/// Least squares in a few unknowns: the normal equations.
/// @tparam num_unknowns  3 or 4
template <std::size_t num_unknowns>
class NormalEquations {
 public:
  /// One observation: row * x = value.
  void add(const std::array<double, num_unknowns>& row, double value, double weight);
  /// @return  x; 0 for an unknown that the observations do not determine
  [[nodiscard]] std::array<double, num_unknowns> solution() const;

 private:
  std::array<std::array<double, num_unknowns>, num_unknowns> matrix_{};
  std::array<double, num_unknowns> right_{};
};

extern template class NormalEquations<3>;
extern template class NormalEquations<4>;

using Normal3 = NormalEquations<3>;
using Normal4 = NormalEquations<4>;

/// Value and slope of a series, smoothed.
struct Fit {
  std::vector<double> values;
  std::vector<double> slopes;  ///< [1/s]
};

/// Least-squares line through the values within `half` steps of each.
/// @param step  [s], > 0
[[nodiscard]] Fit line_fit(const std::vector<double>& values, double step, std::size_t half);

/// Least-squares parabola through values and measured slopes within `half` steps of each: the two
/// measurements of a radar, range and range rate, correct one another.
/// @param slope_weight  (sd of a value / sd of a slope)^2 [s^2], > 0
[[nodiscard]] Fit parabola_fit(const std::vector<double>& values, const std::vector<double>& slopes,
                               double step, std::size_t half, double slope_weight);

/// The nearest series (least squares) that never falls: pool adjacent violators.
[[nodiscard]] std::vector<double> never_falling(const std::vector<double>& series);

/// The integral from the first value on, by trapezia: as long as `rates`, from 0.
[[nodiscard]] std::vector<double> integral(const std::vector<double>& rates, double step);

}  // namespace saca::recordings
