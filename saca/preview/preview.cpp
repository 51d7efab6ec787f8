#include "saca/preview/preview.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "saca/intent/intention.h"
#include "saca/intent/joint.h"
#include "saca/intent/motion.h"
#include "saca/preview/caution.h"
#include "saca/reach/car_limits.h"
#include "saca/world/time_to_conflict.h"

namespace saca::preview {
namespace {

using intent::Forecast;
using intent::IntentPosterior;
using world::Actor;
using world::Scene;
using world::Track;

constexpr double after_trigger = 8.0;  // [s] of tracks beyond the trigger: any stop from 25 m/s
constexpr double slope_time = 0.05;    // [s] over which an acceleration is read off a track
constexpr std::size_t num_candidates = 24;  // hypotheses that are looked at for conflicts

/// The intentions of an actor that are worth a forecast of their own: all likely ones if any of
/// them leads into a conflict, else only the likeliest.
intent::Choices worth_forecasting(const Scene& scene, const Actor& actor,
                                  const IntentPosterior& posterior, const Thresholds& thresholds,
                                  const intent::MotionLaw& motion) {
  const intent::Choices likely = intent::choices_of(posterior, thresholds.least_posterior);
  const auto conflicts = [&](const intent::Choice& choice) {
    const Forecast forecast =
        intent::motion_under(scene, actor, choice.intention, thresholds.preview, motion);
    return world::time_to_conflict(scene, actor, forecast.track, thresholds.preview,
                                   thresholds.preview_tolerance)
        .has_value();
  };
  if (!world::is_behind(scene, actor) && std::any_of(likely.begin(), likely.end(), conflicts)) {
    return likely;
  }
  intent::Choices one;  // it makes no difference what else it does
  one.push_back({intent::likeliest(posterior), 1.0});
  return one;
}

std::vector<intent::Hypothesis> hypotheses(const Scene& scene,
                                           const std::vector<IntentPosterior>& posteriors,
                                           const Thresholds& thresholds,
                                           const intent::MotionLaw& motion) {
  std::vector<intent::Choices> choices;
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    choices.push_back(worth_forecasting(scene, scene.actors[i], posteriors[i], thresholds, motion));
  }
  return intent::likeliest_hypotheses(choices, num_candidates);
}

struct Conflict {
  double time = 0.0;      ///< from the scene on [s]
  std::size_t actor = 0;  ///< index into scene.actors
};

/// The first conflict: with the trigger's tolerance, else with that of the preview.
std::optional<Conflict> first_conflict(const Scene& scene, const std::vector<Forecast>& forecasts,
                                       const Thresholds& thresholds) {
  for (const double tolerance : {thresholds.trigger_tolerance, thresholds.preview_tolerance}) {
    std::optional<Conflict> first;
    for (std::size_t i = 0; i < scene.actors.size(); ++i) {
      const Actor& actor = scene.actors[i];
      if (world::is_behind(scene, actor)) {
        continue;
      }
      const auto time =
          world::time_to_conflict(scene, actor, forecasts[i].track, thresholds.preview, tolerance);
      if (time && (!first || *time < first->time)) {
        first = {*time, i};
      }
    }
    if (first) {
      return first;
    }
  }
  return std::nullopt;
}

/// What is left of the spread along its line of the one who sets off the trigger: the trigger comes
/// wherever that is T1 before the conflict, within its tolerance of crossing traffic. So it is what
/// was perceived, and an instant anywhere within the tolerance.
double along_sd_at_trigger(const Scene& scene, const Actor& actor, const Forecast& forecast,
                           const Thresholds& thresholds) {
  const double tolerance = world::is_crossing(scene, actor) ? thresholds.trigger_tolerance : 0.0;
  return std::hypot(forecast.spread.at.front().along_sd,
                    norm(actor.v_W) * tolerance / std::numbers::sqrt3);
}

/// How far an actor may be from its track from the trigger on: at the trigger as far as forecast;
/// then it is seen anew, so that the rest grows as that of a forecast that begins there.
/// @param most_along  at the trigger along its line [m]
world::SpreadOverTime spread_from_trigger(const Forecast& forecast, double trigger,
                                          double most_along) {
  world::Spread there = world::spread_at(forecast.spread, trigger);
  there.along_sd = std::min(there.along_sd, most_along);
  const world::Spread first = forecast.spread.at.front();
  const auto grown = [](double from, double before, double later) {
    return std::sqrt(from * from + std::max(0.0, later * later - before * before));
  };
  world::SpreadOverTime spread{.start = trigger, .step = forecast.spread.step, .at = {}};
  for (const world::Spread& each : forecast.spread.at) {
    spread.at.push_back({grown(there.along_sd, first.along_sd, each.along_sd),
                         grown(there.across_sd, first.across_sd, each.across_sd)});
  }
  return spread;
}

/// The actor at a later time of its forecast, as surely perceived as now.
Actor moved_on(Actor actor, const Forecast& forecast, double time) {
  const Track& track = forecast.track;
  actor.X_WA = world::pose_at(track, time);
  actor.v_W = world::velocity_at(track, time);
  actor.a_W = (1.0 / slope_time) * (world::velocity_at(track, time + slope_time) - actor.v_W);
  actor.yaw_rate = world::yaw_rate_at(track, time);
  return actor;
}

/// The scene `after` seconds later: the ego goes on as it does, the actors as forecast.
Scene moved_on(const Scene& scene, const std::vector<Forecast>& forecasts, double after) {
  Scene later = scene;
  later.time = scene.time + after;
  const double speed = norm(scene.ego.v_B);
  later.ego = {.X_WB = world::ego_going_on(scene, after),
               .v_B = {speed, 0.0},
               .yaw_rate = speed * scene.road.curvature,
               .a_B = {}};
  for (std::size_t i = 0; i < later.actors.size(); ++i) {
    later.actors[i] = moved_on(scene.actors[i], forecasts[i], later.time);
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
  for (intent::Hypothesis& hypothesis : hypotheses(scene, posteriors, thresholds, tools.motion)) {
    std::vector<Forecast> forecasts;
    for (std::size_t i = 0; i < scene.actors.size(); ++i) {
      forecasts.push_back(intent::motion_under(scene, scene.actors[i], hypothesis.intentions[i],
                                               thresholds.preview + after_trigger, tools.motion));
    }
    const auto conflict = first_conflict(scene, forecasts, thresholds);
    if (!conflict) {
      continue;
    }
    Situation situation;
    situation.scene_at_trigger =
        moved_on(scene, forecasts, std::max(0.0, conflict->time - thresholds.trigger));
    situation.probability = hypothesis.probability;
    situation.intentions = std::move(hypothesis.intentions);
    situation.posteriors = posteriors;
    situation.risks = obstacle_risks(situation.scene_at_trigger, tools);
    for (std::size_t i = 0; i < forecasts.size(); ++i) {
      const double most_along = i == conflict->actor ? along_sd_at_trigger(scene, scene.actors[i],
                                                                           forecasts[i], thresholds)
                                                     : std::numeric_limits<double>::infinity();
      situation.spreads.push_back(
          spread_from_trigger(forecasts[i], situation.scene_at_trigger.time, most_along));
      situation.tracks.push_back(std::move(forecasts[i].track));
    }
    situation.facts =
        policy_facts(situation.scene_at_trigger, situation.tracks, tools, situation.spreads);
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
