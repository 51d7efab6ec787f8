#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "saca/base/core/pose.h"
#include "saca/base/core/result.h"
#include "saca/base/world/road.h"
#include "saca/base/world/scene.h"
#include "saca/lab/scenario/perception_model.h"
#include "saca/onboard/drivers/driver.h"

namespace saca::scenario {

/// One instant of a recorded body.
struct Sample {
  double time = 0.0;      ///< [s]
  Pose X_WA;              ///< the ego: at its centre of mass; an actor: at its body's centre
  double speed = 0.0;     ///< along its heading, over ground [m/s], >= 0
  double yaw_rate = 0.0;  ///< measured, of the ego only [rad/s]
};

/// What was recorded of one body; times grow.
using Recording = std::vector<Sample>;

/// What an actor without a recording does.
enum class Behaviour : std::uint8_t {
  hold,               ///< stays where it is
  constant_velocity,  ///< goes on at its speed
  accelerate,         ///< at `acceleration` from `from` on, until it rests or has `until_speed`
  brake,              ///< goes on until `from`, then at -`acceleration` until it rests
  lane_change,        ///< from `from` on, to `to_d` in `takes` or until it rests; see below
  follow,             ///< drives by `law` and reacts to whoever is ahead of it, the ego too
  walk,               ///< goes on until `from`, then does `then`
};

/// What somebody who walks decides to do.
enum class Deed : std::uint8_t { stop, go_on, run };

/// Start and behaviour of an actor without a recording. One that heads along the lane (0 or 180
/// deg) follows it and keeps its d; any other goes straight on.
///
/// A lane change is a quintic in the way made: without jerk at its ends, its body heading along the
/// path; its `speed` is that along the lane. With an `acceleration` it brakes as hard as that from
/// `from` on until it rests.
struct Script {
  world::LanePose start;
  double speed = 0.0;  ///< along its heading [m/s], >= 0
  Behaviour behaviour = Behaviour::constant_velocity;
  double acceleration = 0.0;          ///< [m/s^2]; of `brake`, `lane_change` the deceleration, >= 0
  double from = 0.0;                  ///< when it begins, or decides [s], >= 0
  std::optional<double> until_speed;  ///< of `accelerate` [m/s]
  double to_d = 0.0;                  ///< of `lane_change`: d in the end [m]
  double takes = 0.0;                 ///< likewise: how long [s], > 0
  Deed then = Deed::go_on;            ///< of `walk`, and the rest
  std::optional<double> chance_stop;  ///< if either is given, a draw of chance decides by them;
  std::optional<double> chance_run;   ///< the one that is not given is 0
  double run_speed = 0.0;             ///< [m/s]
  drivers::DriverLaw law{};           ///< of `follow`
};

struct ScenarioActor {
  std::uint8_t id = 1;  ///< unique within its kind, from 1
  world::ActorKind kind = world::ActorKind::car;
  world::Footprint footprint;  ///< about its centre
  double mass = 0.0;           ///< [kg], > 0
  std::variant<Script, Recording> motion;
  bool ghost = false;      ///< is perceived but not there
  double existence = 1.0;  ///< how sure perception is of a ghost, in (0, 1)
};

/// As `world::actor_name`: "car1".
[[nodiscard]] std::string actor_name(const ScenarioActor& actor);

/// Where the ego of a made scenario begins; it then goes on along its lane at constant speed.
struct EgoStart {
  world::LanePose pose;  ///< of its centre of mass
  double speed = 0.0;    ///< [m/s], >= 0
};

/// Where recorded numbers come from: the sample at time t is row first_row + 10 t of the event.
struct Provenance {
  std::int64_t event = 0;
  std::int64_t first_row = 1;  ///< within the event, from 1
  std::int64_t last_row = 1;
};

/// One emergency, as a file tells it: the truth that a simulation plays.
struct Scenario {
  std::string name;  ///< lower-case letters, digits and `_`: also the file's name
  std::string title;
  std::string why;  ///< why this scene matters, in a sentence; may be empty
  std::string source;
  std::string licence;     ///< licence and attribution
  std::string driver;      ///< what the driver did, in words; empty: nobody drove
  std::string notes;       ///< what is assumed, how a recording was treated
  std::string car;         ///< name of the ego's parameter file
  double grip = 0.9;       ///< true friction coefficient [-]
  double duration = 10.0;  ///< how long the scenario may run [s]
  PerceptionModel perception;
  world::Road road;
  std::variant<EgoStart, Recording> ego;
  std::vector<ScenarioActor> actors;
  std::vector<world::Cue> cues;  ///< at most world::max_cues
  std::optional<Provenance> provenance;
};

/// What the ego takes the road's friction coefficient for: what its perception says, else the truth
/// as written.
[[nodiscard]] double believed_grip(const Scenario& scenario);

[[nodiscard]] std::string_view name(Behaviour behaviour);
[[nodiscard]] std::optional<Behaviour> behaviour_from(std::string_view name);
[[nodiscard]] std::string_view name(Deed deed);
[[nodiscard]] std::optional<Deed> deed_from(std::string_view name);

/// Body of the standard car about its centre of mass: 4.7 x 1.9 m, 2.25 m of it ahead.
/// Source: the paper's platform as described in docs/decisions; data/vehicles holds the same.
inline constexpr world::Footprint standard_ego{world::Shape::box, 4.7, 1.9, -0.1};

/// @param source  name for messages, usually the path
/// @param ego     body of the scenario's car, which must not touch an actor at the start
/// @return        Error::Code::malformed or out_of_range, naming source, line, key, wanted and got
[[nodiscard]] Result<Scenario> read_scenario(std::string_view text, std::string_view source,
                                             const world::Footprint& ego = standard_ego);
/// @return  as read_scenario, or Error::Code::unreadable
[[nodiscard]] Result<Scenario> load_scenario(const std::filesystem::path& path,
                                             const world::Footprint& ego = standard_ego);

/// The scenario as a file (TOML, schema saca.scenario/1). What was read comes back bit by bit; an
/// angle that has no decimal in degrees changes by one rounding.
[[nodiscard]] std::string write_scenario(const Scenario& scenario);

}  // namespace saca::scenario
