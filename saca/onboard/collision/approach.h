#pragma once

#include <optional>

#include "saca/base/world/footprint.h"
#include "saca/base/world/track.h"
#include "saca/onboard/collision/swept_boxes.h"

namespace saca::collision {

/// Bodies this near count as touching [m]: so near that a graze, where the distance d falls as
/// a t^2 / 2, is found within sqrt(2 d / a) = 0.1 ms for any bend a > 0.2 m/s^2.
constexpr double touching = 1e-9;

/// A footprint carried along a track, with bounds on how fast it moves. Refers to both.
class Mover {
 public:
  /// @throws ContractViolation  if the track is empty, its step not > 0, or a pose not finite
  Mover(const world::Footprint& footprint, const world::Track& X_WA);

  [[nodiscard]] const world::Footprint& footprint() const { return *footprint_; }
  [[nodiscard]] const world::Track& track() const { return *track_; }
  [[nodiscard]] double reach() const { return reach_; }          ///< bounding radius [m]
  [[nodiscard]] double top_speed() const { return top_speed_; }  ///< of any of its points [m/s]
  /// Time of the first sample after `time`; infinite after the last.
  [[nodiscard]] double next_sample(double time) const;
  [[nodiscard]] const SweptBoxes& boxes() const { return boxes_; }

 private:
  const world::Footprint* footprint_;
  const world::Track* track_;
  double reach_ = 0.0;
  double top_speed_ = 0.0;
  SweptBoxes boxes_;
};

struct Approach {
  std::optional<double> contact;  ///< when they first touch
  double distance = 0.0;          ///< smallest until then, exact to 1 mm, at most `of_interest` [m]
  double nearest_at = 0.0;        ///< when it is, if it is less than `of_interest` [s]
};

/// First contact and smallest distance of two bodies that move and turn.
///
/// @param start, end   where to look; both bodies stand still outside their tracks
/// @param of_interest  larger distances are not told apart [m], >= 0; 0 asks only for contact
///
/// Conservative advancement along straight segments between the samples: the distance can shrink no
/// faster than the bodies approach along the line of shortest distance, plus what turning adds at
/// their reach. Where that would take steps of less than a micrometre of travel, it steps so far
/// and halves the way back. No contact is missed, however thin and fast a body is; at `contact`
/// they are apart by at most `touching`, or by what the clock resolves. Bodies whose bounds
/// (SweptBoxes) stay apart are not looked at more closely. Allocates nothing. Source:
/// Mirtich, Impulse-based dynamic simulation of rigid body systems, 1996, chapter 2.
[[nodiscard]] Approach approach(const Mover& a, const Mover& b, double start, double end,
                                double of_interest);

/// Where and how two bodies touch.
struct Touch {
  Vec2 p_W;  ///< middle of where they touch [m]
  Vec2 n_W;  ///< unit normal, from the first to the second
};

/// The touch of two bodies at or near contact.
///
/// @param depth  [m], > 0: what lies this deep behind the foremost point of each body belongs to
///               where they touch, so that flat faces touch in the middle of their overlap even
///               when they are not quite parallel
///
/// Bodies that overlap are shrunk about their centres until they part.
[[nodiscard]] Touch touch(const world::Footprint& a, const Pose& X_WA, const world::Footprint& b,
                          const Pose& X_WB, double depth);

/// Where a body that comes up against a wall touches it: the middle of what lies within `depth` of
/// its foremost point.
/// @param n_W  unit normal into the wall
/// @return     p_W, on the line through the foremost point across n_W [m]
[[nodiscard]] Vec2 foremost(const world::Footprint& body, const Pose& X_WB, Vec2 n_W, double depth);

}  // namespace saca::collision
