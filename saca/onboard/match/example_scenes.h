#pragma once

#include <random>

#include "saca/base/world/scene.h"

namespace saca::match {

// Scenes that the tests and benchmarks of this module share.

/// A car at 14 m/s on a dry two-lane road, nobody else about.
inline world::Scene empty_road() {
  world::Scene scene;
  scene.ego.v_B = {14.0, 0.0};
  scene.ego_footprint = {.length = 4.7, .width = 1.9, .centre_x = -0.1};
  scene.ego_mass = 1'700.0;
  scene.road.left_edge = 5.25;
  scene.road.oncoming_left = true;
  return scene;
}

inline world::Actor pedestrian(std::uint8_t id, Vec2 p_W) {
  return {.id = id,
          .kind = world::ActorKind::pedestrian,
          .footprint = {.shape = world::Shape::ellipse, .length = 0.6, .width = 0.6},
          .mass = 75.0,
          .X_WA = {p_W, 0.0}};
}

inline world::Actor car(std::uint8_t id, Pose X_WA, double speed) {
  return {.id = id,
          .footprint = {.length = 4.5, .width = 1.8},
          .mass = 1'500.0,
          .X_WA = X_WA,
          .v_W = rotated({speed, 0.0}, X_WA.yaw)};
}

inline world::Actor truck(std::uint8_t id, Pose X_WA, double speed) {
  world::Actor actor = car(id, X_WA, speed);
  actor.kind = world::ActorKind::truck;
  actor.footprint = {.length = 8.0, .width = 2.5};
  actor.mass = 12'000.0;
  return actor;
}

/// A truck crosses from the left at 8 m/s, a pedestrian walks ahead, a car comes up behind.
inline world::Scene crossing_truck() {
  world::Scene scene = empty_road();
  scene.road.topology = world::Topology::intersection;
  scene.actors.push_back(truck(1, {{16.0, 6.4}, -1.5}, 8.0));
  world::Actor walker = pedestrian(1, {22.0, -1.0});
  walker.v_W = {0.0, 1.2};
  scene.actors.push_back(walker);
  scene.actors.push_back(car(1, {{-15.0, 0.1}, 0.0}, 14.5));
  return scene;
}

/// The same encounter somewhere else in the world.
inline world::Scene moved(const world::Scene& scene, const Pose& X_VW) {
  world::Scene result = scene;
  result.ego.X_WB = X_VW * scene.ego.X_WB;
  result.road.X_WL = X_VW * scene.road.X_WL;
  for (world::Actor& actor : result.actors) {
    actor.X_WA = X_VW * actor.X_WA;
    actor.v_W = rotated(actor.v_W, X_VW.yaw);
    actor.a_W = rotated(actor.a_W, X_VW.yaw);
  }
  return result;
}

/// An encounter with `num_actors` around the ego, valid but otherwise at random.
inline world::Scene random_scene(std::mt19937& rng, int num_actors) {
  const auto draw = [&rng](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(rng);
  };
  world::Scene scene = empty_road();
  scene.time = draw(0.0, 60.0);
  scene.ego.X_WB = {{draw(-1.0, 1.0), draw(-0.5, 0.5)}, draw(-0.1, 0.1)};
  scene.ego.v_B = {draw(5.0, 25.0), draw(-0.5, 0.5)};
  scene.ego.yaw_rate = draw(-0.2, 0.2);
  scene.ego.a_B = {draw(-3.0, 1.0), draw(-2.0, 2.0)};
  scene.grip = draw(0.3, 1.0);
  scene.grip_sd = draw(0.0, 0.1);
  scene.road.topology = static_cast<world::Topology>(rng() % 3);
  scene.road.left_beyond = static_cast<world::Beyond>(rng() % 4);
  scene.road.right_beyond = static_cast<world::Beyond>(rng() % 4);
  scene.road.curvature = draw(-0.01, 0.01);
  scene.road.left_edge = draw(1.75, 9.0);
  scene.road.right_edge = -draw(1.75, 9.0);
  for (int i = 0; i < num_actors; ++i) {
    const double yaw = draw(-3.1, 3.1);
    world::Actor actor = car(static_cast<std::uint8_t>(i + 1),
                             {{draw(-30.0, 50.0), draw(-15.0, 15.0)}, yaw}, draw(0.0, 20.0));
    actor.kind = static_cast<world::ActorKind>(rng() % 7);
    actor.a_W = {draw(-4.0, 4.0), draw(-4.0, 4.0)};
    actor.yaw_rate = draw(-0.5, 0.5);
    actor.position_sd = draw(0.0, 0.5);
    actor.velocity_sd = draw(0.0, 0.5);
    actor.existence = draw(0.5, 1.0);
    actor.age = draw(0.0, 0.5);
    actor.occluded = rng() % 4 == 0;
    scene.actors.push_back(actor);
  }
  return moved(scene, {{draw(-500.0, 500.0), draw(-500.0, 500.0)}, draw(-3.1, 3.1)});
}

}  // namespace saca::match
