#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace saca::danger {

constexpr std::size_t max_dimensions = 4;

/// What lies beyond the two ends of an axis.
enum class Edge {
  open,      ///< values go on with the last slope, away from zero: no zero level begins there
  periodic,  ///< `last` is `first` again; it has no point of its own
  mirrored,  ///< `first` is 0: what lies beyond is the mirror image; the far end is open
};
/// By which files and messages call them.
constexpr std::array<std::string_view, 3> edge_names{"open", "periodic", "mirrored"};

/// One coordinate of the state space and its points.
struct Axis {
  std::string name;    ///< of files and messages
  double first = 0.0;  ///< coordinate of the first point
  double last = 0.0;   ///< of the last point; periodic: one spacing beyond it
  int points = 0;      ///< at least 4, or as many as the differences reach over
  Edge edge = Edge::open;
  double stretch = 0.0;  ///< 0: even spacing. Else the coordinate is `stretch` x sinh of an evenly
                         ///< spaced number: even within about `stretch` of 0, growing beyond
  std::optional<std::size_t> turned = std::nullopt;  ///< mirrored: the periodic axis whose
                                                     ///< coordinate changes its sign as well
  bool operator==(const Axis&) const = default;
};

/// Points of 1 to 4 axes; a value at each. The first axis' points lie next to one another in
/// memory: cell (i, j, k, l) is number i + n0 (j + n1 (k + n2 l)).
struct Grid {
  std::vector<Axis> axes;
  bool operator==(const Grid&) const = default;
};

/// A cell or a state: as many entries as the grid has axes; the rest is 0.
using Cell = std::array<int, max_dimensions>;
using State = std::array<double, max_dimensions>;

/// What is wrong with it, with the axis, what is wanted and what came; nullopt: nothing is.
[[nodiscard]] std::optional<std::string> broken_rule(const Grid& grid);

[[nodiscard]] std::size_t num_cells(const Grid& grid);
/// Distance in memory between neighbours along each axis.
[[nodiscard]] std::vector<std::size_t> strides(const Grid& grid);
[[nodiscard]] Cell cell_at(const Grid& grid, std::size_t number);
[[nodiscard]] State state_at(const Grid& grid, std::size_t number);
/// "x = 1.5, y = 0, course = 0.26", for messages.
[[nodiscard]] std::string described(const Grid& grid, const State& state);

[[nodiscard]] double coordinate(const Axis& axis, int point);
/// Change of the coordinate from point to point there.
[[nodiscard]] double spacing(const Axis& axis, int point);
/// The inverse of `coordinate`, between the points too; periodic: in [0, points).
[[nodiscard]] double point_of(const Axis& axis, double coordinate);

/// A function's values at all points.
/// @param function    of the state (as many entries as axes); called from several threads
/// @param alike_last  it is the same all along the last axis, and asked at its first point alone;
///                    not of a grid of one axis
template <class Real>
[[nodiscard]] std::vector<Real> sampled(
    const Grid& grid, const std::function<double(std::span<const double>)>& function, int threads,
    bool alike_last = false);

extern template std::vector<float> sampled(const Grid&,
                                           const std::function<double(std::span<const double>)>&,
                                           int, bool);
extern template std::vector<double> sampled(const Grid&,
                                            const std::function<double(std::span<const double>)>&,
                                            int, bool);

}  // namespace saca::danger
