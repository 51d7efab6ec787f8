// Longer than 400 lines: the C interface is one piece: what is given and told crosses the border
// between the languages here and nowhere else.
#include "saca/onboard/reflex/saca_reflex.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <exception>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/onboard/reflex/encounter.h"
#include "saca/onboard/reflex/intake.h"
#include "saca/onboard/reflex/reflex_plane.h"
#include "saca/onboard/reflex/vehicle_package.h"

namespace {

using saca::Error;
using saca::Pose;
using saca::Vec2;
using saca::reflex::Encounter;
using saca::reflex::Intake;
using saca::reflex::IntakeResult;
using saca::reflex::ReflexPlane;
using saca::reflex::VehiclePackage;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// What another version would have laid out otherwise.
static_assert(SACA_MAX_ACTORS == saca::world::max_actors);
static_assert(SACA_OBSTACLE == static_cast<int>(saca::world::ActorKind::obstacle));
static_assert(SACA_SEGMENT == static_cast<int>(saca::world::Shape::segment));
static_assert(SACA_ONE_WAY == static_cast<int>(saca::world::Topology::one_way));
static_assert(SACA_TREES == static_cast<int>(saca::world::Beyond::trees));
static_assert(SACA_NO_INTERVENTION == static_cast<int>(saca::manoeuvre::PolicyId::no_intervention));
static_assert(sizeof(saca_actor) == 136 && sizeof(saca_road) == 80);
static_assert(sizeof(saca_scene) == 184 + SACA_MAX_ACTORS * sizeof(saca_actor));
static_assert(sizeof(saca_answer) == 80 && sizeof(saca_measured) == 168 &&
              sizeof(saca_command) == 56);

template <class Struct>
Struct begun() {
  Struct one;
  std::memset(&one, 0, sizeof one);
  if constexpr (requires { one.size; }) {
    one.size = sizeof one;
  }
  return one;
}

template <class Struct>
saca_status check(const Struct* given) {
  if (given == nullptr) {
    return SACA_BAD_ARGUMENT;
  }
  if constexpr (requires { given->size; }) {
    if (given->size != sizeof(Struct)) {
      return SACA_OTHER_VERSION;
    }
  }
  if constexpr (requires { given->num_actors; }) {
    if (given->num_actors > SACA_MAX_ACTORS) {
      return SACA_BAD_ARGUMENT;
    }
  }
  return SACA_OK;
}

Vec2 vector_of(const saca_vector& given) {
  return {given.x, given.y};
}
Pose pose_of(const saca_pose& given) {
  return {{given.x, given.y}, given.yaw};
}

/// A number that C wrote as one of an enumeration; beyond its end, NaN takes the actor or the scene
/// out, as any other number that is none.
template <class Enum>
std::optional<Enum> one_of(std::int32_t number, Enum last) {
  return number >= 0 && number <= static_cast<std::int32_t>(last)
             ? std::optional(static_cast<Enum>(number))
             : std::nullopt;
}

std::optional<saca::world::ActorKind> kind_of(const saca_actor& given) {
  return one_of(given.kind, saca::world::ActorKind::obstacle);
}
std::optional<saca::world::Shape> shape_of(const saca_actor& given) {
  return one_of(given.shape, saca::world::Shape::segment);
}
bool has_id(const saca_actor& given) {
  return given.id >= 1 && given.id <= 255;
}
/// Whether its kind, shape and id are such.
bool is_named(const saca_actor& given) {
  return kind_of(given) && shape_of(given) && has_id(given);
}

saca::world::Actor actor_of(const saca_actor& given) {
  saca::world::Actor actor{.id = static_cast<std::uint8_t>(has_id(given) ? given.id : 0),
                           .kind = kind_of(given).value_or(saca::world::ActorKind::car),
                           .footprint = {.shape = shape_of(given).value_or(saca::world::Shape::box),
                                         .length = given.length,
                                         .width = given.width},
                           .mass = is_named(given) ? given.mass : none};
  actor.X_WA = pose_of(given.X_WA);
  actor.v_W = vector_of(given.v_W);
  actor.a_W = vector_of(given.a_W);
  actor.yaw_rate = given.yaw_rate;
  actor.position_sd = given.position_sd;
  actor.velocity_sd = given.velocity_sd;
  actor.existence = given.existence;
  actor.age = given.age;
  actor.occluded = given.is_occluded != 0;
  return actor;
}

std::optional<saca::world::Topology> topology_of(const saca_road& given) {
  return one_of(given.topology, saca::world::Topology::one_way);
}
std::optional<saca::world::Beyond> beyond(std::int32_t given) {
  return one_of(given, saca::world::Beyond::trees);
}
/// Whether its topology and what is beyond its edges are such.
bool is_named(const saca_road& given) {
  return topology_of(given) && beyond(given.left_beyond) && beyond(given.right_beyond);
}

saca::world::Road road_of(const saca_road& given) {
  return {.topology = topology_of(given).value_or(saca::world::Topology::straight),
          .X_WL = pose_of(given.X_WL),
          .curvature = given.curvature,
          .lane_width = is_named(given) ? given.lane_width : none,
          .left_edge = given.left_edge,
          .right_edge = given.right_edge,
          .left_beyond = beyond(given.left_beyond).value_or(saca::world::Beyond::unmarked),
          .right_beyond = beyond(given.right_beyond).value_or(saca::world::Beyond::unmarked),
          .oncoming_left = given.oncoming_left != 0,
          .oncoming_right = given.oncoming_right != 0};
}

saca::world::Scene scene_of(const saca_scene& given, const saca::manoeuvre::Car& car) {
  saca::world::Scene scene;
  scene.time = given.time;
  scene.ego = {.X_WB = pose_of(given.X_WB),
               .v_B = vector_of(given.v_B),
               .yaw_rate = given.yaw_rate,
               .a_B = vector_of(given.a_B)};
  scene.ego_footprint = saca::manoeuvre::footprint(car);
  scene.ego_mass = car.mass;
  scene.road = road_of(given.road);
  scene.grip = given.grip;
  scene.grip_sd = given.grip_sd;
  for (std::size_t i = 0; i < given.num_actors; ++i) {
    scene.actors.push_back(actor_of(given.actors[i]));
  }
  return scene;
}

/// The first rule that a scene breaks, of C's numbers for what has a name, or of what scenes may
/// hold (whatever clock its time is of); empty: none. A literal, so it ends with a zero.
std::string_view rule_broken_by(const saca_scene& given, saca::world::Scene came) {
  const saca_actor* const end = given.actors + given.num_actors;
  if (std::any_of(given.actors, end, [](const saca_actor& actor) { return !is_named(actor); })) {
    return "an actor's kind is 0 to 6, its shape 0 to 2, its id 1 to 255";
  }
  if (!is_named(given.road)) {
    return "the road's topology is 0 to 2, what is beyond its edges 0 to 3";
  }
  if (!(std::abs(came.time) <= Intake::latest)) {
    return "the time is within 1e10 s of 0";
  }
  came.time = 0.0;
  return saca::world::broken_rule(came).value_or("");
}

saca_plan plan_of(const saca::manoeuvre::Plan& plan) {
  auto told = begun<saca_plan>();
  told.policy = static_cast<std::int32_t>(plan.policy);
  told.target_speed = plan.target_speed.value_or(none);
  told.strength = saca::manoeuvre::strength_of(plan);
  return told;
}

saca::vehicle::VehicleState state_of(const saca_measured& given) {
  saca::vehicle::VehicleState state;
  state.X_WB = pose_of(given.X_WB);
  state.v_B = vector_of(given.v_B);
  state.a_B = vector_of(given.a_B);
  state.yaw_rate = given.yaw_rate;
  state.steering = given.steering;
  std::copy(std::begin(given.wheel_speed), std::end(given.wheel_speed), state.wheel_speed.begin());
  std::copy(std::begin(given.brake_torque), std::end(given.brake_torque),
            state.brake_torque.begin());
  state.motor_torque = given.motor_torque;
  state.transfer_a_B = vector_of(given.load_a_B);
  return state;
}

saca::vehicle::Command command_of(const saca_command& given) {
  saca::vehicle::Command command{.steering = given.steering, .motor_torque = given.motor_torque};
  std::copy(std::begin(given.brake_torque), std::end(given.brake_torque),
            command.brake_torque.begin());
  return command;
}

saca_status status_of(Error::Code code) {
  switch (code) {
    case Error::Code::malformed:
      return SACA_MALFORMED;
    case Error::Code::out_of_range:
      return SACA_OTHER_CAR;
    default:
      return SACA_UNREADABLE;
  }
}

void tell(std::string_view text, char* message, std::size_t size) {
  if (message != nullptr && size > 0) {
    const std::size_t length = std::min(text.size(), size - 1);
    std::copy_n(text.data(), length, message);
    message[length] = '\0';
  }
}

/// Works where everything that was given can be used (`usable`: of check). Nothing that C++ throws
/// reaches C.
template <class Work>
saca_status guarded(std::initializer_list<saca_status> usable, const Work& work) noexcept {
  for (const saca_status status : usable) {
    if (status != SACA_OK) {
      return status;
    }
  }
  try {
    return work();
  } catch (const std::exception&) {
    return SACA_FAILED;
  }
}

}  // namespace

