#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "saca/thinking/danger/grid.h"

namespace saca::danger {

/// A value between the points of a grid.
struct LookupResult {
  double value = 0.0;
  double error = 0.0;   ///< greatest of the cells read; 0 where none are known
  bool inside = false;  ///< within all open ends; else `value` is that of the nearest state inside
};

/// The value of a state, however it is kept.
using ValueAt = std::function<LookupResult(const State&)>;

/// A solved value, made ready to be asked for at any state.
///
/// Multilinear between the 2^axes points around the state: never above or below their values, and
/// continuous. Periodic axes wrap; states beyond the mirror of a mirrored axis are turned over. A
/// state with an entry that is no finite number has the value +infinity and is outside: never safe.
/// Takes 8 bytes per cell.
class ValueTable {
 public:
  /// @param values  at the grid's cells
  /// @param errors  of the values, >= 0, likewise; empty: not known
  /// @throws ContractViolation  if the grid breaks a rule, a size does not fit, a value is no
  /// finite
  ///                            number or an error is none or negative
  ValueTable(const Grid& grid, std::span<const float> values, std::span<const float> errors = {});

  /// Bytes of the values and errors of one.
  [[nodiscard]] static std::size_t memory_needed(const Grid& grid);

  [[nodiscard]] LookupResult at(const State& state) const noexcept;

  /// Change of the value per unit of each coordinate: the difference of the interpolated values
  /// half a spacing to either side; one-sided at an open end. It is the mean slope over one
  /// spacing, thus continuous. NaN where an entry of the state is no finite number.
  [[nodiscard]] State gradient(const State& state) const noexcept;

  [[nodiscard]] const Grid& grid() const { return grid_; }

 private:
  /// One axis, made ready.
  struct Ruler {
    struct Point {
      double coordinate;
      double per_unit;      ///< 1 / distance to the next point
      std::uint32_t place;  ///< the axis' part of where a value is kept
    };
    Edge edge = Edge::open;
    std::size_t turned = max_dimensions;  ///< max_dimensions: none
    bool even = true;
    std::int32_t last_cell = 0;  ///< between points, across the seam too
    double first = 0.0, last = 0.0;
    double per_unit = 0.0;              ///< even: points; else: buckets
    std::vector<Point> points;          ///< one more than cells; beyond the seam: the first again
    std::vector<std::int32_t> buckets;  ///< stretched: the cell in which each bucket begins
  };
  /// Where a state lies along one axis.
  struct Between {
    std::int32_t cell = 0;
    double share = 0.0;  ///< of the higher point
  };
  struct Entry {
    float value, error;
  };

  [[nodiscard]] static Ruler ruler(const Axis& axis);
  static void make_buckets(Ruler& ruler);
  void lay_out();
  [[nodiscard]] static Between between(const Ruler& ruler, double coordinate) noexcept;
  [[nodiscard]] static double held(const Ruler& ruler, double coordinate, bool& inside) noexcept;
  [[nodiscard]] State turned_over(State state) const noexcept;
  [[nodiscard]] double slope(const State& state, std::size_t axis) const noexcept;
  template <std::size_t dimensions>
  [[nodiscard]] LookupResult look(const State& state) const noexcept;

  Grid grid_;
  std::size_t dimensions_ = 0;
  std::array<Ruler, max_dimensions> rulers_;
  std::vector<Entry> entries_;
};

}  // namespace saca::danger
