#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/lab/levelset/sweep.h"

namespace saca::levelset {

/// Arrays behind a `GridView`.
template <class Real>
class GridArrays {
 public:
  explicit GridArrays(const danger::Grid& grid) {
    const std::vector<std::size_t> stride = danger::strides(grid);
    view_.dimensions = grid.axes.size();
    for (std::size_t d = 0; d < grid.axes.size(); ++d) {
      const danger::Axis& axis = grid.axes[d];
      view_.points[d] = axis.points;
      view_.stride[d] = static_cast<std::ptrdiff_t>(stride[d]);
      view_.edge[d] = axis.edge;
      view_.turned[d] = axis.turned ? static_cast<std::ptrdiff_t>(*axis.turned) : -1;
      view_.image_sum[d] = axis.turned ? image_sum(grid.axes[*axis.turned]) : 0;
      for (int i = 0; i < axis.points; ++i) {
        coordinates_[d].push_back(danger::coordinate(axis, i));
        per_spacing_[d].push_back(static_cast<Real>(1.0 / danger::spacing(axis, i)));
      }
      per_spacing_[d].resize(per_spacing_[d].size() + readable_beyond, Real(1));
      view_.coordinates[d] = coordinates_[d].data();
      view_.per_spacing[d] = per_spacing_[d].data();
    }
    for (const double x : coordinates_[0]) {
      first_coordinates_.push_back(static_cast<Real>(x));
    }
    first_coordinates_.resize(first_coordinates_.size() + readable_beyond, Real(0));
    view_.first_coordinates = first_coordinates_.data();
  }
  GridArrays(const GridArrays&) = delete;
  GridArrays& operator=(const GridArrays&) = delete;

  [[nodiscard]] const GridView<Real>& view() const { return view_; }

 private:
  /// Numbers of two points that lie the same on both sides of 0, summed, in [0, points).
  static std::ptrdiff_t image_sum(const danger::Axis& turned) {
    const auto points = std::ptrdiff_t{turned.points};
    const std::ptrdiff_t sum =
        std::lround(-2.0 * turned.first / danger::spacing(turned, 0)) % points;
    return sum < 0 ? sum + points : sum;
  }

  GridView<Real> view_;
  std::array<std::vector<double>, danger::max_dimensions> coordinates_;
  std::array<std::vector<Real>, danger::max_dimensions> per_spacing_;
  std::vector<Real> first_coordinates_;
};

/// A system with given inner loops.
/// @throws ContractViolation  if the grid breaks a rule or has other dimensions than the system
template <class Real, class System>
[[nodiscard]] Flow<Real> flow_of(const danger::Grid& grid, const System& system,
                                 const Kernel<Real, System>& kernel) {
  expects(!danger::broken_rule(grid), "grid breaks no rule");
  expects(grid.axes.size() == System::dimensions, "as many axes as the system has dimensions");
  const auto arrays = std::make_shared<const GridArrays<Real>>(grid);
  const std::size_t rows = danger::num_cells(grid) / static_cast<std::size_t>(grid.axes[0].points);
  Flow<Real> flow;
  flow.dimensions = System::dimensions;
  flow.crossings_per_second = kernel.crossings(system, arrays->view(), 0, rows);
  flow.sweep = [system, arrays, sweep = kernel.sweep](const Stage<Real>& stage) {
    return sweep(system, arrays->view(), stage);
  };
  return flow;
}

/// A system with inner loops for the instruction set that the including file is compiled for:
/// `-mavx2 -mfma` makes them about three times as fast as a plain build.
/// @tparam Real  float or double
template <class Real, class System>
[[nodiscard]] Flow<Real> flow_of(const danger::Grid& grid, const System& system,
                                 Differences differences = Differences::weno5) {
  return flow_of(grid, system, kernel_of<Real, xsimd::default_arch, System>(differences));
}

}  // namespace saca::levelset