struct saca_reflex {
  explicit saca_reflex(VehiclePackage read)
      : package(std::move(read)),
        plane({.car = &package.car,
               .atlas = saca::reflex::AtlasJudge(package.car, package.atlas, package.harm)}),
        encounter(package.car) {}

  saca_status answer(const IntakeResult& taken, saca_answer& told);
  void begin_anew() noexcept {
    plane.begin_anew();
    encounter.begin_anew();
  }

  VehiclePackage package;
  ReflexPlane plane;
  Encounter encounter;
  Intake intake;
  std::string_view broken_rule = "";  // a literal, so it ends with a zero; or nothing
};

struct saca_model {
  const saca::manoeuvre::Car* car;
  saca::vehicle::VehicleState state;
};

saca_status saca_reflex::answer(const IntakeResult& taken, saca_answer& told) {
  told = begun<saca_answer>();
  told.threat_kind = -1;
  told.time_to_conflict = none;
  told.degraded = taken.degraded ? 1 : 0;
  if (taken.usable) {
    const saca::world::Scene& scene = intake.scene();
    if (taken.new_drive) {
      begin_anew();
    }
    const saca::reflex::Reflex reflex = plane.step(scene, encounter.finished());
    const bool is_over = encounter.look(scene, reflex);
    told.triggered = reflex.triggered ? 1 : 0;
    told.switched = reflex.switched ? 1 : 0;
    told.begins = reflex.triggered || reflex.switched ? 1 : 0;
    if (reflex.threat) {
      const saca::world::Actor& actor = scene.actors[reflex.threat->actor];
      told.threatened = 1;
      told.threat_kind = static_cast<std::int32_t>(actor.kind);
      told.threat_id = actor.id;
      told.time_to_conflict = reflex.threat->time;
    }
    if (is_over) {
      told.encounter_is_over = 1;
      begin_anew();
    }
  }
  const auto plan = encounter.plan();
  told.carries_out = plan ? 1 : 0;
  told.plan = plan_of(plan.value_or(saca::manoeuvre::doing_nothing));
  return taken.usable ? SACA_OK : SACA_BAD_SCENE;
}

