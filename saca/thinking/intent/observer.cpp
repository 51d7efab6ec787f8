#include "saca/thinking/intent/observer.h"

#include <algorithm>

#include "saca/base/core/contract.h"
#include "saca/thinking/intent/line.h"
#include "saca/thinking/intent/observed.h"
#include "saca/thinking/intent/vru.h"

namespace saca::intent {
namespace {

constexpr double rounding = 1e-6;  // [s]: times are sums of steps

Belief of_vru(const world::Scene& scene, const world::Actor& actor) {
  Belief belief;
  std::transform(horizons.begin(), horizons.end(), belief.at.begin(),
                 [&](double ahead) { return vru_posterior(scene, actor, ahead); });
  return belief;
}

/// An obstacle, who is at rest, of whom the next thing it can do is to drive on, which is M, and
/// everybody where nothing was learnt.
Belief of_who_goes_on() {
  Belief belief;
  IntentPosterior maintains{};
  maintains[static_cast<std::size_t>(Intention::maintain)] = 1.0;
  belief.at.fill(maintains);
  return belief;
}

Belief of_vehicle(const HorizonScores& told) {
  Belief belief;
  for (std::size_t h = 0; h < num_horizons; ++h) {
    belief.at[h] = {};
    std::copy(told[h].begin(), told[h].end(), belief.at[h].begin());
  }
  return belief;
}

}  // namespace

const Beliefs& Observer::look(const world::Scene& scene) {
  expects(!world::broken_rule(scene), "the scene keeps the rules of a scene");
  if (scene.time < time_ - rounding) {
    known_.clear();
  }
  time_ = scene.time;
  forget_before(time_ - memory);
  // First who is known, so that nobody who is here makes room for somebody new.
  for (const world::Actor& actor : scene.actors) {
    if (RoadUser* const known = find(actor)) {
      known->seen = time_;
    }
  }
  beliefs_.clear();
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    const world::Actor& actor = scene.actors[i];
    RoadUser* const found = find(actor);
    RoadUser& known = found != nullptr ? *found : begin(actor, time_);
    if (time_ >= known.due - rounding) {
      known.belief = judged(scene, i, known.stream);
      // On a grid, however the looks fall; steps that were missed are not made up for.
      known.due += step;
      if (known.due <= time_ + rounding) {
        known.due = time_ + step;
      }
    }
    beliefs_.push_back(known.belief);
  }
  return beliefs_;
}

Belief Observer::judged(const world::Scene& scene, std::size_t i, Stream& stream) const {
  const world::Actor& actor = scene.actors[i];
  if (actor.kind == world::ActorKind::obstacle || model_->networks.empty()) {
    return of_who_goes_on();
  }
  if (is_vru(actor.kind)) {
    return of_vru(scene, actor);
  }
  const HorizonScores told =
      stream.step(*model_, observed(scene, i));  // also of who stands: it may drive on
  return norm(actor.v_W) < rest_speed ? of_who_goes_on() : of_vehicle(told);
}

Observer::RoadUser* Observer::find(const world::Actor& actor) {
  RoadUser* const found = std::find_if(known_.begin(), known_.end(), [&](const RoadUser& known) {
    return known.kind == actor.kind && known.id == actor.id;
  });
  return found != known_.end() ? found : nullptr;
}

Observer::RoadUser& Observer::begin(const world::Actor& actor, double time) {
  const RoadUser fresh{
      .kind = actor.kind, .id = actor.id, .seen = time, .due = time, .stream = {}, .belief = {}};
  if (!known_.full()) {
    known_.push_back(fresh);
    return known_[known_.size() - 1];
  }
  // A scene has no more actors than there are places: one of these is not in it.
  RoadUser* const longest_gone =
      std::min_element(known_.begin(), known_.end(),
                       [](const RoadUser& a, const RoadUser& b) { return a.seen < b.seen; });
  return *longest_gone = fresh;
}

void Observer::forget_before(double time) {
  const auto is_gone = [&](const RoadUser& known) { return known.seen <= time + rounding; };
  if (std::none_of(known_.begin(), known_.end(), is_gone)) {
    return;
  }
  StaticVector<RoadUser, world::max_actors> kept;
  for (const RoadUser& known : known_) {
    if (!is_gone(known)) {
      kept.push_back(known);
    }
  }
  known_ = kept;
}

Beliefs beliefs_at_sight(const Model& model, const world::Scene& scene) {
  return Observer(model).look(scene);
}

}  // namespace saca::intent
