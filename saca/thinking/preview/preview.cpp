#include "saca/thinking/preview/preview.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "saca/base/world/time_to_conflict.h"
#include "saca/thinking/danger/car_limits.h"
#include "saca/thinking/intent/intention.h"
#include "saca/thinking/intent/joint.h"
#include "saca/thinking/intent/motion.h"
#include "saca/thinking/preview/caution.h"
#include "saca/thinking/preview/forecast_danger.h"
#include "saca/thinking/preview/moved_along.h"

namespace saca::preview {
namespace {

using intent::Forecast;
using intent::IntentPosterior;
using world::Actor;
using world::Scene;

constexpr double after_trigger = 8.0;  // [s] of tracks beyond the trigger: any stop from 25 m/s
constexpr std::size_t num_candidates = 24;  // hypotheses that are looked at for conflicts

/// The scene with the ego one lane to the side, where an evasion leads it; nullopt: there is no
/// such lane.
std::optional<Scene> beside(const Scene& scene, double side) {
  const world::LanePose here = world::to_lane(scene.road, scene.ego.X_WB);
  const double d = here.d + side * scene.road.lane_width;
  const double half_width = 0.5 * scene.ego_footprint.width;
  if (d + half_width > scene.road.left_edge || d - half_width < scene.road.right_edge) {
    return std::nullopt;
  }
  Scene there = scene;
  there.ego.X_WB = world::from_lane(scene.road, {.s = here.s, .d = d, .heading = here.heading});
  return there;
}

/// What of the actors' intentions makes a difference to the ego.
class Differences {
 public:
  Differences(const Scene& scene, const reflex::Thresholds& thresholds,
              const intent::MotionLaw& motion)
      : scene_(scene),
        thresholds_(thresholds),
        motion_(motion),
        sides_{beside(scene, 1.0), beside(scene, -1.0)} {}

  /// The intentions of an actor that are worth a forecast of their own: all likely ones if any of
  /// them leads into a conflict, or if it depends on them whether a lane beside is free to swerve
  /// to; else only the likeliest.
  [[nodiscard]] intent::Choices worth_forecasting(const Actor& actor,
                                                  const IntentPosterior& posterior) const {
    const intent::Choices likely = intent::choices_of(posterior, thresholds_.least_posterior);
    std::optional<Ways> first;
    for (const intent::Choice& choice : likely) {
      const Ways met = ways_met(actor, choice.intention);
      if (!first) {
        first = met;
      }
      if (met.ahead || met.beside != first->beside) {
        return likely;
      }
    }
    intent::Choices one;  // it makes no difference what else it does
    one.push_back({intent::likeliest(posterior), 1.0});
    return one;
  }

 private:
  /// Where the ego would meet it.
  struct Ways {
    bool ahead = false;            ///< going on as it does
    std::array<bool, 2> beside{};  ///< likewise, in the lane to the left and to the right
  };
  [[nodiscard]] Ways ways_met(const Actor& actor, intent::Intention intention) const {
    const Forecast forecast =
        intent::motion_under(scene_, actor, intention, thresholds_.preview, motion_);
    const auto meets = [&](const Scene& scene) {
      return world::time_to_conflict(scene, actor, forecast.track, thresholds_.preview,
                                     thresholds_.preview_tolerance)
          .has_value();
    };
    Ways met{.ahead = !world::is_behind(scene_, actor) && meets(scene_), .beside = {}};
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      met.beside[i] = sides_[i] && meets(*sides_[i]);
    }
    return met;
  }

  const Scene& scene_;
  const reflex::Thresholds& thresholds_;
  const intent::MotionLaw& motion_;
  std::array<std::optional<Scene>, 2> sides_;
};

std::vector<intent::Hypothesis> hypotheses(const Scene& scene,
                                           const std::vector<IntentPosterior>& posteriors,
                                           const reflex::Thresholds& thresholds,
                                           const intent::MotionLaw& motion) {
  const Differences differences(scene, thresholds, motion);
  std::vector<intent::Choices> choices;
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    choices.push_back(differences.worth_forecasting(scene.actors[i], posteriors[i]));
  }
  return intent::likeliest_hypotheses(choices, num_candidates);
}

