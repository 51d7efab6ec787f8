#pragma once

#include <limits>
#include <optional>
#include <span>

#include "saca/base/core/static_vector.h"
#include "saca/base/world/footprint.h"
#include "saca/lab/learned_danger/obstacle.h"
#include "saca/lab/learned_danger/state.h"
#include "saca/onboard/manoeuvre/demand.h"
#include "saca/thinking/danger/avoidance.h"

namespace saca::learned_danger {

/// What a car can do by one input that it holds to the end: go on, drive, brake, or brake while it
/// turns, on arcs. It is the point mass of danger/avoidance.h, its body's axis its course. Tells
/// where the boundary about is, and a way out, without a solved table: V is at most what the best
/// of these leaves.
class ArcEvasions {
 public:
  /// @param limits  of the car (danger::avoidance_of); the state's grip is taken
  /// @param body    of the ego, about its centre of mass
  ArcEvasions(const danger::Avoidance& limits, const world::Footprint& body, const State& state);

  /// Whether h stays at or below a level [m] by one of them, the obstacle going on as it does.
  [[nodiscard]] bool stay_below(double level, const Obstacle& obstacle) const;

  /// Going on if that keeps h at or below a level [m] beside all of them, else braking straight if
  /// that does; nullopt: neither.
  [[nodiscard]] std::optional<manoeuvre::Demand> straight_below(
      double level, std::span<const Obstacle> obstacles) const;

  struct Best {
    manoeuvre::Demand demand;
    double highest = std::numeric_limits<double>::infinity();  ///< h on the way [m]
  };
  /// The one by which the highest h is least.
  [[nodiscard]] Best best(const Obstacle& obstacle) const;

 private:
  struct Arc {
    manoeuvre::Demand demand;
    Obstacle motion;  ///< of the ego
  };
  static constexpr int num_turns = 9;  ///< from all to the left over straight to all to the right

  world::Footprint body_;
  StaticVector<Arc, num_turns + 2> arcs_;
};

}  // namespace saca::learned_danger
