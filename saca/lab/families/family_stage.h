#pragma once

#include <optional>
#include <random>
#include <string_view>

#include "saca/lab/families/family.h"

namespace saca::families {

/// Draws the numbers of a family, in the order in which they are asked for.
class Dice {
 public:
  Dice(const Family& family, std::mt19937_64& rng) : family_(family), rng_(rng) {}

  /// Evenly between the ends of the range `key`.
  [[nodiscard]] double in(std::string_view key);
  /// Does the family have the range `key`?
  [[nodiscard]] bool has(std::string_view key) const;
  /// With the probability drawn from `key`.
  [[nodiscard]] bool happens(std::string_view key) { return even() < in(key); }
  /// +1 for left with the probability drawn from `key`, else -1.
  [[nodiscard]] double side(std::string_view left_share) {
    return happens(left_share) ? 1.0 : -1.0;
  }
  /// In [0, 1).
  [[nodiscard]] double even() { return std::uniform_real_distribution<double>()(rng_); }

 private:
  const Family& family_;
  std::mt19937_64& rng_;
};

/// Keeps its pace along the lane and reacts to whoever is ahead; content with the gap that it has.
[[nodiscard]] scenario::Script reacting(world::LanePose start, double speed, double gap,
                                        double reaction);
/// Along the lane at a constant pace, from `begins` on to another d within `takes`.
[[nodiscard]] scenario::Script changing_lane(world::LanePose start, double speed, double to_d,
                                             double begins, double takes);
/// Braking so that whoever goes straight on at `speed` stops after `room`; at once when less is
/// there than that needs at 7 m/s^2, a hard stop on a dry road.
[[nodiscard]] scenario::Script stopping_after(scenario::Script script, double room);

/// What the twin's first actor does instead; nullopt: it is not there.
using Harmless = std::optional<scenario::Script>;

/// One encounter while it is put together: straight road, the ego's lane along x from its start.
class Stage {
 public:
  /// Before a conflict at which the ego must act [s]: T1 of the paper.
  static constexpr double trigger = 1.3;
  /// How long before its encounter the ego is on its way [s]: longer than T2.
  static constexpr double approach = 6.5;

  /// The road and the ego; `ego_speed_mps` and the road's numbers are drawn.
  Stage(Dice& dice, const world::Footprint& ego, bool junction);

  Dice& dice;
  scenario::Scenario scenario;
  double speed = 0.0;       ///< of the ego [m/s]
  double front = 0.0;       ///< of the ego ahead of its centre of mass [m]
  double rear = 0.0;        ///< of the ego behind it [m]
  double width = 0.0;       ///< of the ego [m]
  bool left_lane = false;   ///< there is one to the left, for traffic
  bool right_lane = false;  ///< likewise to the right
  double decision = 0.0;    ///< about when the ego must act [s]: set by who makes the conflict

  /// Where the ego's front is when the approach is over [m].
  [[nodiscard]] double head() const { return front + speed * approach; }
  [[nodiscard]] double lane() const { return scenario.road.lane_width; }

  /// Moves the edge on a side (+1 left, -1 right) out where it is nearer than that.
  void widen(double side, double room);
  /// A lane beside ours, in our direction.
  void want_lane(double side);

  /// Another body of a usual size; the first one added is what the conflict is about.
  scenario::ScenarioActor& add(world::ActorKind kind, scenario::Script script);
  /// Car, van, truck or motorcycle, as `van_share`, `truck_share` and `motorcycle_share` say.
  [[nodiscard]] world::ActorKind any_vehicle();
  /// Length of a usual body of this kind [m].
  [[nodiscard]] static double length_of(world::ActorKind kind);
  [[nodiscard]] static double width_of(world::ActorKind kind);

  /// Who drives behind, beside and towards the ego, as the surroundings say; call it last.
  void add_surroundings();

 private:
  void add_follower();
  void add_neighbour(double side);
};

}  // namespace saca::families
