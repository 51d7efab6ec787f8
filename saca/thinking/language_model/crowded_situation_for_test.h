#pragma once

#include <random>

#include "saca/thinking/language_model/example_situation.h"

namespace saca::language_model {

/// A forecast with more to tell than a prompt holds: a dozen road users and obstacles of all kinds
/// anywhere, every policy in contact with somebody for certain or not, oncoming lanes on both
/// sides. Of no physical sense.
inline preview::Situation crowded_situation(unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto one_of = [&](unsigned num) {
    return std::uniform_int_distribution<unsigned>(0, num - 1)(random);
  };
  preview::Situation situation = example_situation();
  world::Scene& scene = situation.scene_at_trigger;
  scene.ego.v_B = {between(0.0, 60.0), between(-9.0, 9.0)};
  scene.road.oncoming_left = true;
  scene.road.oncoming_right = true;
  scene.road.left_edge = between(2.0, 50.0);
  const world::Actor first = scene.actors[0];
  scene.actors.clear();
  situation.intentions.clear();
  situation.posteriors.clear();
  situation.risks.clear();
  situation.tracks.clear();
  for (std::uint8_t i = 0; i < 12; ++i) {
    world::Actor actor = first;
    actor.id = static_cast<std::uint8_t>(244 + i);
    actor.kind = static_cast<world::ActorKind>(one_of(7));
    actor.X_WA = {{between(-150.0, 150.0), between(-30.0, 30.0)}, between(-3.0, 3.0)};
    actor.occluded = one_of(2) == 0;
    actor.v_W = actor.kind == world::ActorKind::obstacle
                    ? Vec2{}
                    : Vec2{between(-50.0, 50.0), between(-50.0, 50.0)};
    const auto intention = one_of(intent::num_intentions);
    situation.intentions.push_back(static_cast<intent::Intention>(intention));
    intent::IntentPosterior posterior{};
    posterior[intention] = 1.0;
    situation.posteriors.push_back(posterior);
    situation.risks.push_back({});
    situation.risks.back().risk = between(0.0, 1.0);
    world::Track track{.start = 0.0, .step = 0.1, .X_WA = {}};
    for (int k = 0; k <= 50; ++k) {
      track.X_WA.push_back({actor.X_WA.p + 0.1 * k * actor.v_W, actor.X_WA.yaw});
    }
    situation.tracks.push_back(std::move(track));
    scene.actors.push_back(actor);
  }
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    preview::PolicyFacts& facts = situation.facts[manoeuvre::index(policy)];
    auto& end = facts.end.emplace<preview::ExpectedOutcome>();
    facts.plan = manoeuvre::default_plan(policy, scene.ego.v_B.x);
    if (manoeuvre::takes_strength(policy) && seed % 2 == 0) {
      facts.plan.strength = 0.45;
    }
    collision::Contact contact;
    contact.actor = one_of(12);
    contact.relative_speed = between(0.0, 80.0);
    end.outcome.contact = contact;
    contact.actor = one_of(12);
    end.outcome.later.push_back(contact);
    end.outcome.clearance = 0.0;
    end.outcome.harm = between(0.0, 20.0);
    end.contact_probability = between(0.0, 1.0);
  }
  return situation;
}

}  // namespace saca::language_model