int32_t saca_reflex_version(void) {
  return SACA_REFLEX_VERSION;
}

const char* saca_status_text(saca_status status) {
  constexpr std::array texts{"all is well",
                             "a null pointer, or a number that the function does not take",
                             "header and library are of different versions, or a struct was not "
                             "begun by its init function",
                             "the file cannot be read",
                             "the file is no vehicle package, or cut short, or altered",
                             "the atlas of the package is of another car or another program",
                             "the scene cannot be used, nor can what is known be carried on",
                             "no memory, or a fault of the library"};
  const auto index = static_cast<std::size_t>(status);
  return status >= 0 && index < texts.size() ? texts[index] : "no status of this library";
}

void saca_actor_init(saca_actor* actor) {
  *actor = begun<saca_actor>();
  actor->id = 1;
  actor->length = 4.5;
  actor->width = 1.8;
  actor->mass = 1'500.0;
  actor->existence = 1.0;
}
void saca_scene_init(saca_scene* scene) {
  *scene = begun<saca_scene>();
  const saca::world::Scene usual;
  scene->grip = usual.grip;
  scene->road.lane_width = usual.road.lane_width;
  scene->road.left_edge = usual.road.left_edge;
  scene->road.right_edge = usual.road.right_edge;
  for (saca_actor& actor : scene->actors) {
    saca_actor_init(&actor);
  }
}
void saca_answer_init(saca_answer* answer) {
  *answer = begun<saca_answer>();
}
void saca_measured_init(saca_measured* measured) {
  *measured = begun<saca_measured>();
}
void saca_command_init(saca_command* command) {
  *command = begun<saca_command>();
}

saca_status saca_reflex_open(const char* path, int32_t version, saca_reflex** reflex, char* message,
                             size_t message_size) {
  tell("", message, message_size);
  if (reflex == nullptr || path == nullptr) {
    return SACA_BAD_ARGUMENT;
  }
  *reflex = nullptr;
  if (version != SACA_REFLEX_VERSION) {
    tell("want version " + std::to_string(SACA_REFLEX_VERSION) + " of saca_reflex.h, got " +
             std::to_string(version),
         message, message_size);
    return SACA_OTHER_VERSION;
  }
  return guarded({}, [&]() -> saca_status {
    auto package = saca::reflex::read_vehicle_package(path);
    if (!package.has_value()) {
      tell(package.error().message, message, message_size);
      return status_of(package.error().code);
    }
    *reflex = new saca_reflex(std::move(package).value());  // NOLINT: C owns it
    return SACA_OK;
  });
}
void saca_reflex_close(saca_reflex* reflex) {
  delete reflex;  // NOLINT: C owned it
}

