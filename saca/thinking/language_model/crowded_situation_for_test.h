#pragma once

#include <random>

#include "saca/thinking/language_model/example_situation.h"

namespace saca::language_model {

/// Draws for the situation below.
class CrowdDraws {
 public:
  explicit CrowdDraws(unsigned seed) : random_(seed) {}

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  unsigned one_of(unsigned num) {
    return std::uniform_int_distribution<unsigned>(0, num - 1)(random_);
  }

 private:
  std::mt19937 random_;
};

/// One more in the crowd: anything, anywhere, about to do anything.
inline void add_anybody(world::Actor actor, CrowdDraws& draws, preview::Situation& situation) {
  actor.kind = static_cast<world::ActorKind>(draws.one_of(7));
  actor.X_WA = {{draws.between(-150.0, 150.0), draws.between(-30.0, 30.0)},
                draws.between(-3.0, 3.0)};
  actor.occluded = draws.one_of(2) == 0;
  actor.v_W = actor.kind == world::ActorKind::obstacle
                  ? Vec2{}
                  : Vec2{draws.between(-50.0, 50.0), draws.between(-50.0, 50.0)};
  const auto intention = draws.one_of(intent::num_intentions);
  situation.intentions.push_back(static_cast<intent::Intention>(intention));
  intent::IntentPosterior posterior{};
  posterior[intention] = 1.0;
  situation.posteriors.push_back(posterior);
  situation.risks.push_back({});
  situation.risks.back().risk = draws.between(0.0, 1.0);
  world::Track track{.start = 0.0, .step = 0.1, .X_WA = {}};
  for (int k = 0; k <= 50; ++k) {
    track.X_WA.push_back({actor.X_WA.p + 0.1 * k * actor.v_W, actor.X_WA.yaw});
  }
  situation.tracks.push_back(std::move(track));
  situation.scene_at_trigger.actors.push_back(actor);
}

/// A forecast with more to tell than a prompt holds: a dozen road users and obstacles of all kinds
/// anywhere, every policy in contact with somebody for certain or not, oncoming lanes on both
/// sides. Of no physical sense.
inline preview::Situation crowded_situation(unsigned seed) {
  CrowdDraws draws(seed);
  preview::Situation situation = example_situation();
  world::Scene& scene = situation.scene_at_trigger;
  scene.ego.v_B = {draws.between(0.0, 60.0), draws.between(-9.0, 9.0)};
  scene.road.oncoming_left = true;
  scene.road.oncoming_right = true;
  scene.road.left_edge = draws.between(2.0, 50.0);
  world::Actor actor = scene.actors[0];
  scene.actors.clear();
  situation.intentions.clear();
  situation.posteriors.clear();
  situation.risks.clear();
  situation.tracks.clear();
  for (std::uint8_t i = 0; i < 12; ++i) {
    actor.id = static_cast<std::uint8_t>(244 + i);
    add_anybody(actor, draws, situation);
  }
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    preview::PolicyFacts& facts = situation.facts[manoeuvre::index(policy)];
    auto& end = facts.end.emplace<preview::ExpectedOutcome>();
    facts.plan = manoeuvre::default_plan(policy, scene.ego.v_B.x);
    if (manoeuvre::takes_strength(policy) && seed % 2 == 0) {
      facts.plan.strength = 0.45;
    }
    collision::Contact contact;
    contact.actor = draws.one_of(12);
    contact.relative_speed = draws.between(0.0, 80.0);
    end.outcome.contact = contact;
    contact.actor = draws.one_of(12);
    end.outcome.later.push_back(contact);
    end.outcome.clearance = 0.0;
    end.outcome.harm = draws.between(0.0, 20.0);
    end.contact_probability = draws.between(0.0, 1.0);
  }
  return situation;
}

}  // namespace saca::language_model
