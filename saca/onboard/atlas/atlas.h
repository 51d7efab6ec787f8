#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "saca/base/core/static_vector.h"
#include "saca/base/world/scene.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/onboard/manoeuvre/tuning.h"

namespace saca::atlas {

// The atlas: how the ego moves under each policy, driven once with full physics over a grid, and
// read in microseconds. Everything is seen from the lane's frame where the manoeuvre begins: x
// along, y to the left, straight in the lane at its start. Left only: the right is the mirror.

/// What is tabled apart, because it has its own axes and its own end.
enum class AtlasKind : std::uint8_t {
  stop,           ///< policy 0
  keep,           ///< policy 7
  swerve,         ///< policies 1, 2
  braked_swerve,  ///< policies 3, 4 to a speed that is kept
  swerve_stop,    ///< policies 3, 4 to rest
  drift,          ///< policies 5, 6
};
constexpr std::size_t num_atlas_kinds = 6;
[[nodiscard]] std::string_view name(AtlasKind kind);

/// Does a manoeuvre of this kind end at rest?
constexpr bool ends_at_rest(AtlasKind kind) {
  return kind == AtlasKind::stop || kind == AtlasKind::swerve_stop || kind == AtlasKind::drift;
}

/// Where a kind is tabled: a product of four rising axes, of at least one value each.
struct AtlasAxes {
  using Axis = StaticVector<double, 64>;
  Axis speeds;  ///< at the start [m/s]
  Axis grips;   ///< believed, and true of the middle one of three drives [-]
  Axis ways;    ///< sideways to the middle of the other lane [m]; one value where none is taken
  Axis shares;  ///< target speed over speed; of a stop its strength, in (0, 1] [-]; likewise
  [[nodiscard]] std::size_t num_nodes() const {
    return speeds.size() * grips.size() * ways.size() * shares.size();
  }
};

using AtlasGrid = std::array<AtlasAxes, num_atlas_kinds>;  ///< by AtlasKind
[[nodiscard]] std::size_t num_nodes(const AtlasGrid& grid);

/// What `saca atlas build` tables.
[[nodiscard]] AtlasGrid default_atlas_grid();

constexpr std::size_t atlas_samples = 64;        ///< of a path
constexpr std::size_t sensitivity_samples = 17;  ///< of what wrong grip does to it
constexpr double sensitivity_grip_step =
    0.2;  ///< the two other drives: true grip 20 % off, either way

/// One drive, and two with another true grip: what lies in the file.
///
/// Six channels at equal shares of `span`: x, y [m], heading [rad], and what each gains per sample.
/// Sensitivity to friction: x, y and heading of a drive on less and on more grip, minus those of
/// the middle one, at equal shares of `sensitivity_span`. Numbers are `scale` times the integer.
struct AtlasNode {
  float span = 0.0F;              ///< of the samples; to rest, or past the end [s]
  float end = 0.0F;               ///< at rest, or lane recovered [s]; at most `span`
  float sensitivity_span = 0.0F;  ///< [s]
  std::uint32_t ended = 0;        ///< 1: it came to its end; 0: the horizon came first
  std::array<float, 6> scale{};
  std::array<float, 6> sensitivity_scale{};
  std::array<std::array<std::int16_t, atlas_samples>, 6> path{};
  std::array<std::array<std::int16_t, sensitivity_samples>, 6>
      sensitivity{};  ///< less grip, then more
};
static_assert(sizeof(AtlasNode) == 1036);

/// One future of the ego, between nodes: a value that needs no atlas any more.
struct AtlasPath {
  alignas(32) std::array<std::array<float, atlas_samples>, 6> channel{};
  std::array<std::array<float, sensitivity_samples>, 6> sensitivity{};
  double span = 0.0;              ///< [s]
  double end = 0.0;               ///< [s]
  double sensitivity_span = 0.0;  ///< [s]
  double curvature = 0.0;         ///< of the lane [1/m]
  double start_d = 0.0;           ///< where y = 0 lies in the lane [m]
  bool rests = false;             ///< at its end
  bool ended = false;             ///< false: only the horizon ends it
};

/// Where the ego is on an AtlasPath, along the middle of a lane that may bend.
struct AtlasInstant {
  double x = 0.0;          ///< along the lane's middle from the start [m]
  double y = 0.0;          ///< to the left of the start [m]
  double heading = 0.0;    ///< against the lane [rad]
  double x_rate = 0.0;     ///< [m/s]
  double y_rate = 0.0;     ///< [m/s]
  double turn_rate = 0.0;  ///< of the heading [rad/s]
};

/// @param time  since the start [s]; at rest nothing moves any more, a recovered lane is followed
///              at the offset, heading and speed of the end
[[nodiscard]] AtlasInstant at(const AtlasPath& path, double time) noexcept;

/// How much of the sensitivity to friction of a drive on less (negative) or more grip another grip
/// gives: -1 and 1 at 1 -+ sensitivity_grip_step. Ways and times go with 1 / grip, between the
/// drives and beyond.
/// @param grip_factor  true over believed grip; less than 0.1, the least that is drawn, counts so
[[nodiscard]] double sensitivity_share(double grip_factor) noexcept;

/// What less or more grip than believed does to the ego's place.
struct FrictionSensitivity {
  double x = 0.0;        ///< [m]
  double y = 0.0;        ///< [m]
  double heading = 0.0;  ///< [rad]
};
/// @param grip_factor  true over believed grip
[[nodiscard]] FrictionSensitivity friction_sensitivity_at(const AtlasPath& path, double time,
                                                          double grip_factor) noexcept;

/// Why a manoeuvre cannot be read from the atlas.
enum class AtlasLimit : std::uint8_t {
  no_number,      ///< the scene holds what is no finite number, or the plan no policy
  speed,          ///< outside the grid, or of the drift's domain
  grip,           ///< likewise
  lane_width,     ///< so that the way to the other lane is outside the grid
  target_speed,   ///< outside the grid, or given where there is none
  heading,        ///< too far from the lane's direction
  lateral_speed,  ///< over ground, too large
  yaw_rate,       ///< too far from that of the lane
  acceleration,   ///< the start is too far from even rolling
  offset,         ///< too far from the middle of the lane
  curvature,      ///< the bend takes too much of the grip
  strength,       ///< outside the grid, or given where there is none
};
[[nodiscard]] std::string_view name(AtlasLimit limit);

/// How far a start may be from straight in the lane at even speed. Found by measurement, one at a
/// time at its bound, over speeds of 8 to 25 m/s and grips of 0.4 to 1: the place is then off by at
/// most 0.5 m in 95 of 100 during the first three seconds. docs/formats.md has the table.
struct AtlasBounds {
  double heading = 0.01;           ///< against the lane [rad]
  double lateral_speed = 0.2;      ///< v_B.y [m/s]
  double yaw_rate = 0.1;           ///< beyond that of the bend [rad/s]
  double acceleration = 1.5;       ///< size of a_B, the bend's own left out [m/s^2]
  double offset = 1.0;             ///< from the middle of the lane [m]
  double bend_share = 0.1;         ///< of the grip, taken by the bend [-]
  double hard_bend_share = 0.015;  ///< likewise of 3 to 6, which share the grip out to the last [-]
};

/// Tabled manoeuvres of one car. Cheap to copy; all of it may be read by many threads at once.
class Atlas {
 public:
  /// @param nodes    num_nodes(grid) of them, in the order of the kinds, then speed, grip, way,
  ///                 share, the last running fastest; they stay as long as `keeper`
  /// @param domain   of the car's drift
  /// @throws ContractViolation  if an axis is empty or does not rise, or nodes are missing
  Atlas(const AtlasGrid& grid, const manoeuvre::DriftDomain& domain,
        std::span<const AtlasNode> nodes, std::shared_ptr<const void> keeper);
  Atlas(const AtlasGrid& grid, const manoeuvre::DriftDomain& domain,
        const std::shared_ptr<const std::vector<AtlasNode>>& nodes);

