#pragma once

#include "saca/thinking/preview/situation.h"

namespace saca::language_model {

/// Reasons for AEB in the situation below: both statements hold.
constexpr const char* example_reasons =
    "1. NI hits truck1, harm 0.013.\n2. So AEB: it is clear by 0.6 m.\n";

/// The paper's intersection at the trigger (Fig. 8): poses from the figure.
inline world::Scene example_scene() {
  world::Scene scene;
  scene.ego.v_B = {14.0, 0.0};
  scene.ego_footprint = {.length = 4.7, .width = 1.9, .centre_x = -0.1};
  scene.ego_mass = 1700.0;
  scene.road.topology = world::Topology::intersection;
  scene.road.left_edge = 5.25;
  scene.road.left_beyond = world::Beyond::kerb;
  world::Actor truck{.id = 1,
                     .kind = world::ActorKind::truck,
                     .footprint = {.length = 8.0, .width = 2.5},
                     .mass = 12000.0};
  truck.X_WA = {{16.0, 6.4}, -1.5707963267948966};
  truck.v_W = {0.0, -7.5};
  scene.actors.push_back(truck);
  world::Actor walker{.id = 1,
                      .kind = world::ActorKind::pedestrian,
                      .footprint = {.length = 0.6, .width = 0.6},
                      .mass = 75.0};
  walker.X_WA = {{6.0, 4.0}, 0.0};
  scene.actors.push_back(walker);
  return scene;
}

/// The same as a forecast filled by hand, for tests and benchmarks: the facts are plausible, not
/// computed.
inline preview::Situation example_situation() {
  preview::Situation situation;
  situation.scene_at_trigger = example_scene();
  const world::Scene& scene = situation.scene_at_trigger;
  situation.probability = 0.8;
  situation.intentions = {intent::Intention::maintain, intent::Intention::maintain};
  situation.posteriors = {{0.88, 0.02, 0.02, 0.04, 0.02, 0.02},
                          {0.95, 0.0, 0.0, 0.0, 0.0, 0.0, 0.02, 0.03}};
  situation.risks.resize(2);
  situation.risks[0].risk = 0.94;
  for (std::size_t i = 0; i < 2; ++i) {
    world::Track track{.start = 0.0, .step = 0.1, .X_WA = {}};
    for (int k = 0; k <= 50; ++k) {
      const double t = 0.1 * k;
      track.X_WA.push_back(
          {scene.actors[i].X_WA.p + t * scene.actors[i].v_W, scene.actors[i].X_WA.yaw});
    }
    situation.tracks.push_back(std::move(track));
  }
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    preview::PolicyFacts& facts = situation.facts[manoeuvre::index(policy)];
    facts.plan = manoeuvre::default_plan(policy, 14.0);
    collision::Contact contact;
    contact.actor = 0;
    contact.relative_speed = 8.0 + static_cast<double>(manoeuvre::index(policy));
    auto& end = facts.end.emplace<preview::ExpectedOutcome>();
    end.outcome.contact = contact;
    end.outcome.clearance = 0.0;
    end.outcome.harm = 0.0125;
    end.contact_probability = 1.0;
  }
  preview::PolicyFacts& aeb = situation.facts[manoeuvre::index(manoeuvre::PolicyId::aeb)];
  aeb.end.emplace<preview::ExpectedOutcome>().outcome.clearance = 0.62;
  situation.facts[manoeuvre::index(manoeuvre::PolicyId::t_drift_left)].end =
      preview::Refusal{"the road is too slippery"};
  situation.facts[manoeuvre::index(manoeuvre::PolicyId::t_drift_right)].end =
      preview::Refusal{"the road is too slippery"};
  return situation;
}

}  // namespace saca::language_model
