#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "saca/base/core/pose.h"
#include "saca/base/core/static_vector.h"
#include "saca/base/world/cue.h"
#include "saca/base/world/footprint.h"
#include "saca/base/world/road.h"
#include "saca/base/world/track.h"

namespace saca::world {

enum class ActorKind : std::uint8_t {
  car,
  van,
  truck,
  motorcycle,
  bicycle,
  pedestrian,
  obstacle,  ///< at rest for good: a wreck, a barrier
};

[[nodiscard]] std::string_view name(ActorKind kind);
[[nodiscard]] std::optional<ActorKind> actor_kind_from(std::string_view name);

/// What is known of a vehicle's controls now: by radio, or from its brake lights.
struct SharedControls {
  std::optional<double> steering;  ///< mean angle of the steered road wheels, left positive [rad]
  std::optional<double> throttle;  ///< pedal, 0 to 1
  std::optional<double> brake;     ///< likewise; brake lights: 0 or 1

  bool operator==(const SharedControls&) const = default;
};

/// A road user or obstacle as perceived: nobody has true states.
struct Actor {
  std::uint8_t id = 0;  ///< unique within its kind, from 1; with the kind it makes the name
  ActorKind kind = ActorKind::car;
  Footprint footprint;
  double mass = 0.0;         ///< [kg], > 0; an obstacle's is that of what it is fixed to
  Pose X_WA;                 ///< A at the body's centre
  Vec2 v_W;                  ///< over ground [m/s]
  Vec2 a_W;                  ///< [m/s^2]
  double yaw_rate = 0.0;     ///< [rad/s]
  double position_sd = 0.0;  ///< standard deviation of p_W on each axis [m], >= 0
  double velocity_sd = 0.0;  ///< likewise of v_W [m/s], >= 0
  double existence = 1.0;    ///< probability that it is there at all, in [0, 1]
  double age = 0.0;          ///< since it was last measured [s], >= 0
  bool occluded = false;     ///< not seen now; the state is a prediction
  SharedControls shared;     ///< of most nothing is known

  bool operator==(const Actor&) const = default;
};

/// "car1", "pedestrian2": the only names that reach a prompt.
[[nodiscard]] std::string actor_name(const Actor& actor);

/// @return  the first rule that is broken, in words: finite numbers of what there is on roads;
///          nullopt when the actor can be used
[[nodiscard]] std::optional<std::string_view> broken_rule(const Actor& actor);

/// The ego's own motion, from its sensors.
struct EgoState {
  Pose X_WB;              ///< B at the centre of mass
  Vec2 v_B;               ///< over ground [m/s]
  double yaw_rate = 0.0;  ///< [rad/s]
  Vec2 a_B;               ///< [m/s^2]

  bool operator==(const EgoState&) const = default;
};

constexpr std::size_t max_actors = 32;

/// Everything SACA knows of one instant. Trivially copyable, fixed in size: it crosses between the
/// planes by value.
struct Scene {
  double time = 0.0;  ///< simulated or recorded, within 1e7 s of its start [s]
  EgoState ego;
  Footprint ego_footprint;
  double ego_mass = 0.0;  ///< [kg]
  StaticVector<Actor, max_actors> actors;
  Road road;
  double grip = 0.9;                 ///< best estimate of the friction coefficient [-], in (0, 1.2]
  double grip_sd = 0.0;              ///< its standard deviation [-], >= 0
  StaticVector<Cue, max_cues> cues;  ///< what makes the unseen likelier

  bool operator==(const Scene&) const = default;
};

/// @return  the first rule of a scene that is broken, in words: numbers of what there is on roads,
///          a time that is still exact enough, grip in range, names unique; nullopt when the scene
///          can be used
[[nodiscard]] std::optional<std::string_view> broken_rule(const Scene& scene);

}  // namespace saca::world
