#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "saca/lab/levelset/differences.h"
#include "saca/lab/levelset/flow.h"
#include "saca/lab/levelset/pack.h"

/// The solver's inner loop, for one system and one instruction set; `flow_of.h` makes it callable.
/// It works on plain arrays alone, so that no code shared with others is compiled for that set.
namespace saca::levelset {

/// A grid as the inner loop reads it.
template <class Real>
struct GridView {
  std::size_t dimensions = 0;
  std::array<std::ptrdiff_t, danger::max_dimensions> points{}, stride{};
  std::array<danger::Edge, danger::max_dimensions> edge{};
  std::array<std::ptrdiff_t, danger::max_dimensions> turned{};  ///< -1: none
  /// Of a mirrored axis: point i of the turned one has its image at this - i, around the circle.
  std::array<std::ptrdiff_t, danger::max_dimensions> image_sum{};
  std::array<const double*, danger::max_dimensions> coordinates{};
  const Real* first_coordinates = nullptr;  ///< of the first axis, readable beyond
  std::array<const Real*, danger::max_dimensions>
      per_spacing{};  ///< 1 / spacing; the first readable beyond
};

/// A system's inner loops for one instruction set.
template <class Real, class System>
struct Kernel {
  Swept (*sweep)(const System&, const GridView<Real>&, const Stage<Real>&) = nullptr;
  /// Largest sum of speed / spacing over some rows [1/s].
  double (*crossings)(const System&, const GridView<Real>&, std::size_t first_row,
                      std::size_t end_row) = nullptr;
};

namespace inner {

constexpr std::ptrdiff_t reach = 3;  // neighbours to either side

/// Where a row lies: its cells' indices along all axes but the first, and its number.
template <std::size_t D>
struct Place {
  std::array<std::ptrdiff_t, D> index{};

