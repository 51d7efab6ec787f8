#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/base/world/footprint.h"
#include "saca/thinking/danger/avoidance.h"
#include "saca/thinking/danger/grid.h"

namespace saca::danger {

/// The coordinates in which a case is solved, and what its grid's axes are.
enum class View : std::uint8_t {
  obstacle,  ///< x, y, course, speed: `Avoidance`; y is mirrored and turns course
  ego,       ///< ahead, left, turned, speed: `AvoidanceAhead`; left is mirrored and turns turned
  edge,      ///< y, course, speed: `EdgeAvoidance`, beside a road edge alone
};

/// The fastest obstacle that a case may hold, either way [m/s].
constexpr double fastest_obstacle = 60.0;

/// One avoidance problem as it stands in a file of `data/reach/`.
struct AvoidanceCase {
  std::string name;
  std::string text;  ///< the file's
  View view = View::obstacle;
  Avoidance system;
  world::Footprint ego;  ///< about the centre of mass
  /// At the origin, its length along x. nullopt: all ground with y >= 0, beyond a road's left edge.
  std::optional<world::Footprint> obstacle;
  Grid grid;
  std::vector<double> times;  ///< of the snapshots [s], > 0, rising; the last is the horizon
};

/// @return  Error::Code::unreadable, or ::malformed naming file, line and what is wanted
[[nodiscard]] Result<AvoidanceCase> read_avoidance_case(const std::filesystem::path& path);
/// @param source  name for messages
[[nodiscard]] Result<AvoidanceCase> parse_avoidance_case(std::string_view text,
                                                         std::string_view source);

/// Coordinates of the case's grid for x, y, course and speed in the obstacle's frame.
[[nodiscard]] State grid_state(View view, const State& state);

/// h: how deep the ego stands in the obstacle, or beyond the edge [m].
/// @param state  of the case's grid
[[nodiscard]] double intrusion_at(const AvoidanceCase& problem, const State& state);

/// h at all cells of the case's grid.
/// @tparam Real  float or double
template <class Real>
[[nodiscard]] std::vector<Real> unsafe(const AvoidanceCase& problem, int threads);

extern template std::vector<float> unsafe(const AvoidanceCase&, int);
extern template std::vector<double> unsafe(const AvoidanceCase&, int);

}  // namespace saca::danger
