#pragma once

#include "saca/lab/scenario/scenario.h"

namespace saca::encounter {

/// A car at 20 m/s on a straight wet road, and a wreck in its lane: braking at T1 is not enough.
/// @param distance  of the wreck's centre ahead of the centre of mass [m]
inline scenario::Scenario wreck_on_wet_road(double distance = 90.0, double duration = 12.0) {
  scenario::Scenario scenario{.name = "wreck",
                              .title = "A wreck",
                              .car = "compact_rwd_ev",
                              .grip = 0.5,
                              .duration = duration};
  scenario.road.left_edge = 5.25;
  scenario.road.right_edge = -5.25;
  scenario.ego = scenario::EgoStart{.pose = {}, .speed = 20.0};
  scenario.actors.push_back({.id = 1,
                             .footprint = {.length = 4.5, .width = 1.8},
                             .mass = 1'500.0,
                             .motion = scenario::Script{.start = {.s = distance},
                                                        .behaviour = scenario::Behaviour::hold}});
  return scenario;
}

}  // namespace saca::encounter
