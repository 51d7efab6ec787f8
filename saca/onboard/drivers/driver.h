#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include "saca/base/world/footprint.h"
#include "saca/base/world/road.h"
#include "saca/base/world/scene.h"
#include "saca/base/world/track.h"

namespace saca::drivers {

/// How somebody drives behind others: the Intelligent Driver Model.
/// Source: Treiber, Hennecke, Helbing, Congested traffic states in empirical observations and
/// microscopic simulations, Phys. Rev. E 62 (2000) 1805.
struct DriverLaw {
  double desired_speed = 0.0;  ///< on a free road [m/s], > 0
  double time_gap = 0.0;       ///< to the vehicle ahead [s], >= 0
  double least_gap = 0.0;      ///< at rest [m], > 0
  double acceleration = 0.0;   ///< from rest on a free road [m/s^2], > 0
  double comfortable = 0.0;    ///< size of a deceleration that it likes [m/s^2], > 0
  double hardest = 0.0;        ///< size of the hardest it brakes [m/s^2], > 0; grip may allow less
  double reaction = 0.0;       ///< until it acts on what it sees [s], 0 to `longest_reaction`
};

/// The model's acceleration exponent; the same source.
constexpr double acceleration_exponent = 4.0;
constexpr double longest_reaction = 3.0;  // [s]

/// What is taken for granted of somebody of whom only the speed is known [m/s].
///
/// Time gap, least gap, acceleration and comfortable deceleration: table I of the source above.
/// Reaction: to a lead car's brake lights; Green, How long does it take to stop?, Transportation
/// Human Factors 2 (2000) 195. Assumptions: it would like to drive a fifth faster, 50 km/h at
/// least; it brakes with 8 m/s^2 at most, what a dry road allows less some hesitation.
[[nodiscard]] constexpr DriverLaw usual_driver(double speed) {
  return {.desired_speed = std::max(1.2 * speed, 50.0 / 3.6),
          .time_gap = 1.6,
          .least_gap = 2.0,
          .acceleration = 0.73,
          .comfortable = 1.67,
          .hardest = 8.0,
          .reaction = 1.25};
}

/// The law of a driver who keeps less than the law's gap and is content with it: its time gap and
/// least gap are no more than what makes `gap` its equilibrium. Else it would brake for no reason.
/// @param speed  [m/s], >= 0
/// @param gap    to the vehicle ahead, bumper to bumper [m]
[[nodiscard]] DriverLaw content_with(DriverLaw law, double speed, double gap);

/// What a driver has ahead: the nearest body in its way.
struct Ahead {
  double gap = std::numeric_limits<double>::infinity();  ///< bumper to bumper [m]; <= 0: touching
  double speed = 0.0;                                    ///< along the driver's lane [m/s]
};

/// The model's acceleration of who acts at once on what is ahead [m/s^2]: eq. (3) of the source
/// above. Neither grip nor `hardest` bounds it.
/// @param speed  [m/s], >= 0
[[nodiscard]] double idm_acceleration(const DriverLaw& law, double speed, const Ahead& ahead);

/// One driver along a line: speed and memory of what it saw.
///
/// It knows its own motion now, and the others' as they were `reaction` ago, carried on: the
/// temporal anticipation of Treiber, Kesting, Helbing, Delays, inaccuracies and anticipation in
/// microscopic traffic models, Physica A 360 (2006) 71. There they are carried on at constant
/// speed; here also with the deceleration of then, read off 0.2 s: brake lights tell that it lasts
/// (an assumption). So only what is new comes late. Fixed in size: copied by value, allocates
/// nothing.
class Driver {
 public:
  /// @param speed  [m/s], >= 0
  /// @param grip   friction coefficient of the road [-], > 0
  /// @param step   of `advance` [s]; at least `law.reaction` / 300
  Driver(const DriverLaw& law, double speed, double grip, double step);

  /// Looks, and drives on for one step. It never reverses. Who touches what is ahead has run into
  /// it, and from then on goes no faster than that.
  /// @return  way made [m]
  double advance(const Ahead& ahead);

