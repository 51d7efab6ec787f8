#pragma once

// Encounters by construction, for the tests and the benchmark of this module.

#include <cmath>
#include <vector>

#include "saca/lab/prepare/harm_file.h"
#include "saca/thinking/rollout/collision_sequence.h"
#include "tests/support/scenes.h"

namespace saca::rollout {

inline collision::HarmModel shipped_harm() {
  return prepare::read_harm("data/harm.toml").value();
}

/// A wide road, so that edges do not matter unless a test narrows it.
inline world::Scene empty_scene() {
  world::Scene scene = test::ego_at(0.0);
  scene.road.left_edge = 200.0;
  scene.road.right_edge = -200.0;
  return scene;
}

/// A body that keeps its velocity and turning rate.
inline world::Track steady(Pose X_WA, Vec2 v_W, double yaw_rate, double duration) {
  world::Track track;
  const int num_steps = static_cast<int>(std::lround(duration / track.step));
  for (int k = 0; k <= num_steps; ++k) {
    const double t = k * track.step;
    track.X_WA.push_back({X_WA.p + t * v_W, wrap_angle(X_WA.yaw + t * yaw_rate)});
  }
  return track;
}

inline manoeuvre::EgoMotion steady_ego(Pose X_WB, Vec2 v_W, double yaw_rate, double duration) {
  manoeuvre::EgoMotion motion;
  motion.track = steady(X_WB, v_W, yaw_rate, duration);
  for (const Pose& pose : motion.track.X_WA) {
    motion.v_B.push_back(rotated(v_W, -pose.yaw));
    motion.yaw_rate.push_back(yaw_rate);
  }
  return motion;
}

/// An encounter to be judged.
struct Encounter {
  world::Scene scene = empty_scene();
  manoeuvre::EgoMotion motion;
  std::vector<world::Track> tracks;

  /// How an actor moves from the scene's time on.
  struct SteadyMotion {
    Pose X_WA;
    Vec2 v_W;
    double yaw_rate = 0.0;
    double duration = 5.0;
  };
  void add(world::ActorKind kind, world::Footprint footprint, double mass,
           const SteadyMotion& moves) {
    world::Actor actor = test::car(0, moves.X_WA.p, moves.v_W, {}, footprint);
    actor.kind = kind;
    actor.mass = mass;
    actor.X_WA = moves.X_WA;
    scene.actors.push_back(actor);
    tracks.push_back(steady(moves.X_WA, moves.v_W, moves.yaw_rate, moves.duration));
  }
  void add_car(Pose X_WA, Vec2 v_W, double yaw_rate = 0.0) {
    add(world::ActorKind::car, test::ego_body, 1700.0, {X_WA, v_W, yaw_rate});
  }
  /// The others on their tracks, whatever the ego does.
  [[nodiscard]] CollisionSequence sequence(const collision::HarmModel& harm) const {
    return collision_sequence(
        motion, scene, [this](const manoeuvre::EgoMotion&) { return tracks; }, harm);
  }
  [[nodiscard]] collision::Outcome judged(const collision::HarmModel& harm) const {
    return judge(motion, scene, tracks, harm);
  }
};

}  // namespace saca::rollout