/// What is left of the spread along its line of the one who sets off the trigger: the trigger comes
/// wherever that is T1 before the conflict, within its tolerance of crossing traffic. So it is what
/// was perceived, and an instant anywhere within the tolerance.
double along_sd_at_trigger(const Scene& scene, const Actor& actor, const Forecast& forecast,
                           const reflex::Thresholds& thresholds) {
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

/// Of who reacts to the ego: it keeps a gap that it sees, whatever it might have done by then.
world::SpreadOverTime as_perceived(const Actor& actor, double start) {
  return {
      .start = start, .step = intent::motion_step, .at = {{actor.position_sd, actor.position_sd}}};
}

/// The scene `after` seconds later: the ego goes on as it does, the actors as forecast.
Scene moved_on(const Scene& scene, const std::vector<Forecast>& forecasts, double after) {
  Scene later = scene;
  later.time = scene.time + after;
  const double speed = scene.ego.v_B.x < 0.0 ? 0.0 : norm(scene.ego.v_B);  // as ego_going_on
  later.ego = {.X_WB = world::ego_going_on(scene, after),
               .v_B = {speed, 0.0},
               .yaw_rate = speed * scene.road.curvature,
               .a_B = {}};
  for (std::size_t i = 0; i < later.actors.size(); ++i) {
    later.actors[i] = moved_along(scene.actors[i], forecasts[i].track, later.time);
  }
  return later;
}

/// When the reflex plane is going to act, and because of whom.
struct Trigger {
  double after = 0.0;     ///< from the scene on [s]
  std::size_t actor = 0;  ///< index into scene.actors
};

/// The first instant at which the reflex plane's own rule triggers if all move as forecast: with
/// its own tolerance of crossing traffic, else with the preview's. Exact to a millisecond, but for
/// conflicts that last for less than 50 ms.
std::optional<Trigger> first_trigger(const Scene& scene, const std::vector<Forecast>& forecasts,
                                     const reflex::Thresholds& thresholds) {
  constexpr int looks_per_second = 20;
  const auto last =
      static_cast<int>(std::floor(looks_per_second * (thresholds.preview - thresholds.trigger)));
  for (const double tolerance : {thresholds.trigger_tolerance, thresholds.preview_tolerance}) {
    reflex::Thresholds rule = thresholds;
    rule.trigger_tolerance = tolerance;
    const auto threat = [&](double after) {
      return reflex::triggering_threat(moved_on(scene, forecasts, after), rule);
    };
    double before = 0.0;
    for (int look = 0; look <= last; ++look) {
      double after = static_cast<double>(look) / looks_per_second;
      auto found = threat(after);
      if (!found) {
        before = after;
        continue;
      }
      constexpr int halvings = 6;
      for (int i = 0; i < halvings && before < after; ++i) {
        const double middle = 0.5 * (before + after);
        if (const auto sooner = threat(middle)) {
          after = middle;
          found = sooner;
        } else {
          before = middle;
        }
      }
      return Trigger{after, found->actor};
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<Situation> situations(const Scene& scene, const intent::Beliefs& beliefs,
                                  const reflex::Thresholds& thresholds,
                                  const ForecastTools& tools) {
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
    const auto trigger = first_trigger(scene, forecasts, thresholds);
    if (!trigger) {
      continue;
    }
    Situation situation;
    situation.scene_at_trigger = moved_on(scene, forecasts, trigger->after);
    situation.probability = hypothesis.probability;
    situation.intentions = std::move(hypothesis.intentions);
    situation.posteriors = posteriors;
    situation.risks = obstacle_risks(situation.scene_at_trigger, tools);
    for (std::size_t i = 0; i < forecasts.size(); ++i) {
      const double most_along = i == trigger->actor ? along_sd_at_trigger(scene, scene.actors[i],
                                                                          forecasts[i], thresholds)
                                                    : std::numeric_limits<double>::infinity();
      const bool reacts =
          world::is_follower(situation.scene_at_trigger, situation.scene_at_trigger.actors[i]);
      situation.spreads.push_back(
          reacts ? as_perceived(scene.actors[i], situation.scene_at_trigger.time)
                 : spread_from_trigger(forecasts[i], situation.scene_at_trigger.time, most_along));
      situation.tracks.push_back(std::move(forecasts[i].track));
    }
    situation.facts =
        policy_facts(situation.scene_at_trigger, situation.tracks, tools, situation.spreads);
    if (tools.danger != nullptr) {
      situation.dangers = policy_dangers(situation.scene_at_trigger, situation.tracks,
                                         situation.risks, situation.facts, tools);
    }
    found.push_back(std::move(situation));
    if (found.size() == max_situations) {
      break;
    }
  }
  return found;
}

std::vector<danger::ObstacleRisk> obstacle_risks(const Scene& scene, const ForecastTools& tools) {
  const auto judged = [&](const danger::DangerModel& model) {
    std::vector<danger::ObstacleRisk> risks;
    for (const Actor& actor : scene.actors) {
      risks.push_back(danger::obstacle_risk(scene, actor, model));
    }
    return risks;
  };
  if (tools.danger != nullptr) {
    return judged(*tools.danger);
  }
  return judged({danger::avoidance_of(*tools.car, scene.grip), scene.ego_footprint, {}});
}

}  // namespace saca::preview
