#include "saca/lab/eval/forecast_score.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/core/names.h"
#include "saca/lab/eval/particle_filter.h"
#include "saca/lab/scenario/motion.h"
#include "saca/thinking/intent/likely_motions.h"
#include "saca/thinking/intent/line.h"

namespace saca::eval {
namespace {

using intent::Intention;
using world::Actor;
using world::Scene;

constexpr std::array<std::string_view, motion_models.size()> model_names{
    "constant_velocity", "constant_turn", "lane_following", "law",
    "particle_filter",   "mixture_lstm",  "shipped"};

constexpr double rounding = 1e-6;  // [s]: times are sums of steps

double course_of(const Actor& actor) {
  return std::atan2(actor.v_W.y, actor.v_W.x);
}

/// On along the measured arc, with the measured acceleration until rest.
LikelyPlaces going_on_the_arc(const Actor& actor) {
  LikelyPlaces places = going_straight(actor);
  const double speed = norm(actor.v_W);
  const double acceleration = dot(actor.a_W, actor.v_W) / speed;
  for (std::size_t i = 0; i < forecast_times.size(); ++i) {
    constexpr int num_steps = 50;
    const double h = forecast_times[i] / num_steps;
    LikelyPlace& place = places[i].front();
    place.p_W = actor.X_WA.p;
    for (int k = 0; k < num_steps; ++k) {
      const double t = (k + 0.5) * h;
      const double course = course_of(actor) + actor.yaw_rate * t;
      const double now = std::max(0.0, speed + acceleration * t);
      place.p_W = place.p_W + h * now * Vec2{std::cos(course), std::sin(course)};
    }
    place.course += actor.yaw_rate * forecast_times[i];
  }
  return places;
}

void add(LikelyPlaces& places, const intent::LikelyMotion& motion, const Scene& scene,
         const Actor& actor) {
  const intent::Forecast forecast =
      intent::forecast_of(motion, scene, actor, forecast_times.back() + 0.1, intent::MotionLaw{});
  for (std::size_t i = 0; i < forecast_times.size(); ++i) {
    const double time = scene.time + forecast_times[i];
    const Vec2 way = world::pose_at(forecast.track, time + 0.05).p -
                     world::pose_at(forecast.track, time - 0.05).p;
    places[i].push_back({motion.probability, world::pose_at(forecast.track, time).p,
                         norm(way) > 1e-4 ? std::atan2(way.y, way.x) : course_of(actor),
                         spread_at(forecast.spread, time)});
  }
}

/// What was perceived and believed at one instant.
struct Look {
  Scene seen;
  intent::Beliefs beliefs;
  std::vector<LikelyPlaces> filtered;  ///< by the particle filter, one per actor of `seen`
  std::vector<LikelyPlaces> learnt;    ///< by the mixture, likewise
  Scene truth;
};

/// What a model that watches says of everybody.
template <class Watcher>
std::vector<LikelyPlaces> places_by(const Watcher& watcher, const Scene& seen) {
  std::vector<LikelyPlaces> all(seen.actors.size());
  std::transform(seen.actors.begin(), seen.actors.end(), all.begin(),
                 [&](const Actor& actor) { return watcher.places_of(seen, actor); });
  return all;
}

LikelyPlaces places_in(const Look& look, std::size_t actor, MotionModel model) {
  switch (model) {
    case MotionModel::particle_filter:
      return look.filtered[actor];
    case MotionModel::mixture_lstm:
      return look.learnt[actor];
    default:
      return places_of(model, look.seen, look.seen.actors[actor], look.beliefs[actor]);
  }
}

ForecastSample sample_of(const Look& look, std::size_t i,
                         const std::array<Vec2, forecast_times.size()>& truth, Vec2 truly_now,
                         Vec2 truly_before) {
  const Actor& actor = look.seen.actors[i];
  constexpr std::size_t after_two = 2;
  const Vec2 straight_on = truly_now + 4.0 * (truly_now - truly_before);
  ForecastSample sample{.who = actor_name(actor),
                        .time = look.seen.time,
                        .acts = norm(truth[after_two] - straight_on) > 1.0,
                        .aside = !intent::is_vru(actor.kind) &&
                                 std::abs(intent::line_of(look.seen, actor).lateral) > 0.5};
  for (const MotionModel model : motion_models) {
    const LikelyPlaces places = places_in(look, i, model);
    const auto m = static_cast<std::size_t>(model);
    for (std::size_t k = 0; k < forecast_times.size(); ++k) {
      sample.scores[m][k] = score(places[k], truth[k]);
    }
    sample.mean_miss_of_6[m] = least_mean_miss(places, truth, 6);
    sample.mean_miss_of_12[m] = least_mean_miss(places, truth, 12);
  }
  return sample;
}

}  // namespace

std::string_view name(MotionModel model) {
  return name_of(model, model_names);
}

LikelyPlaces places_of(MotionModel model, const Scene& scene, const Actor& actor,
                       const intent::Belief& belief) {
  LikelyPlaces places;
  switch (model) {
    case MotionModel::constant_velocity:
      return going_straight(actor);
    case MotionModel::constant_turn:
      return going_on_the_arc(actor);
    case MotionModel::lane_following:
      add(places, {1.0, Intention::maintain, std::nullopt}, scene, actor);
      return places;
    case MotionModel::law: {
      const auto motions = intent::intended_motions(belief);
      for (const intent::LikelyMotion& one : motions) {
        add(places, one, scene, actor);
      }
      return places;
    }
    case MotionModel::particle_filter:
    case MotionModel::mixture_lstm:
      expects(false, "a model that needs one scene only");
      break;
    case MotionModel::shipped:
      break;
  }
  for (const intent::LikelyMotion& one : intent::likely_motions(scene, actor, belief)) {
    add(places, one, scene, actor);
  }
  return places;
}

std::optional<Vec2> true_place(const Scene& scene, const Actor& actor) {
  for (const Actor& one : scene.actors) {
    if (one.kind == actor.kind && one.id == actor.id) {
      return one.X_WA.p;
    }
  }
  return std::nullopt;
}

bool can_be_judged(const encounter::Stage& stage, const ForecastWindow& window, const Actor& actor,
                   Vec2 truly_now, double before, double now) {
  if (now < window.from - rounding || now > window.until + rounding) {
    return false;
  }
  const double s = world::to_lane(stage.scenario->road, {truly_now, 0.0}).s;
  if (s < -window.lane_behind || s > window.lane_ahead) {
    return false;
  }
  const std::size_t index = actor_index(*stage.scenario, actor);
  const scenario::ScenarioActor& recorded = stage.scenario->actors[index];
  const auto settled = [&](double time, const Settling& settling) {
    const double own = scenario::own_time(time, stage.chance.actors[index], stage.chance.from);
    return is_settled(recorded, own, settling);
  };
  return settled(before + rounding, {.after_start = 0.0, .before_end = 0.0}) &&
         settled(now + rounding, window.settling) &&
         settled(now + forecast_times.back() - rounding, window.settling);
}

Result<std::vector<ForecastSample>> forecast_samples(const encounter::Stage& stage,
                                                     const WatchingModels& models,
                                                     const ForecastWindow& window) {
  expects(models.mixture != nullptr, "a mixture model");
  constexpr int looks_per_note = 50;  // 0.5 s
  std::vector<Look> looks;
  encounter::ClosedLoop loop(stage);
  ParticleFilter filter(stage.scenario->perception, models.seed);
  MixturePredictor learnt(*models.mixture);
  for (int k = 0; !loop.truth().over(); ++k) {
    if (auto problem = loop.look()) {
      return *std::move(problem);
    }
    filter.look(loop.seen());
    learnt.look(loop.seen());
    if (k % looks_per_note == 0) {
      looks.push_back({loop.seen(), loop.beliefs(), places_by(filter, loop.seen()),
                       places_by(learnt, loop.seen()), loop.truth().whole_scene()});
    }
    loop.advance();
  }
  std::vector<ForecastSample> samples;
  // Of forecast_times in notes; the first note has none before it.
  constexpr std::array<std::size_t, forecast_times.size()> after{1, 2, 4, 6};
  for (std::size_t n = 1; n + after.back() < looks.size(); ++n) {
    const Look& look = looks[n];
    for (std::size_t i = 0; i < look.seen.actors.size(); ++i) {
      const Actor& actor = look.seen.actors[i];
      const auto now = true_place(look.truth, actor);
      const auto before = true_place(looks[n - 1].truth, actor);
      if (actor.kind == world::ActorKind::obstacle || !now || !before ||
          norm(actor.v_W) < intent::rest_speed ||
          !can_be_judged(stage, window, actor, *now, looks[n - 1].seen.time, look.seen.time)) {
        continue;
      }
      std::array<Vec2, forecast_times.size()> truth{};
      bool stays = true;
      for (std::size_t k = 0; k < after.size(); ++k) {
        const auto then = true_place(looks[n + after[k]].truth, actor);
        stays = stays && then.has_value();
        truth[k] = then.value_or(Vec2{});
      }
      if (stays) {
        samples.push_back(sample_of(look, i, truth, *now, *before));
      }
    }
  }
  return samples;
}

}  // namespace saca::eval
