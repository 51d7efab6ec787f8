#include "saca/lab/sim/perception.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/lab/sim/line_of_sight.h"

namespace saca::sim {
namespace {

using world::Actor;
using world::Scene;

constexpr double error_smoothing = 0.5;  // [s], as of the accelerations in a true scene (Stepper)

// How an actor may accelerate without our knowing: normal driving stays within about 2 m/s^2 (the
// comfortable deceleration of Treiber, Hennecke, Helbing 2000 is 1.67). An assumption.
constexpr double unknown_acceleration = 2.0;

bool is_amount(double number) {
  return number >= 0.0 && std::isfinite(number);
}

void check_model(const scenario::PerceptionModel& model) {
  expects(is_amount(model.position_sd), "position_sd >= 0");
  expects(is_amount(model.velocity_sd), "velocity_sd >= 0");
  expects(is_amount(model.heading_sd), "heading_sd >= 0");
  expects(is_amount(model.correlation_time), "correlation_time >= 0");
  expects(model.latency >= 0.0 && model.latency <= Perception::most_latency, "latency in [0, 2]");
  expects(model.dropout >= 0.0 && model.dropout <= 1.0, "dropout in [0, 1]");
  expects(model.range > 0.0, "range > 0");
  expects(is_amount(model.confirmation), "confirmation >= 0");
  expects(is_amount(model.memory), "memory >= 0");
  const double grip = model.grip_believed.value_or(1.0);
  expects(grip > 0.0 && grip <= 1.2, "grip_believed in (0, 1.2]");
  expects(is_amount(model.grip_sd), "grip_sd >= 0");
}

// Steele, Lea, Flood, Fast splittable pseudorandom number generators, 2014: seeds side by side give
// words that have nothing in common. (std::seed_seq allocates.)
std::uint64_t mixed(std::uint64_t word) {
  word += 0x9e3779b97f4a7c15U;
  word = (word ^ (word >> 30U)) * 0xbf58476d1ce4e5b9U;
  word = (word ^ (word >> 27U)) * 0x94d049bb133111ebU;
  return word ^ (word >> 31U);
}

/// At constant speed and turning rate for `time` [s]: the velocity turns with the body.
Actor carried_on(Actor actor, double time) {
  const double turned = actor.yaw_rate * time;
  const double half = 0.5 * turned;
  const double chord = std::abs(half) < 1e-4 ? 1.0 - half * half / 6.0 : std::sin(half) / half;
  actor.X_WA.p = actor.X_WA.p + (time * chord) * rotated(actor.v_W, half);
  actor.X_WA.yaw = wrap_angle(actor.X_WA.yaw + turned);
  actor.v_W = rotated(actor.v_W, turned);
  actor.a_W = rotated(actor.a_W, turned);
  return actor;
}

}  // namespace

Perception::Perception(const scenario::PerceptionModel& model, std::uint64_t seed)
    : model_(model), seed_(seed) {
  check_model(model);
  if (model.correlation_time > 0.0) {
    kept_ = std::exp(-step / model.correlation_time);
  }
  snapshots_.resize(1 + static_cast<std::size_t>(std::lround(model.latency / step)));
  if (model != scenario::PerceptionModel{}) {
    beliefs_.resize(world::max_actors);
  }
}

Scene Perception::look(const Scene& truth, std::span<const Actor> ghosts) {
  store(truth, ghosts);
  const Snapshot& snapshot = measured_now();
  if (model_ == scenario::PerceptionModel{}) {
    return snapshot.scene;
  }
  Scene scene = truth;
  scene.actors.clear();
  scene.grip = model_.grip_believed.value_or(truth.grip);
  scene.grip_sd = model_.grip_sd;
  const auto tell = [&](const Belief& belief) {
    if (belief.certainty > 0.0) {
      scene.actors.push_back(as_known(belief, truth.time));
    }
  };
  for (const Actor& actor : snapshot.scene.actors) {
    Belief& belief = belief_of(actor);
    update(belief, snapshot, actor);
    tell(belief);
  }
  for (Belief& belief : begun_beliefs()) {
    if (belief.num_looks != num_looks_) {
      miss(belief);
      tell(belief);
    }
  }
  return scene;
}

void Perception::store(const Scene& truth, std::span<const Actor> ghosts) {
  if (num_looks_ > 0) {
    const double last = snapshots_[(num_looks_ - 1) % snapshots_.size()].scene.time;
    expects(std::abs(truth.time - last - step) < 1e-6, "looks are one step apart");
  }
  Snapshot& snapshot = snapshots_[num_looks_ % snapshots_.size()];
  snapshot = {truth, truth.actors.size()};
  for (const Actor& ghost : ghosts) {
    snapshot.scene.actors.push_back(ghost);
  }
  expects(!world::broken_rule(snapshot.scene), "truth and ghosts make a scene");
  ++num_looks_;
}

const Perception::Snapshot& Perception::measured_now() const {
  const bool full = num_looks_ >= snapshots_.size();
  return snapshots_[full ? num_looks_ % snapshots_.size() : 0];
}

Perception::Belief& Perception::belief_of(const Actor& actor) {
  const std::span<Belief> begun = begun_beliefs();
  const auto found = std::find_if(begun.begin(), begun.end(), [&](const Belief& belief) {
    return belief.kind == actor.kind && belief.id == actor.id;
  });
  if (found != begun.end()) {
    return *found;
  }
  Belief& belief = free_place();
  belief = {.id = actor.id, .kind = actor.kind};
  const std::uint64_t name = (static_cast<std::uint64_t>(actor.kind) << 8U) | actor.id;
  belief.rng.seed(mixed(seed_ ^ mixed(name)));
  belief.errors = draw(belief);
  belief.smoothed = belief.errors;
  return belief;
}

// Who left the truth longest ago makes room. There is one: a moment has no more actors than places.
Perception::Belief& Perception::free_place() {
  if (num_beliefs_ < beliefs_.size()) {
    return beliefs_[num_beliefs_++];
  }
  const auto& actors = measured_now().scene.actors;
  const auto is_there = [&](const Belief& belief) {
    return std::any_of(actors.begin(), actors.end(), [&](const Actor& actor) {
      return belief.kind == actor.kind && belief.id == actor.id;
    });
  };
  Belief* longest_gone = nullptr;
  for (Belief& belief : beliefs_) {
    if (!is_there(belief) &&
        (longest_gone == nullptr || belief.num_looks < longest_gone->num_looks)) {
      longest_gone = &belief;
    }
  }
  return *longest_gone;
}

// The same numbers are drawn at every look, seen or not: an actor's errors are its own.
void Perception::update(Belief& belief, const Snapshot& snapshot, const Actor& actor) const {
  if (belief.num_looks > 0) {
    wander(belief);
  }
  belief.num_looks = num_looks_;
  const bool dropped = std::uniform_real_distribution<double>()(belief.rng) < model_.dropout;
  if (!dropped && within_view(snapshot, actor)) {
    measure(belief, actor, snapshot.scene.time);
  } else {
    miss(belief);
  }
}

Perception::Errors Perception::draw(Belief& belief) const {
  const auto normal = [&](double sd) { return sd * belief.normal(belief.rng); };
  return {.p_W = {normal(model_.position_sd), normal(model_.position_sd)},
          .v_W = {normal(model_.velocity_sd), normal(model_.velocity_sd)},
          .heading = normal(model_.heading_sd)};
}

void Perception::wander(Belief& belief) const {
  const double fresh = std::sqrt(1.0 - kept_ * kept_);
  const Errors drawn = draw(belief);
  Errors& errors = belief.errors;
  errors.p_W = kept_ * errors.p_W + fresh * drawn.p_W;
  errors.v_W = kept_ * errors.v_W + fresh * drawn.v_W;
  errors.heading = kept_ * errors.heading + fresh * drawn.heading;
  const double share = -std::expm1(-step / error_smoothing);
  Errors& smoothed = belief.smoothed;
  smoothed.v_W = smoothed.v_W + share * (errors.v_W - smoothed.v_W);
  smoothed.heading += share * (errors.heading - smoothed.heading);
}

bool Perception::within_view(const Snapshot& snapshot, const Actor& actor) const {
  const Scene& scene = snapshot.scene;
  if (!(norm(actor.X_WA.p - scene.ego.X_WB.p) <= model_.range)) {
    return false;
  }
  return !model_.occlusion || in_sight(scene.ego.X_WB, scene.ego_footprint, actor,
                                       {scene.actors.begin(), snapshot.num_real});
}

void Perception::measure(Belief& belief, const Actor& actor, double time) const {
  constexpr double rate = 1.0 / error_smoothing;
  const Errors& errors = belief.errors;
  belief.last = actor;
  belief.last.X_WA.p = actor.X_WA.p + errors.p_W;
  belief.last.X_WA.yaw = wrap_angle(actor.X_WA.yaw + errors.heading);
  belief.last.v_W = actor.v_W + errors.v_W;
  belief.last.a_W = actor.a_W + rate * (errors.v_W - belief.smoothed.v_W);
  belief.last.yaw_rate = actor.yaw_rate + rate * (errors.heading - belief.smoothed.heading);
  belief.measured = time;
  const double surer = model_.confirmation > step ? step / model_.confirmation : 1.0;
  belief.certainty = std::min(1.0, belief.certainty + surer);
  belief.at_best = belief.certainty;
  belief.num_missed = 0;
}

void Perception::miss(Belief& belief) const {
  ++belief.num_missed;
  const double left = model_.memory - step * static_cast<double>(belief.num_missed);
  belief.certainty = left > 1e-9 ? belief.at_best * left / model_.memory : 0.0;
}

Actor Perception::as_known(const Belief& belief, double time) const {
  const double age = time - belief.measured;
  const double unknown =
      belief.kind == world::ActorKind::obstacle ? 0.0 : age * unknown_acceleration;
  Actor actor = carried_on(belief.last, age);
  actor.position_sd = std::hypot(model_.position_sd, age * model_.velocity_sd, 0.5 * age * unknown);
  actor.velocity_sd = std::hypot(model_.velocity_sd, unknown);
  actor.existence = belief.certainty * belief.last.existence;
  actor.age = age;
  actor.occluded = belief.num_missed > 0;
  return actor;
}

}  // namespace saca::sim
