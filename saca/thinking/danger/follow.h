#pragma once

#include <functional>

#include "saca/thinking/danger/avoidance.h"
#include "saca/thinking/danger/grid.h"

namespace saca::danger {

/// What the driver does at a state (x, y, course, speed).
using Steering = std::function<Acceleration(const State&)>;

/// By the slopes of a solved value alone: the input that lets it fall fastest. Chatters where the
/// value has a ridge or a kink, and is lost where it is flat.
/// @param gradient  of the value; called by the steering
[[nodiscard]] Steering by_gradient(const Avoidance& system,
                                   std::function<State(const State&)> gradient);

/// By the value itself a moment ahead: of all-out inputs around the circle and none, each held, the
/// one after which the value is least. Sees over ridges that a gradient stands on.
/// @param value   a solved value; called by the steering
/// @param ahead   [s], > 0; about what the car needs from one grid point to the next
/// @param inputs  around the circle, >= 4
[[nodiscard]] Steering by_look_ahead(const Avoidance& system,
                                     std::function<double(const State&)> value, double ahead,
                                     int inputs = 24);

/// The state after an input was held; the course may leave (-pi, pi]. A car that stops on the way
/// stays stopped. While braking the curvature is held, so that the input stays admissible; while
/// driving the acceleration across. Runge-Kutta of fourth order in steps of at most 0.1 s.
/// @param input  is first moved to the nearest limits
[[nodiscard]] State driven(const Avoidance& system, const State& state, Acceleration input,
                           double duration);

/// How finely and how long a path is followed.
struct FollowSettings {
  double reach = 0.0;    ///< of the ego's outermost point from its centre of mass [m], > 0
  double step = 0.0;     ///< for which each input is held [s], > 0
  double longest = 0.0;  ///< [s], > 0
};

struct EvasionPath {
  double highest = 0.0;   ///< intrusion met on the way [m]; h >= 0: the obstacle was hit
  double duration = 0.0;  ///< [s]
  State last{};
  bool is_settled = false;  ///< it stands, or going straight on leads away; else time ran out
};

/// Drives by a steering until nothing can happen any more.
///
/// What comes later does not count once the ego is apart from the obstacle and would only get
/// farther from it by going straight on: the distance of convex shapes that do not turn has one
/// lowest point in time. Likewise at rest, beside an obstacle at rest.
/// @param intrusion  h at a state [m]; falls and rises by at most 1 per metre that the ego's
///                   outermost point makes
[[nodiscard]] EvasionPath follow(const Avoidance& system,
                                 const std::function<double(const State&)>& intrusion,
                                 const Steering& steering, const State& start,
                                 const FollowSettings& settings);

}  // namespace saca::danger