  template <class Real>
  Place(const GridView<Real>& grid, std::size_t row) {
    auto rest = static_cast<std::ptrdiff_t>(row);
    for (std::size_t d = 1; d < D; ++d) {
      index[d] = rest % grid.points[d];
      rest /= grid.points[d];
    }
  }
  template <class Real>
  [[nodiscard]] std::ptrdiff_t first_cell(const GridView<Real>& grid) const {
    std::ptrdiff_t cell = 0;
    for (std::size_t d = 1; d < D; ++d) {
      cell += index[d] * grid.stride[d];
    }
    return cell;
  }
};

template <class Real>
inline Real going_on(Real edge, Real inner_neighbour, std::ptrdiff_t steps) {
  const Real slope = std::abs(edge - inner_neighbour);
  return edge + static_cast<Real>(steps) * (edge < Real(0) ? -slope : slope);
}

/// The number of a turned axis' point that is the image of point i, behind a mirrored axis.
template <class Real>
inline std::ptrdiff_t image_of(const GridView<Real>& grid, std::size_t mirrored, std::ptrdiff_t i) {
  const std::ptrdiff_t points = grid.points[static_cast<std::size_t>(grid.turned[mirrored])];
  return (grid.image_sum[mirrored] - i + points) % points;
}

/// The row on the other side of a mirrored axis; a turned first axis is not yet turned in it.
template <std::size_t D, class Real>
inline const Real* mirror_image(const GridView<Real>& grid, const Real* values, Place<D> place,
                                std::size_t axis, std::ptrdiff_t index) {
  if (axis > 0) {
    place.index[axis] = index;
  }
  const std::ptrdiff_t turned = grid.turned[axis];
  if (turned > 0) {
    const auto t = static_cast<std::size_t>(turned);
    place.index[t] = image_of(grid, axis, place.index[t]);
  }
  return values + place.first_cell(grid);
}

/// Rows `index - 3` to `index + 3` along an axis other than the first.
template <std::size_t D, class Real>
inline std::array<const Real*, 7> neighbours(const GridView<Real>& grid, const Real* values,
                                             const Place<D>& place, std::size_t axis, Real* scratch,
                                             std::ptrdiff_t scratch_row) {
  const Real* const row = values + place.first_cell(grid);
  const std::ptrdiff_t here = place.index[axis];
  const std::ptrdiff_t points = grid.points[axis];
  const std::ptrdiff_t stride = grid.stride[axis];
  std::array<const Real*, 7> found;
  for (std::ptrdiff_t offset = -reach; offset <= reach; ++offset) {
    const std::ptrdiff_t index = here + offset;
    const Real*& to = found[static_cast<std::size_t>(offset + reach)];
    if (index >= 0 && index < points) {
      to = row + offset * stride;
    } else if (grid.edge[axis] == danger::Edge::periodic) {
      to = row + ((index % points + points) % points - here) * stride;
    } else if (index < 0 && grid.edge[axis] == danger::Edge::mirrored) {
      to = mirror_image<D>(grid, values, place, axis, -index);
      if (grid.turned[axis] == 0) {
        for (std::ptrdiff_t i = 0; i < grid.points[0]; ++i) {
          scratch[i] = to[image_of(grid, axis, i)];
        }
        to = scratch;
        scratch += scratch_row;
      }
    } else {
      const std::ptrdiff_t end = index < 0 ? 0 : points - 1;
      const std::ptrdiff_t beyond = std::abs(index - end);
      const Real* const edge = row + (end - here) * stride;
      const Real* const inner_neighbour = edge + (index < 0 ? stride : -stride);
      for (std::ptrdiff_t i = 0; i < grid.points[0]; ++i) {
        scratch[i] = going_on(edge[i], inner_neighbour[i], beyond);
      }
      to = scratch;
      scratch += scratch_row;
    }
  }
  return found;
}

/// The row itself with three cells beyond either end; returns where its first cell is.
template <std::size_t D, class Real>
inline const Real* padded(const GridView<Real>& grid, const Real* values, const Place<D>& place,
                          Real* scratch) {
  const Real* const row = values + place.first_cell(grid);
  const std::ptrdiff_t n = grid.points[0];
  Real* const first = scratch + reach;
  std::copy(row, row + n, first);
  const Real* const image =
      grid.edge[0] == danger::Edge::mirrored ? mirror_image<D>(grid, values, place, 0, 0) : nullptr;
  for (std::ptrdiff_t k = 1; k <= reach; ++k) {
    if (grid.edge[0] == danger::Edge::periodic) {
      first[-k] = row[n - k];
      first[n - 1 + k] = row[k - 1];
    } else {
      first[-k] = image != nullptr ? image[k] : going_on(row[0], row[1], k);
      first[n - 1 + k] = going_on(row[n - 1], row[n - 2], k);
    }
  }
  return first;
}

template <class Row, class N, std::size_t D>
concept has_upwind = requires(const Row& row, const N& x, const std::array<N, D>& p) {
  row.upwind(x, p, p);
};

template <std::size_t D, class Row>
inline int direction_of(const Row& row, std::size_t axis) {
  if constexpr (requires { row.direction; }) {
    return row.direction[axis];
  } else {
    return 0;
  }
}

/// dV/dtau from both sides' slopes.
template <class N, std::size_t D, class Row>
inline N rate_of(const Row& row, const N& x, const std::array<N, D>& left,
                 const std::array<N, D>& right) {
  if constexpr (has_upwind<Row, N, D>) {
    return row.upwind(x, left, right);
  } else {
    std::array<N, D> middle;
    for (std::size_t d = 0; d < D; ++d) {
      middle[d] = 0.5 * (left[d] + right[d]);
    }
    N rate = row.hamiltonian(x, middle);
    const std::array<N, D> speeds = row.speeds(x);
    for (std::size_t d = 0; d < D; ++d) {
      rate = fma(0.5 * speeds[d], right[d] - left[d], rate);
    }
    return rate;
  }
}

template <class Real, class Arch, Differences differences, class System>
struct Sweep {
  static constexpr std::size_t D = System::dimensions;
  using N = Pack<Real, Arch>;
  using Row = decltype(std::declval<const System&>().row({}));

