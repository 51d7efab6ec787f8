#pragma once

#include "saca/base/core/clock.h"
#include "saca/lab/encounter/encounter.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/thinking/intent/shipped_model.h"

namespace saca::runs {

/// Somebody stands 40 m ahead in the way of a car at 9 m/s.
struct Walker {
  scenario::Scenario scenario{
      .name = "walker", .title = "A walker", .car = "x", .grip = 0.9, .duration = 4.0};
  manoeuvre::Car car = prepare::default_car();
  collision::HarmModel harm = prepare::read_harm("data/harm.toml").value();
  ManualClock clock;
  encounter::Setup setup;

  Walker() {
    scenario.ego = scenario::EgoStart{.pose = {}, .speed = 9.0};
    scenario.actors.push_back(
        {.id = 1,
         .kind = world::ActorKind::pedestrian,
         .footprint = {.shape = world::Shape::ellipse, .length = 0.5, .width = 0.5},
         .mass = 75.0,
         .motion = scenario::Script{.start = {.s = 40.0}, .behaviour = scenario::Behaviour::hold}});
    setup = {.scenario = &scenario,
             .car = &car,
             .harm = &harm,
             .intent = &intent::shipped_model(),
             .clock = &clock};
  }
  Walker(const Walker&) = delete;
  Walker& operator=(const Walker&) = delete;
};

}  // namespace saca::runs
