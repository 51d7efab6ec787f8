#pragma once

#include <array>
#include <optional>

#include "saca/manoeuvre/atlas.h"
#include "saca/outcome/blow.h"
#include "saca/world/scene.h"
#include "saca/world/track.h"

namespace saca::outcome {

// The ego on a way out of the atlas, and somebody on a track: when do they meet, how near do they
// come, how likely is it? All of it noexcept, without allocation.

/// Where somebody's centre is during each of equal pieces of time: rectangles along the axes of W.
/// The last piece has no end.
struct Boxes {
  static constexpr std::size_t count = 32;
  static constexpr double piece = 0.4;  ///< [s]
  std::array<Vec2, count> low{};
  std::array<Vec2, count> high{};
};

/// Of a track, from `start` on, a little too large; looks at a pose every fifth of a second.
[[nodiscard]] Boxes boxes_of(const world::Track& track, double start) noexcept;

/// The ego on its way in the world.
class AtlasEgo {
 public:
  /// Refers to path and scene.
  AtlasEgo(const manoeuvre::AtlasPath& path, const world::Scene& scene) noexcept;

  /// @param time  since the scene's [s]
  [[nodiscard]] Instant at(double time) const noexcept;
  /// Displacement of the ego on other grip, in the world; yaw in the Pose's.
  [[nodiscard]] Pose sway(double time, double grip_factor) const noexcept;
  /// Offset and heading in the lane.
  [[nodiscard]] world::LanePose in_lane(double time) const noexcept;

  [[nodiscard]] const manoeuvre::AtlasPath& path() const noexcept { return *path_; }
  [[nodiscard]] const world::Scene& scene() const noexcept { return *scene_; }
  /// How long it is looked at [s]: two seconds beyond a recovered lane; at rest, without end.
  [[nodiscard]] double last_look() const noexcept { return last_look_; }
  [[nodiscard]] const Boxes& boxes() const noexcept { return boxes_; }
  /// The most that the grip's standard deviation moves it, at any time, on any side [m].
  [[nodiscard]] double most_sway() const noexcept { return most_sway_; }

 private:
  void find_boxes() noexcept;
  [[nodiscard]] Vec2 place(double time, double x, double y, std::size_t i) const noexcept;

  const manoeuvre::AtlasPath* path_;
  const world::Scene* scene_;
  world::LanePose start_;
  Vec2 along_;  ///< direction of the lane at X_WL, in W
  double last_look_ = 0.0;
  double most_sway_ = 0.0;
  Boxes boxes_;
};

/// What comes of one pair.
struct Meeting {
  std::optional<double> contact;  ///< at the mean [s since the scene's time]
  double clearance = 0.0;         ///< smallest distance at the mean; 0 with contact [m]
  double probability = 0.0;       ///< that they touch, its existence apart
  double nearest = 0.0;           ///< when contact is likeliest [s]
  double gap = 0.0;               ///< between them then, negative when they overlap [m]
  Vec2 n_W;                       ///< then, from the ego to the other
};

/// @param of_interest  larger clearances are not told apart [m]
///
/// First contact and clearance at the mean: steps that the gap along its own direction allows,
/// but for at least 10 ms: shorter touches may be missed. Probability: at the likeliest instant,
/// normal errors of the actor's place (which grow with its velocity's) and of the ego's under wrong
/// grip against the gap in its direction. It is a lower bound of that over all instants together.
/// @param until        what comes later does not matter [s since the scene's time]
/// @param boxes        of the track, from the scene's time on
[[nodiscard]] Meeting meeting(const AtlasEgo& ego, std::size_t actor, const world::Track& track,
                              const Boxes& boxes, double of_interest, double until) noexcept;

/// The ego and one edge of the road: when it is crossed; `gap` is the room to it. The other is the
/// road.
[[nodiscard]] Meeting edge_meeting(const AtlasEgo& ego, Side side, double of_interest) noexcept;

}  // namespace saca::outcome