  const GridView<Real>& grid;
  const Stage<Real>& stage;
  const N dt, keep, take;
  std::array<Steepness<N>, D> steepness;
  N finite = 0.0, greatest_change = 0.0;  // `finite` stays 0 until a value is no number

  Sweep(const GridView<Real>& on, const Stage<Real>& one)
      : grid(on), stage(one), dt(one.dt), keep(one.keep), take(1.0 - one.keep) {
    for (std::size_t d = 0; d < D; ++d) {
      steepness[d] = Steepness<N>(one.steepness[d]);
    }
  }

  /// Everything about a row that its packs share.
  struct Job {
    std::ptrdiff_t cell;  // its first
    Row row;
    std::array<std::array<const Real*, 7>, D> neighbours;
    std::array<Real, D> per_spacing;  // not of the first axis
  };

  [[nodiscard]] Job job_of(const System& system, const Place<D>& place) const {
    std::array<double, D> x{};
    Job job{place.first_cell(grid), {}, {}, {}};
    const auto scratch_row = grid.points[0] + static_cast<std::ptrdiff_t>(readable_beyond);
    Real* scratch = stage.scratch;
    const Real* const first = padded<D>(grid, stage.values, place, scratch);
    for (std::ptrdiff_t k = 0; k < 7; ++k) {
      job.neighbours[0][static_cast<std::size_t>(k)] = first + k - reach;
    }
    scratch += scratch_row;
    for (std::size_t d = 1; d < D; ++d) {
      x[d] = grid.coordinates[d][place.index[d]];
      job.per_spacing[d] = grid.per_spacing[d][place.index[d]];
      job.neighbours[d] = inner::neighbours<D>(grid, stage.values, place, d, scratch, scratch_row);
      scratch += reach * scratch_row;
    }
    job.row = system.row(x);
    return job;
  }

  [[nodiscard]] N rate(const Job& job, std::ptrdiff_t i) const {
    std::array<N, D> left, right;
    for (std::size_t d = 0; d < D; ++d) {
      std::array<N, 7> v;
      for (std::size_t k = 0; k < 7; ++k) {
        v[k] = N::load(job.neighbours[d][k] + i);
      }
      const auto sides = OneSided<differences, N>::of(v, steepness[d]);
      const N scale = d == 0 ? N::load(grid.per_spacing[0] + i) : N(job.per_spacing[d]);
      const int direction = direction_of<D>(job.row, d);
      left[d] = (direction > 0 ? sides.right : sides.left) * scale;
      right[d] = (direction < 0 ? sides.left : sides.right) * scale;
    }
    return rate_of<N, D>(job.row, N::load(grid.first_coordinates + i), left, right);
  }

  void pack(const Job& job, std::ptrdiff_t i) {
    const std::ptrdiff_t cell = job.cell + i;
    N change = rate(job, i);
    // The maximum of some sets passes over what is no number, and -infinity is below any: taking
    // x - x away, which is 0 of every other x, keeps both.
    if (stage.tube == Tube::tube) {
      change = max(N(0.0), change) - (change - change);
    }
    const N old = N::load(stage.old + cell);
    const N values = N::load(stage.values + cell);
    N next = fma(change, dt, values);
    if (stage.keep > 0.0) {
      next = fma(old, keep, next * take);
    }
    if (stage.tube == Tube::highest) {
      next = max(N::load(stage.h + cell), next) - (next - next);
    }
    const std::ptrdiff_t left = grid.points[0] - i;
    if (left < static_cast<std::ptrdiff_t>(N::size)) {
      std::array<Real, N::size> part;
      next.store(part.data());
      std::copy(part.begin(), part.begin() + left, stage.out + cell);
      std::fill(part.begin() + left, part.end(), Real(0));
      std::array<Real, N::size> old_part{};
      std::copy(stage.old + cell, stage.old + cell + left, old_part.begin());
      note(N::load(part.data()), N::load(old_part.data()));
      return;
    }
    next.store(stage.out + cell);
    note(next, old);
  }

