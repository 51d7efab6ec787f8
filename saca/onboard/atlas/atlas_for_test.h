#pragma once

// A small atlas, driven once for all tests of a program.

#include <memory>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/lab/prepare/atlas_build.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"

namespace saca::atlas {

inline AtlasAxes::Axis axis_of(std::initializer_list<double> values) {
  AtlasAxes::Axis axis;
  for (const double value : values) {
    axis.push_back(value);
  }
  return axis;
}

/// One cell of each kind, as wide as those of the default grid: 12 to 13 m/s, grip 0.8 to 0.9; of a
/// stop all strengths.
inline AtlasGrid small_grid() {
  const AtlasAxes::Axis none = axis_of({0.0});
  const AtlasAxes::Axis speeds = axis_of({12.0, 13.0});
  const AtlasAxes::Axis grips = axis_of({0.8, 0.9});
  const AtlasAxes::Axis ways = axis_of({2.75, 3.5});
  return {{{speeds, grips, none, default_atlas_grid()[0].shares},
           {axis_of({10.0, 15.0}), axis_of({0.15, 1.2}), none, none},
           {speeds, grips, ways, none},
           {speeds, grips, ways, axis_of({0.375, 0.5})},
           {speeds, grips, ways, none},
           {speeds, grips, none, none}}};
}

inline const manoeuvre::Car& small_atlas_car() {
  static const manoeuvre::Car car = prepare::default_car();
  return car;
}

inline const std::vector<AtlasNode>& small_nodes() {
  static const prepare::AtlasNodes nodes =
      prepare::build_atlas(small_atlas_car(), small_grid(), 1, {},
                           [](const prepare::AtlasProgress&) { return true; })
          .value();
  return *nodes;
}

inline const Atlas& small_atlas() {
  static const Atlas atlas(small_grid(), small_atlas_car().tuning.domain,
                           std::make_shared<const std::vector<AtlasNode>>(small_nodes()));
  return atlas;
}

/// A straight wide road, the ego straight in its lane.
inline world::Scene atlas_scene(double speed, double grip, double lane_width = 3.2) {
  world::Scene scene;
  scene.ego.v_B = {speed, 0.0};
  scene.ego_footprint = {.length = 4.5, .width = 1.8};
  scene.ego_mass = 1600.0;
  scene.grip = grip;
  scene.road.lane_width = lane_width;
  scene.road.left_edge = 100.0;
  scene.road.right_edge = -100.0;
  return scene;
}

/// The plan of a policy; 3 and 4 brake to a share of the speed.
inline manoeuvre::Plan atlas_plan(manoeuvre::PolicyId policy, double speed, double share = 0.5) {
  return {policy, manoeuvre::brakes_to_speed(policy) ? std::optional(share * speed) : std::nullopt};
}

}  // namespace saca::atlas