  [[nodiscard]] double speed() const { return speed_; }
  [[nodiscard]] const DriverLaw& law() const { return law_; }
  /// From now on it drives, and wants to drive, so much faster.
  void speed_up(double factor);

 private:
  struct Look {
    double place = 0.0;           ///< of what was ahead: on the driver's own odometer [m]
    double speed = 0.0;           ///< [m/s]
    std::size_t steps_known = 0;  ///< for which the same body has been ahead
  };
  static constexpr std::size_t longest_delay = 300;  ///< in steps
  static constexpr std::size_t longest_slope = 40;   ///< likewise
  static constexpr std::size_t capacity = longest_delay + longest_slope + 1;

  void look(const Ahead& ahead);

  /// What it takes to be ahead now.
  [[nodiscard]] Ahead remembered() const;

  DriverLaw law_;
  double speed_;
  double grip_;
  double step_;
  std::size_t delay_;  ///< in steps
  std::size_t slope_;  ///< over so many a deceleration is read off
  double way_ = 0.0;   ///< odometer [m]
  std::size_t num_looks_ = 0;
  std::array<Look, capacity> looks_{};
};

/// A body that is there now.
struct Present {
  const world::Footprint* footprint = nullptr;
  Pose X_WA;
  Vec2 v_W;               ///< over ground [m/s]
  world::LanePose place;  ///< of X_WA along the road
};

[[nodiscard]] Present present(const world::Road& road, const world::Footprint& footprint,
                              const Pose& X_WA, Vec2 v_W);

/// A driver with its body in its lane: it follows the lane and keeps its offset and its heading
/// against it. Heading against the lane's direction it is oncoming traffic and does the same.
class LaneDriver {
 public:
  /// @param X_WA  of the body's origin
  LaneDriver(const world::Road& road, const world::Footprint& footprint, const Pose& X_WA,
             const Driver& driver);

  /// What is in its way: of the bodies that reach into the lane it sweeps, ahead of its own
  /// centre, the nearest.
  /// @param skip  index of itself in `others`, if it is one of them
  [[nodiscard]] Ahead ahead(std::span<const Present> others,
                            std::size_t skip = std::numeric_limits<std::size_t>::max()) const;

  /// One step of the driver.
  void advance(const Ahead& ahead);

  /// X_WA, and v_W over ground [m/s].
  [[nodiscard]] Pose pose() const { return world::from_lane(road_, place_); }
  [[nodiscard]] Vec2 velocity() const;
  [[nodiscard]] Driver& driver() { return driver_; }
  [[nodiscard]] const world::Footprint& footprint() const { return footprint_; }

 private:
  world::Road road_;
  world::Footprint footprint_;
  world::LanePose place_;
  double direction_;  ///< 1 along the lane, -1 against it
  Driver driver_;
};

/// Somebody else, all along.
struct Body {
  const world::Footprint* footprint = nullptr;
  const world::Track* track = nullptr;
};

/// When a reacting driver is followed, and on what.
struct ReactionSpan {
  double start = 0.0;     ///< [s]
  double duration = 0.0;  ///< [s], >= 0
  double step = 0.0;      ///< of the track [s], > 0
  double grip = 0.0;      ///< friction coefficient of the road [-], > 0
};

/// The track of one reacting driver along the lane against what is ahead of it. Causal: up to each
/// instant it depends on the others up to that instant only.
///
/// @param driver  as it is at the span's start
/// @param others  tracks that begin at the span's start or before; at most world::max_actors
[[nodiscard]] world::Track reacting_track(const world::Road& road, const world::Actor& driver,
                                          const DriverLaw& law, std::span<const Body> others,
                                          const ReactionSpan& span);
/// The same, written over `track`: allocates nothing where that has room for its poses.
void reacting_track(const world::Road& road, const world::Actor& driver, const DriverLaw& law,
                    std::span<const Body> others, const ReactionSpan& span, world::Track& track);

}  // namespace saca::drivers