const char* saca_reflex_car_name(const saca_reflex* reflex) {
  return reflex == nullptr ? "" : reflex->package.name.c_str();
}

saca_status saca_reflex_step(saca_reflex* reflex, const saca_scene* scene, saca_answer* answer) {
  return guarded({check(reflex), check(scene), check(answer)}, [&] {
    const saca::world::Scene came = scene_of(*scene, reflex->package.car);
    reflex->broken_rule = rule_broken_by(*scene, came);
    return reflex->answer(reflex->intake.take(came), *answer);
  });
}

saca_status saca_reflex_miss(saca_reflex* reflex, double time, saca_answer* answer) {
  return guarded({check(reflex), check(answer)},
                 [&] { return reflex->answer(reflex->intake.carry_on(time), *answer); });
}

const char* saca_reflex_broken_rule(const saca_reflex* reflex) {
  return reflex == nullptr ? "" : reflex->broken_rule.data();
}

saca_status saca_reflex_control(saca_reflex* reflex, const saca_measured* measured, double dt,
                                saca_command* command) {
  const bool is_time = dt > 0.0 && std::isfinite(dt);
  return guarded(
      {check(reflex), is_time ? SACA_OK : SACA_BAD_ARGUMENT, check(measured), check(command)},
      [&]() -> saca_status {
        const saca::vehicle::Command wanted = reflex->encounter.control(state_of(*measured), dt);
        command->steering = wanted.steering;
        std::copy(wanted.brake_torque.begin(), wanted.brake_torque.end(),
                  std::begin(command->brake_torque));
        command->motor_torque = wanted.motor_torque;
        return SACA_OK;
      });
}

saca_status saca_reflex_stand_down(saca_reflex* reflex) {
  return guarded({check(reflex)}, [&]() -> saca_status {
    reflex->begin_anew();
    return SACA_OK;
  });
}

saca_status saca_model_open(const saca_reflex* reflex, const saca_scene* scene,
                            saca_model** model) {
  if (reflex == nullptr || model == nullptr) {
    return SACA_BAD_ARGUMENT;
  }
  *model = nullptr;
  return guarded({check(scene)}, [&]() -> saca_status {
    const saca::manoeuvre::Car& car = reflex->package.car;
    const saca::world::Scene begun_in = scene_of(*scene, car);
    if (!rule_broken_by(*scene, begun_in).empty()) {
      return SACA_BAD_SCENE;
    }
    const auto state = saca::manoeuvre::rolling_state(car, begun_in.ego, begun_in.grip);
    *model = new saca_model{&car, state};  // NOLINT: C owns it
    return SACA_OK;
  });
}
void saca_model_close(saca_model* model) {
  delete model;  // NOLINT: C owned it
}

saca_status saca_model_step(saca_model* model, const saca_command* command, double grip,
                            double dt) {
  return guarded({check(model), check(command)}, [&]() -> saca_status {
    try {
      model->state = saca::vehicle::step(*model->car, model->state, command_of(*command), grip, dt);
      return SACA_OK;
    } catch (const saca::ContractViolation&) {
      return SACA_BAD_ARGUMENT;  // no finite number, or out of its range
    }
  });
}

saca_status saca_model_measure(const saca_model* model, saca_measured* measured) {
  return guarded({check(model), check(measured)}, [&]() -> saca_status {
    const saca::vehicle::VehicleState& state = model->state;
    measured->X_WB = {state.X_WB.p.x, state.X_WB.p.y, state.X_WB.yaw};
    measured->v_B = {state.v_B.x, state.v_B.y};
    measured->a_B = {state.a_B.x, state.a_B.y};
    measured->yaw_rate = state.yaw_rate;
    measured->steering = state.steering;
    std::copy(state.wheel_speed.begin(), state.wheel_speed.end(),
              std::begin(measured->wheel_speed));
    std::copy(state.brake_torque.begin(), state.brake_torque.end(),
              std::begin(measured->brake_torque));
    measured->motor_torque = state.motor_torque;
    measured->load_a_B = {state.transfer_a_B.x, state.transfer_a_B.y};
    return SACA_OK;
  });
}
