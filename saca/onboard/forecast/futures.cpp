#include "saca/onboard/forecast/futures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saca/onboard/collision/impact.h"
#include "saca/onboard/forecast/atlas_ego.h"
#include "saca/onboard/forecast/edge_sweep.h"
#include "saca/onboard/forecast/sweep.h"

namespace saca::forecast {
namespace {

using atlas::Atlas;
using atlas::AtlasLimit;
using manoeuvre::Plan;
using world::Scene;
using world::SpreadOverTime;
using world::Track;

// Whom or what the ego may meet, and when.
struct Chance {
  ContactForecast forecast;
  std::optional<std::size_t> actor;
  std::optional<collision::Side> edge;
  double probability = 0.0;  // its existence included
  double time = 0.0;         // at the mean, or else when it is likeliest [s]
};

using Chances = StaticVector<Chance, world::max_actors + 2>;

bool tracks_fit(const Scene& scene, std::span<const Track> tracks) noexcept {
  return tracks.size() == scene.actors.size() &&
         std::all_of(tracks.begin(), tracks.end(), [](const Track& track) {
           return !track.X_WA.empty() && track.step > 0.0 && std::isfinite(track.start) &&
                  std::isfinite(track.step) && is_finite(track.X_WA.front()) &&
                  is_finite(track.X_WA.back());
         });
}

// Weighted harm of everybody in one impact, all of them there.
double harm_of(const collision::Impact& impact, const Scene& scene,
               const collision::HarmModel& harm) noexcept {
  double sum = harm.ego_people * weighted(harm, impact.ego);
  if (impact.contact.actor) {
    const auto kind = static_cast<std::size_t>(scene.actors[*impact.contact.actor].kind);
    sum += harm.people[kind] * weighted(harm, impact.other);
  }
  return sum;
}

// What happens if the ego meets this one. Where they miss each other at the mean, the other is
// where those are who do not.
std::optional<collision::Impact> impact_of(const Chance& chance, const AtlasEgo& ego,
                                           const Scene& scene, std::span<const Track> tracks,
                                           const collision::HarmModel& harm) noexcept {
  const collision::Instant mine = ego.at(chance.time);
  const double time = scene.time + chance.time;
  if (!is_finite(mine.X_WB) || !is_finite(mine.v_W)) {
    return std::nullopt;
  }
  if (chance.edge) {
    return collision::leave(scene, *chance.edge, mine, time, harm);
  }
  collision::Instant other = collision::instant_at(tracks[*chance.actor], time);
  if (!chance.forecast.contact) {
    other.X_WB.p = other.X_WB.p + chance.forecast.brought_W;
  }
  if (!is_finite(other.X_WB) || !is_finite(other.v_W)) {
    return std::nullopt;
  }
  return collision::meet(scene, *chance.actor, mine, other, time, harm);
}

void add(Chances& chances, const Chance& chance) noexcept {
  if (chance.probability > negligible || chance.forecast.contact) {
    chances.push_back(chance);
    chances[chances.size() - 1].time = chance.forecast.contact.value_or(chance.forecast.touch);
  }
}

// Everybody and everything, in the order in which the ego comes upon them.
Chances chances_of(const AtlasEgo& ego, std::span<const Track> tracks,
                   std::span<const PoseSamples> samples, std::span<const SpreadOverTime> spreads,
                   Future& future) noexcept {
  const Scene& scene = ego.scene();
  Chances chances;
  double until = std::numeric_limits<double>::infinity();  // by then somebody is struck for sure
  for (const collision::Side side : {collision::Side::left, collision::Side::right}) {
    const world::Beyond what = collision::beyond(scene.road, side);
    const bool counts = what != world::Beyond::unmarked;
    const ContactForecast edge = edge_contact_forecast(ego, side, counts ? future.clearance : 0.0);
    if (counts && edge.nearest_at) {
      future.clearance = edge.clearance;
      future.nearest = {.edge = side, .time = scene.time + *edge.nearest_at};
    }
    if (edge.contact && edge.probability > 1.0 - negligible && world::is_hard(what)) {
      until = std::min(until, *edge.contact);
    }
    add(chances, {edge, std::nullopt, side, edge.probability, 0.0});
  }
  const bool leaves = std::any_of(chances.begin(), chances.end(), [](const Chance& chance) {
    return chance.forecast.contact.has_value();
  });
  const ContactForecasts met =
      meetings(ego, tracks, samples, spreads, leaves ? 0.0 : future.clearance, until);
  for (std::size_t i = 0; i < met.size(); ++i) {
    if (met[i].nearest_at) {
      future.clearance = met[i].clearance;
      future.nearest = {.actor = i, .time = scene.time + *met[i].nearest_at};
    }
    add(chances, {met[i], i, std::nullopt, scene.actors[i].existence * met[i].probability, 0.0});
  }
  std::sort(chances.begin(), chances.end(),
            [](const Chance& a, const Chance& b) { return a.time < b.time; });
  return chances;
}

bool stops(const Chance& chance, const Scene& scene) noexcept {
  return chance.actor || world::is_hard(collision::beyond(scene.road, *chance.edge));
}

void judge(const Chances& chances, const AtlasEgo& ego, std::span<const Track> tracks,
           const collision::HarmModel& harm, Future& future) noexcept {
  const Scene& scene = ego.scene();
  double unharmed = 1.0;                     // probability that nobody has been struck so far
  std::optional<collision::Impact> met;      // at the mean
  std::optional<collision::Impact> crossed;  // likewise an edge that lets the ego go on
  for (const Chance& chance : chances) {
    if (unharmed < negligible && met) {
      break;
    }
    const std::optional<collision::Impact> impact = impact_of(chance, ego, scene, tracks, harm);
    if (!impact) {
      future.outside = AtlasLimit::no_number;
      return;
    }
    const double size = harm_of(*impact, scene, harm);
    future.harm += unharmed * chance.probability * size;
    const bool ends = stops(chance, scene);
    if (chance.forecast.contact && !met) {
      const double there = chance.actor ? scene.actors[*chance.actor].existence : 1.0;
      future.harm_at_mean += there * size;
      (ends ? met : crossed) = impact;
    }
    if (ends) {
      unharmed *= 1.0 - chance.probability;
    }
  }
  future.probability = 1.0 - unharmed;
  if (const std::optional<collision::Impact>& first = met ? met : crossed) {
    future.contact = first->contact;
    future.collision_loss = first->loss;
    future.clearance = 0.0;
    future.nearest.reset();
  }
}

// One scene, looked at once for all plans.
class Judge {
 public:
  Judge(const Atlas& atlas, const Scene& scene, std::span<const Track> tracks,
        const collision::HarmModel& harm, const Uncertainty& uncertainty) noexcept
      : atlas_(atlas), scene_(scene), tracks_(tracks), harm_(harm), uncertainty_(uncertainty) {
    const std::size_t num_spreads = uncertainty.spreads.size();
    usable_ = !broken_rule(scene) && tracks_fit(scene, tracks) &&
              (num_spreads == 0 || num_spreads == tracks.size());
    for (std::size_t i = 0; usable_ && i < tracks.size(); ++i) {
      samples_[i] =
          pose_samples_of(tracks[i], scene.actors[i].footprint, scene.time, scene.ego.X_WB.p);
    }
  }

