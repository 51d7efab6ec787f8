#include "saca/thinking/danger/value_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saca/base/core/contract.h"

namespace saca::danger {
namespace {

constexpr int most_buckets = 1 << 16;
constexpr int block_side = 4;  // points of a block along each axis: 2 KiB for four axes

}  // namespace

/// A bucket is narrower than any cell: the cell of a coordinate is the one in which its bucket
/// begins, or the next. Thus no logarithm is needed on a stretched axis.
void ValueTable::make_buckets(Ruler& ruler) {
  double most_per_unit = 0.0;
  for (const Ruler::Point& point : ruler.points) {
    most_per_unit = std::max(most_per_unit, point.per_unit);
  }
  const double width = ruler.last - ruler.first;
  const int buckets =
      static_cast<int>(std::min(std::ceil(width * most_per_unit) + 1.0, double{most_buckets}));
  ruler.per_unit = buckets / width;
  std::int32_t cell = 0;
  for (int bucket = 0; bucket <= buckets; ++bucket) {
    const double begin = ruler.first + bucket / ruler.per_unit;
    while (cell < ruler.last_cell &&
           ruler.points[static_cast<std::size_t>(cell) + 1].coordinate <= begin) {
      ++cell;
    }
    ruler.buckets.push_back(cell);
  }
}

ValueTable::Ruler ValueTable::ruler(const Axis& axis) {
  const int cells = axis.edge == Edge::periodic ? axis.points : axis.points - 1;
  Ruler ruler{.edge = axis.edge,
              .turned = axis.turned.value_or(max_dimensions),
              .even = axis.stretch == 0.0,
              .last_cell = cells - 1,
              .first = axis.first,
              .last = axis.last,
              .per_unit = cells / (axis.last - axis.first)};
  for (int i = 0; i <= cells; ++i) {
    const double here = coordinate(axis, i);
    const double next = coordinate(axis, i + 1);
    ruler.points.push_back({.coordinate = here, .per_unit = 1.0 / (next - here), .place = 0});
  }
  if (!ruler.even) {
    make_buckets(ruler);
  }
  return ruler;
}

/// Blocks of 2 points a side, in blocks of 4 a side, one after another: each axis adds its part.
void ValueTable::lay_out() {
  std::size_t block = std::size_t{1} << (2 * dimensions_);
  for (std::size_t d = 0; d < dimensions_; ++d) {
    const auto num_points = static_cast<std::size_t>(grid_.axes[d].points);
    for (std::size_t i = 0; i < rulers_[d].points.size(); ++i) {
      const std::size_t point = i % num_points;  // beyond the seam: the first again
      const std::size_t bits = (point % 2) << d | (point / 2 % 2) << (dimensions_ + d);
      rulers_[d].points[i].place = static_cast<std::uint32_t>(bits + point / block_side * block);
    }
    block *= (num_points + block_side - 1) / block_side;
  }
  expects(block <= std::numeric_limits<std::uint32_t>::max(), "at most 2^32 cells");
  entries_.resize(block);
}

std::size_t ValueTable::memory_needed(const Grid& grid) {
  std::size_t entries = 1;
  for (const Axis& axis : grid.axes) {
    const auto points = static_cast<std::size_t>(axis.points);
    entries *= (points + block_side - 1) / block_side * block_side;
  }
  return entries * sizeof(Entry);
}

ValueTable::ValueTable(const Grid& grid, std::span<const float> values,
                       std::span<const float> errors)
    : grid_(grid), dimensions_(grid.axes.size()) {
  expects(!broken_rule(grid), "the grid breaks no rule");
  expects(values.size() == num_cells(grid), "one value per cell");
  expects(errors.empty() || errors.size() == values.size(), "one error per cell, or none");
  std::transform(grid.axes.begin(), grid.axes.end(), rulers_.begin(), ruler);
  lay_out();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float error = errors.empty() ? 0.0F : errors[i];
    expects(std::isfinite(values[i]), "every value is finite");
    expects(error >= 0.0F && std::isfinite(error), "every error is finite and >= 0");
    const Cell cell = cell_at(grid, i);
    std::size_t at = 0;
    for (std::size_t d = 0; d < dimensions_; ++d) {
      at += rulers_[d].points[static_cast<std::size_t>(cell[d])].place;
    }
    entries_[at] = {values[i], error};
  }
}

/// What lies beyond a mirror, on this side of it.
State ValueTable::turned_over(State state) const noexcept {
  for (std::size_t d = 0; d < dimensions_; ++d) {
    const Ruler& ruler = rulers_[d];
    if (ruler.edge == Edge::mirrored && state[d] < 0.0) {
      state[d] = -state[d];
      if (ruler.turned < dimensions_) {
        state[ruler.turned] = -state[ruler.turned];
      }
    }
  }
  return state;
}