  void note(const N& next, const N& old) {
    finite = finite + (next - next);
    greatest_change = max(greatest_change, abs(next - old));
  }

  [[nodiscard]] Swept result() const {
    std::array<Real, N::size> lanes;
    finite.store(lanes.data());
    const bool broken =
        std::any_of(lanes.begin(), lanes.end(), [](Real x) { return x != Real(0); });
    greatest_change.store(lanes.data());
    Swept swept;
    swept.greatest_change = static_cast<double>(*std::max_element(lanes.begin(), lanes.end()));
    if (broken) {
      const std::size_t n = static_cast<std::size_t>(grid.points[0]);
      for (std::size_t i = stage.first_row * n; i < stage.end_row * n && !swept.broken_cell; ++i) {
        if (!(std::abs(stage.out[i]) <= std::numeric_limits<Real>::max())) {
          swept.broken_cell = i;
        }
      }
    }
    return swept;
  }
};

template <class Real, class Arch, Differences differences, class System>
inline Swept sweep(const System& system, const GridView<Real>& grid, const Stage<Real>& stage) {
  Sweep<Real, Arch, differences, System> work(grid, stage);
  for (std::size_t r = stage.first_row; r < stage.end_row; ++r) {
    const auto job = work.job_of(system, Place<System::dimensions>(grid, r));
    for (std::ptrdiff_t i = 0; i < grid.points[0];
         i += static_cast<std::ptrdiff_t>(Pack<Real, Arch>::size)) {
      work.pack(job, i);
    }
  }
  return work.result();
}

template <class Real, class Arch, class System>
inline double crossings(const System& system, const GridView<Real>& grid, std::size_t first_row,
                        std::size_t end_row) {
  constexpr std::size_t D = System::dimensions;
  using N = Pack<Real, Arch>;
  double greatest = 0.0;
  for (std::size_t r = first_row; r < end_row; ++r) {
    const Place<D> place(grid, r);
    std::array<double, D> x{};
    for (std::size_t d = 1; d < D; ++d) {
      x[d] = grid.coordinates[d][place.index[d]];
    }
    const auto row = system.row(x);
    for (std::ptrdiff_t i = 0; i < grid.points[0]; i += static_cast<std::ptrdiff_t>(N::size)) {
      const std::array<N, D> speeds = row.speeds(N::load(grid.first_coordinates + i));
      N sum = speeds[0] * N::load(grid.per_spacing[0] + i);
      for (std::size_t d = 1; d < D; ++d) {
        sum = fma(speeds[d], N(static_cast<double>(grid.per_spacing[d][place.index[d]])), sum);
      }
      std::array<Real, N::size> lanes;
      sum.store(lanes.data());
      const std::ptrdiff_t used =
          std::min<std::ptrdiff_t>(grid.points[0] - i, static_cast<std::ptrdiff_t>(N::size));
      for (std::ptrdiff_t k = 0; k < used; ++k) {
        const auto value = static_cast<double>(lanes[static_cast<std::size_t>(k)]);
        if (!std::isnan(greatest) && !(value <= greatest)) {
          greatest = value;  // what is no number stays and is found
        }
      }
    }
  }
  return greatest;
}

}  // namespace inner

/// The loops for an instruction set: one of xsimd's, and the file is compiled for it.
template <class Real, class Arch, class System>
[[nodiscard]] Kernel<Real, System> kernel_of(Differences differences) {
  constexpr auto crossings = &inner::crossings<Real, Arch, System>;
  switch (differences) {
    case Differences::upwind1:
      return {&inner::sweep<Real, Arch, Differences::upwind1, System>, crossings};
    case Differences::eno2:
      return {&inner::sweep<Real, Arch, Differences::eno2, System>, crossings};
    case Differences::eno3:
      return {&inner::sweep<Real, Arch, Differences::eno3, System>, crossings};
    case Differences::weno5:
      break;
  }
  return {&inner::sweep<Real, Arch, Differences::weno5, System>, crossings};
}

}  // namespace saca::levelset
