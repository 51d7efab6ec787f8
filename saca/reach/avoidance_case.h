#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/core/result.h"
#include "saca/reach/avoidance.h"
#include "saca/reach/grid.h"
#include "saca/world/footprint.h"

namespace saca::reach {

/// One avoidance problem as it stands in a file of `data/reach/`.
struct AvoidanceCase {
  std::string name;
  Avoidance system;
  world::Footprint ego;  ///< about the centre of mass
  /// At the origin, its length along x. nullopt: all ground with y >= 0, beyond a road's left edge;
  /// then x does not matter and the state is y, course, speed (`EdgeAvoidance`).
  std::optional<world::Footprint> obstacle;
  /// x, y, course, speed, or the last three. Beside an obstacle y is mirrored, for left and right
  /// are alike, and turns course.
  Grid grid;
  double horizon = 0.0;           ///< [s], > 0
  std::vector<double> snapshots;  ///< [s], rising, in (0, horizon]
};

/// @return  Error::Code::unreadable, or ::malformed naming file, line and what is wanted
[[nodiscard]] Result<AvoidanceCase> read_avoidance_case(const std::filesystem::path& path);
/// @param source  name for messages
[[nodiscard]] Result<AvoidanceCase> parse_avoidance_case(std::string_view text,
                                                         std::string_view source);

/// h: how deep the ego stands in the obstacle, or beyond the edge [m].
/// @param state  of the case's grid
[[nodiscard]] double intrusion_at(const AvoidanceCase& problem, const State& state);

/// h at all cells of the case's grid.
/// @tparam Real  float or double
template <class Real>
[[nodiscard]] std::vector<Real> unsafe(const AvoidanceCase& problem, int threads);

extern template std::vector<float> unsafe(const AvoidanceCase&, int);
extern template std::vector<double> unsafe(const AvoidanceCase&, int);

}  // namespace saca::reach