/// Brought between the first and the last coordinate.
double ValueTable::held(const Ruler& ruler, double coordinate, bool& inside) noexcept {
  if (ruler.edge == Edge::periodic) {
    const double period = ruler.last - ruler.first;
    const double beyond = coordinate - ruler.first;
    return beyond >= 0.0 && beyond < period
               ? coordinate
               : ruler.first + (beyond - period * std::floor(beyond / period));
  }
  inside = inside && coordinate >= ruler.first && coordinate <= ruler.last;
  return std::clamp(coordinate, ruler.first, ruler.last);
}

ValueTable::Between ValueTable::between(const Ruler& ruler, double coordinate) noexcept {
  const double along = std::max((coordinate - ruler.first) * ruler.per_unit, 0.0);
  const Ruler::Point* const points = ruler.points.data();
  if (ruler.even) {
    const std::int32_t cell = std::min(static_cast<std::int32_t>(along), ruler.last_cell);
    return {.cell = cell, .share = std::min(along - cell, 1.0)};
  }
  const auto last_bucket = static_cast<std::int32_t>(ruler.buckets.size()) - 1;
  const std::int32_t bucket = std::min(static_cast<std::int32_t>(along), last_bucket);
  std::int32_t cell = ruler.buckets[static_cast<std::size_t>(bucket)];
  while (cell < ruler.last_cell && points[cell + 1].coordinate <= coordinate) {
    ++cell;
  }
  const double share = (coordinate - points[cell].coordinate) * points[cell].per_unit;
  return {.cell = cell, .share = std::clamp(share, 0.0, 1.0)};
}

template <std::size_t dimensions>
LookupResult ValueTable::look(const State& state) const noexcept {
  constexpr std::size_t corners = std::size_t{1} << dimensions;
  std::array<double, dimensions> share;  // NOLINT: set below, as are the others
  std::array<std::uint32_t, corners> at;
  at[0] = 0;
  bool inside = true;
  for (std::size_t d = 0; d < dimensions; ++d) {
    const Ruler& ruler = rulers_[d];
    const Between where = between(ruler, held(ruler, state[d], inside));
    share[d] = where.share;
    const Ruler::Point* const point = ruler.points.data() + where.cell;
    for (std::size_t i = 0; i < std::size_t{1} << d; ++i) {
      at[i + (std::size_t{1} << d)] = at[i] + point[1].place;
      at[i] += point[0].place;
    }
  }
  std::array<float, corners> values;
  float error = 0.0F;
  for (std::size_t i = 0; i < corners; ++i) {
    const Entry& entry = entries_[at[i]];
    values[i] = entry.value;
    error = std::max(error, entry.error);
  }
  std::array<double, corners> blend;
  std::copy(values.begin(), values.end(), blend.begin());
  for (std::size_t d = dimensions; d-- > 0;) {  // the last axis' pairs lie 2^d apart
    const std::size_t half = std::size_t{1} << d;
    for (std::size_t i = 0; i < half; ++i) {
      blend[i] += share[d] * (blend[i + half] - blend[i]);
    }
  }
  return {.value = blend[0], .error = static_cast<double>(error), .inside = inside};
}

LookupResult ValueTable::at(const State& state) const noexcept {
  double sum = 0.0;  // no finite number as soon as an entry is none
  for (std::size_t d = 0; d < dimensions_; ++d) {
    sum += 0.0 * state[d];
  }
  if (!(sum == 0.0)) {
    return {.value = std::numeric_limits<double>::infinity()};
  }
  const State near = turned_over(state);
  switch (dimensions_) {
    case 1:
      return look<1>(near);
    case 2:
      return look<2>(near);
    case 3:
      return look<3>(near);
    default:
      return look<4>(near);
  }
}

double ValueTable::slope(const State& state, std::size_t axis) const noexcept {
  const Ruler& ruler = rulers_[axis];
  const bool mirrored = ruler.edge == Edge::mirrored;
  bool inside = true;
  const double here = held(ruler, mirrored ? std::abs(state[axis]) : state[axis], inside);
  const double half =
      0.5 / ruler.points[static_cast<std::size_t>(between(ruler, here).cell)].per_unit;
  State low = state;
  State high = state;
  low[axis] -= half;
  high[axis] += half;
  if (ruler.edge != Edge::periodic) {
    const double least = mirrored ? -ruler.last : ruler.first;
    low[axis] = std::clamp(low[axis], least, ruler.last - half);
    high[axis] = std::clamp(high[axis], least + half, ruler.last);
  }
  return (at(high).value - at(low).value) / (high[axis] - low[axis]);
}

State ValueTable::gradient(const State& state) const noexcept {
  State slopes{};
  const bool known = std::isfinite(at(state).value);
  for (std::size_t d = 0; d < dimensions_; ++d) {
    slopes[d] = known ? slope(state, d) : std::numeric_limits<double>::quiet_NaN();
  }
  return slopes;
}

}  // namespace saca::danger
