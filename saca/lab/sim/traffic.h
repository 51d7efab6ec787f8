#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "saca/base/core/static_vector.h"
#include "saca/base/world/scene.h"
#include "saca/base/world/track.h"
#include "saca/lab/scenario/chance.h"
#include "saca/lab/scenario/scenario.h"
#include "saca/onboard/drivers/driver.h"
#include "saca/onboard/manoeuvre/drive.h"

namespace saca::sim {

/// Everybody of a scenario but the ego, in motion: who has a script or a recording follows it, who
/// follows others reacts. Copyable: a copy goes on by itself. Same scenario, chance and ego: same
/// motion, bit by bit.
class Traffic {
 public:
  static constexpr double step = 0.01;  ///< [s]

  /// The scenario outlives it.
  explicit Traffic(const scenario::Scenario& scenario, const scenario::Chance& chance = {});

  [[nodiscard]] double time() const { return static_cast<double>(num_steps_) * step; }

  /// One step: reacting drivers answer to the ego, and to one another, as they are now.
  void advance(const Pose& X_WB, Vec2 v_W, const world::Footprint& ego);

  /// From now on the ego leaves its recording, so recorded followers of it do too, from when they
  /// are there and in its path on: they drive on as usual drivers, content with the gap that they
  /// have. Everyone else keeps to the recording.
  void let_followers_react() { followers_react_ = true; }

  /// Who is there now, as they truly are, in the scenario's order; ghosts are not. Accelerations
  /// and turning rates are backward differences over 0.5 s, as a tracker would know them; zero
  /// until an actor has been there that long.
  [[nodiscard]] StaticVector<world::Actor, world::max_actors> actors() const;
  /// Likewise those who are perceived but not there, with how sure perception is of them.
  [[nodiscard]] StaticVector<world::Actor, world::max_actors> ghosts() const;

  /// Likewise everybody of the scenario who is no ghost; who is not there yet is where it will
  /// appear.
  [[nodiscard]] StaticVector<world::Actor, world::max_actors> cast() const;

  /// From now on, if the ego moves so: one track per cast(), from now, or from when they appear, to
  /// `until`. Causal: up to each instant they depend on the ego up to that instant only. What
  /// advance() with the same motion does, bit by bit.
  /// @param motion  where it ends the ego stands
  /// @param until   [s]
  [[nodiscard]] std::vector<world::Track> against(const manoeuvre::EgoMotion& motion,
                                                  const world::Footprint& ego, double until) const;

 private:
  static constexpr std::size_t steps_looked_back = 50;  ///< 0.5 s

  struct Motion {
    Pose X_WA;
    Vec2 v_W;  ///< [m/s]
  };
  struct Member {
    Motion now;
    Pose next;  ///< where a script or a recording has it one step later
    double appears = 0.0;
    std::optional<drivers::LaneDriver> driver;
    std::array<Motion, steps_looked_back + 1> seen{};  ///< a ring
    std::size_t num_seen = 0;
  };

  [[nodiscard]] bool is_there(std::size_t actor) const;
  [[nodiscard]] StaticVector<world::Actor, world::max_actors> present(bool ghosts) const;
  [[nodiscard]] world::Actor as_known(std::size_t actor) const;
  /// What each driver has ahead of it; of others nothing.
  [[nodiscard]] std::vector<drivers::Ahead> views(const Pose& X_WB, Vec2 v_W,
                                                  const world::Footprint& ego) const;
  void release_followers(const Pose& X_WB, Vec2 v_W, const world::Footprint& ego);
  /// Makes an actor a reacting driver.
  void appoint(std::size_t actor, const Pose& X_WA, double speed, drivers::DriverLaw law);
  void note(Member& member) const;

  const scenario::Scenario* scenario_;
  scenario::Chance chance_;
  double grip_;
  std::vector<Member> members_;
  bool followers_react_ = false;
  int num_steps_ = 0;
};

}  // namespace saca::sim