  [[nodiscard]] Future future(const Plan& plan) const noexcept {
    Future future{.plan = plan};
    future.outside = usable_ ? atlas_.outside(plan, scene_, uncertainty_.bounds)
                             : std::optional(AtlasLimit::no_number);
    if (future.outside) {
      return future;
    }
    const atlas::AtlasPath path = atlas_.path(plan, scene_);
    const AtlasEgo ego(path, scene_);
    judge(chances_of(ego, tracks_, std::span(samples_).first(tracks_.size()), uncertainty_.spreads,
                     future),
          ego, tracks_, harm_, future);
    future.end_time = scene_.time + path.end;
    return future;
  }

 private:
  const Atlas& atlas_;
  const Scene& scene_;
  std::span<const Track> tracks_;
  const collision::HarmModel& harm_;
  const Uncertainty& uncertainty_;
  bool usable_ = false;
  std::array<PoseSamples, world::max_actors> samples_;
};

}  // namespace

Future future(const Atlas& atlas, const Plan& plan, const Scene& scene,
              std::span<const Track> tracks, const collision::HarmModel& harm,
              const Uncertainty& uncertainty) noexcept {
  return Judge(atlas, scene, tracks, harm, uncertainty).future(plan);
}

bool better(const Future& a, const Future& b) noexcept {
  if (a.outside || b.outside) {
    return !a.outside && b.outside;
  }
  collision::Outcome of_a;
  collision::Outcome of_b;
  of_a.harm = a.harm;
  of_a.clearance = a.clearance;
  of_b.harm = b.harm;
  of_b.clearance = b.clearance;
  return better(of_a, a.plan.policy, of_b, b.plan.policy);
}

Futures futures(const Atlas& atlas, const Scene& scene, std::span<const Track> tracks,
                const collision::HarmModel& harm, const BrakingChoices& choices,
                const Uncertainty& uncertainty) noexcept {
  const Judge judge(atlas, scene, tracks, harm, uncertainty);
  Futures all;
  const auto try_also = [&](const Plan& plan) {
    Future& best = all[manoeuvre::index(plan.policy)];
    const Future one = judge.future(plan);
    if (better(one, best)) {
      best = one;
    } else if (best.outside == AtlasLimit::target_speed && one.outside) {
      best.outside = one.outside;
    }
  };
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    Future& best = all[manoeuvre::index(policy)];
    if (!manoeuvre::brakes_to_speed(policy)) {
      best = judge.future({policy, std::nullopt});
      continue;
    }
    best = {.plan = manoeuvre::default_plan(policy, scene.ego.v_B.x),
            .outside = AtlasLimit::target_speed};
    for (const double share : choices.shares) {
      try_also({policy, share * scene.ego.v_B.x});
    }
  }
  for (const double strength : choices.strengths) {
    try_also({.policy = manoeuvre::PolicyId::aeb, .strength = strength});
  }
  return all;
}

}  // namespace saca::forecast
