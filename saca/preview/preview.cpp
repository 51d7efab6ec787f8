#include "saca/preview/preview.h"

#include <algorithm>
#include <cmath>

#include "saca/intent/intention.h"
#include "saca/preview/caution.h"
#include "saca/reach/car_limits.h"
#include "saca/world/time_to_conflict.h"

namespace saca::preview {
namespace {

using intent::Intention;
using intent::IntentPosterior;
using world::Actor;
using world::Scene;
using world::Track;

constexpr double after_trigger = 8.0;  // [s] of tracks beyond the trigger: any stop from 25 m/s
constexpr double slope_time = 0.05;    // [s] over which an acceleration is read off a track
constexpr std::size_t num_candidates = 24;  // combinations that are looked at for conflicts

/// One intention for each actor.
struct Combination {
  double probability = 1.0;
  std::vector<Intention> intentions;
};

/// The intentions of an actor that are worth a forecast of their own, with their probabilities: all
/// likely ones if any of them leads into a conflict, else only the likeliest.
std::vector<std::pair<Intention, double>> worth_forecasting(const Scene& scene, const Actor& actor,
                                                            const IntentPosterior& posterior,
                                                            const Thresholds& thresholds) {
  std::vector<std::pair<Intention, double>> likely;
  bool matters = false;
  for (const Intention intention : intent::all_intentions) {
    const double probability = posterior[static_cast<std::size_t>(intention)];
    if (probability < thresholds.least_posterior) {
      continue;
    }
    likely.emplace_back(intention, probability);
    const Track track = intent::predicted_track(scene, actor, intention, thresholds.preview);
    matters = matters || world::time_to_conflict(scene, actor, track, thresholds.preview,
                                                 thresholds.preview_tolerance)
                             .has_value();
  }
  if (matters && !world::is_behind(scene, actor)) {
    return likely;
  }
  return {{intent::likeliest(posterior), 1.0}};  // it makes no difference what else it does
}

/// The likeliest combinations, in falling order. Exact: extending the best partial combinations
/// never loses one of the best whole ones, since probabilities multiply.
std::vector<Combination> combinations(const Scene& scene,
                                      const std::vector<IntentPosterior>& posteriors,
                                      const Thresholds& thresholds) {
  std::vector<Combination> best(1);
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    std::vector<Combination> longer;
    for (const auto& [intention, probability] :
         worth_forecasting(scene, scene.actors[i], posteriors[i], thresholds)) {
      for (const Combination& each : best) {
        longer.push_back({each.probability * probability, each.intentions});
        longer.back().intentions.push_back(intention);
      }
    }
    std::stable_sort(longer.begin(), longer.end(), [](const Combination& a, const Combination& b) {
      return a.probability > b.probability;
    });
    longer.resize(std::min(longer.size(), num_candidates));
    best = std::move(longer);
  }
  return best;
}

/// When the first conflict comes: with the trigger's tolerance, else with that of the preview.
std::optional<double> conflict_time(const Scene& scene, const std::vector<Track>& tracks,
                                    const Thresholds& thresholds) {
  for (const double tolerance : {thresholds.trigger_tolerance, thresholds.preview_tolerance}) {
    std::optional<double> first;
    for (std::size_t i = 0; i < scene.actors.size(); ++i) {
      const Actor& actor = scene.actors[i];
      if (world::is_behind(scene, actor)) {
        continue;
      }
      const auto time =
          world::time_to_conflict(scene, actor, tracks[i], thresholds.preview, tolerance);
      if (time && (!first || *time < *first)) {
        first = time;
      }
    }
    if (first) {
      return first;
    }
  }
  return std::nullopt;
}

/// The actor at a later time on its track, `after` seconds on.
Actor moved_on(Actor actor, const Track& track, double time, double after) {
  actor.X_WA = world::pose_at(track, time);
  actor.v_W = world::velocity_at(track, time);
  actor.a_W = (1.0 / slope_time) * (world::velocity_at(track, time + slope_time) - actor.v_W);
  actor.yaw_rate = world::yaw_rate_at(track, time);
  actor.position_sd = std::hypot(actor.position_sd, after * actor.velocity_sd);
  return actor;
}

/// The scene `after` seconds later: the ego goes on as it does, the actors follow their tracks.
Scene moved_on(const Scene& scene, const std::vector<Track>& tracks, double after) {
  Scene later = scene;
  later.time = scene.time + after;
  const double speed = norm(scene.ego.v_B);
  later.ego = {.X_WB = world::ego_going_on(scene, after),
               .v_B = {speed, 0.0},
               .yaw_rate = speed * scene.road.curvature,
               .a_B = {}};
  for (std::size_t i = 0; i < later.actors.size(); ++i) {
    later.actors[i] = moved_on(scene.actors[i], tracks[i], later.time, after);
  }
  return later;
}

}  // namespace

std::vector<Situation> situations(const Scene& scene, const intent::Beliefs& beliefs,
                                  const Thresholds& thresholds, const ForecastTools& tools) {
  std::vector<IntentPosterior> posteriors;
  for (const intent::Belief& belief : cautious(scene, beliefs, thresholds)) {
    posteriors.push_back(belief.now());
  }
  std::vector<Situation> found;
  for (Combination& combination : combinations(scene, posteriors, thresholds)) {
    std::vector<Track> tracks;
    for (std::size_t i = 0; i < scene.actors.size(); ++i) {
      tracks.push_back(intent::predicted_track(scene, scene.actors[i], combination.intentions[i],
                                               thresholds.preview + after_trigger));
    }
    const auto conflict = conflict_time(scene, tracks, thresholds);
    if (!conflict) {
      continue;
    }
    Situation situation;
    situation.scene_at_trigger =
        moved_on(scene, tracks, std::max(0.0, *conflict - thresholds.trigger));
    situation.probability = combination.probability;
    situation.intentions = std::move(combination.intentions);
    situation.posteriors = posteriors;
    situation.risks = obstacle_risks(situation.scene_at_trigger, tools);
    situation.facts = policy_facts(situation.scene_at_trigger, tracks, tools);
    situation.tracks = std::move(tracks);
    found.push_back(std::move(situation));
    if (found.size() == max_situations) {
      break;
    }
  }
  return found;
}

std::vector<reach::ObstacleRisk> obstacle_risks(const Scene& scene, const ForecastTools& tools) {
  const auto judged = [&](const reach::DangerModel& model) {
    std::vector<reach::ObstacleRisk> risks;
    for (const Actor& actor : scene.actors) {
      risks.push_back(reach::obstacle_risk(scene, actor, model));
    }
    return risks;
  };
  if (tools.danger != nullptr) {
    return judged(*tools.danger);
  }
  return judged({reach::avoidance_of(*tools.car, scene.grip), scene.ego_footprint, {}});
}

}  // namespace saca::preview