  [[nodiscard]] const AtlasGrid& grid() const noexcept { return grid_; }
  [[nodiscard]] std::span<const AtlasNode> nodes() const noexcept { return nodes_; }
  [[nodiscard]] std::span<const AtlasNode> nodes(AtlasKind kind) const noexcept;

  /// Why this plan cannot be read from here; nullopt: it can. Whatever `refusal` refuses, and all
  /// that lies outside the grid or the bounds. Allocates nothing.
  [[nodiscard]] std::optional<AtlasLimit> outside(const manoeuvre::Plan& plan,
                                                  const world::Scene& scene,
                                                  const AtlasBounds& bounds = {}) const noexcept;

  /// The ego's future under a plan; what lies outside the grid is read at its rim. Ask `outside`
  /// first. Allocates nothing.
  /// @param scene  its ego's speed and offset, its grip, lane width and curvature count; where its
  ///               grip_sd is 0, sensitivity to friction is left out
  ///
  /// Between nodes the eight or sixteen around are averaged at equal shares of their time, so that
  /// what comes to rest does so once and stays. Where the lane bends, the way on a straight one is
  /// laid along it: the same speed over ground, offset and direction against the lane.
  [[nodiscard]] AtlasPath path(const manoeuvre::Plan& plan,
                               const world::Scene& scene) const noexcept;

 private:
  AtlasGrid grid_;
  manoeuvre::DriftDomain domain_;
  std::array<std::size_t, num_atlas_kinds> first_{};
  std::span<const AtlasNode> nodes_;
  std::shared_ptr<const void> keeper_;
};

/// The kind of a plan: 3 and 4 stop where the controller does.
[[nodiscard]] AtlasKind atlas_kind(const manoeuvre::Plan& plan) noexcept;

}  // namespace saca::atlas
