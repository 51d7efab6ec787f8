#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saca/base/world/scene.h"
#include "saca/base/world/track.h"
#include "saca/lab/report/fan_svg.h"
#include "saca/lab/report/picture_frame.h"
#include "saca/lab/report/svg.h"
#include "saca/onboard/collision/outcome.h"
#include "saca/onboard/manoeuvre/plan.h"

namespace saca::report {

/// One manoeuvre in one scene, to be drawn.
struct SceneView {
  std::string title;
  std::vector<std::string> lines;             ///< below the title
  std::string badge;                          ///< short, e.g. "best"; empty: none
  std::optional<manoeuvre::PolicyId> policy;  ///< its colour stands before the title
  world::Scene scene;                         ///< at the decision
  world::Track ego;                           ///< X_WB to its end; no poses: it is not driven
  std::vector<world::Track> others;           ///< X_WA, one per actor of the scene, in its order
  std::vector<collision::Contact> contacts;   ///< in order of time
  std::vector<LikelyWay> fan;                 ///< where somebody was thought to go on
  std::optional<Extent> shown_P;  ///< the ground to show; nullopt: where something happens
};

constexpr SvgSize usual_thumbnail{360.0, 250.0};

/// A plan view with the lane pointing to the right: the road and what stands beyond it, the ego and
/// the others every quarter of a second or so, darker with time, filled where they end; a star
/// where they first touch, a ring with a number where they touch again.
///
/// What lies far from the ego's way is not shown, nor more than `longest_view` m ahead without
/// contact. Turning the world changes nothing but roundings.
/// @throws ContractViolation  if tracks and actors differ in number, a track of the others has no
///                            pose, or the size has no room for a picture
[[nodiscard]] std::string scene_svg(const SceneView& view, SvgSize size = usual_thumbnail);

/// The same without being a document of its own: for sheets, inside `svg_document`.
[[nodiscard]] std::string scene_card(const SceneView& view, SvgSize size);

constexpr double longest_view = 80.0;  ///< [m]

/// What the picture shows if nothing else is asked for: P is the plan turned so that the lane at
/// the ego points along x, its origin on the lane beside the ego [m].
[[nodiscard]] Extent scene_extent(const SceneView& view);

/// Where a point lies in the picture that `scene_svg` draws: for those who draw over it, and tests.
/// @return  from the picture's upper left corner [px]
[[nodiscard]] Vec2 scene_pixel(const SceneView& view, SvgSize size, Vec2 p_W);

}  // namespace saca::report
