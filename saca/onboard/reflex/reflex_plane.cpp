#include "saca/onboard/reflex/reflex_plane.h"

#include <array>
#include <utility>

#include "saca/base/core/names.h"
#include "saca/onboard/collision/ordering.h"
#include "saca/onboard/manoeuvre/drive.h"

namespace saca::reflex {
namespace {

using manoeuvre::Plan;
using world::Scene;

constexpr std::array<std::string_view, 5> source_names{"fallback", "memory", "model", "forced",
                                                       "arbiter"};

bool is_fresh(const std::optional<Verdict>& verdict, const Scene& scene) {
  return verdict && verdict->time <= scene.time && scene.time - verdict->time <= verdict_expiry;
}

/// Does no verdict come? At real pace, of many road users, the next may be looked at 0.1 to 0.3 s
/// after the scene of the one before.
bool is_missing(const std::optional<Verdict>& verdict, const Scene& scene) {
  constexpr double longest = 0.3;  // [s]
  return !verdict || verdict->time > scene.time || scene.time - verdict->time > longest;
}

}  // namespace

std::string_view name(Source source) {
  return name_of(source, source_names);
}

bool was_needless(const Decision& decision) noexcept {
  return decision.source == Source::arbiter && !decision.not_admissible && decision.similarity &&
         *decision.similarity > match_similarity;
}

Decision ReflexPlane::decide(const Scene& scene) noexcept {
  Decision decision = tools_.forced ? as_asked_for(scene) : chosen(scene);
  const auto why = tools_.car == nullptr
                       ? std::nullopt
                       : manoeuvre::why_refused(*tools_.car, decision.plan, scene);
  if (why) {
    decision.refused = {decision.plan, *why};
    decision.plan = manoeuvre::full_braking;
    decision.source = Source::fallback;
  }
  return decision;
}

Decision ReflexPlane::as_asked_for(const Scene& scene) const noexcept {
  Decision decision{.plan = *tools_.forced, .source = Source::forced, .time = scene.time};
  if (manoeuvre::brakes_to_speed(decision.plan.policy) && !decision.plan.target_speed) {
    decision.plan = manoeuvre::default_plan(decision.plan.policy, norm(scene.ego.v_B));
  }
  return decision;
}

Decision ReflexPlane::chosen(const Scene& scene) noexcept {
  Decision decision{.plan = manoeuvre::full_braking, .time = scene.time};
  const bool guarded = tools_.guard != Guard::none;
  const CachedPlan* best = nullptr;
  const match::Features here = match::features(scene);
  for (const CachedPlan& cached : plans_) {
    if (guarded && scene.time > cached.trigger + plan_expiry) {
      continue;
    }
    const double similarity = match::similarity(here, cached.at_trigger);
    if (!decision.similarity || similarity > *decision.similarity) {
      decision.similarity = similarity;
      decision.preview = cached.preview;
      best = &cached;
    }
  }
  if (guarded && is_fresh(verdict_, scene)) {
    decision.verdict = verdict_;
  } else if (guarded && tools_.atlas) {
    decision.verdict = tools_.atlas->judge(scene);
    decision.by_atlas = decision.verdict.has_value();
  }
  const bool matches = best != nullptr && *decision.similarity > match_similarity;
  if (matches) {
    const Plan wanted = decision.verdict ? as_judged(*decision.verdict, best->plan)
                        : takes_strength(best->plan.policy) ? manoeuvre::full_braking
                                                            : best->plan;
    const bool admissible = !guarded           ? true
                            : decision.verdict ? admits(*decision.verdict, wanted)
                                               : !best->worse_than_aeb;
    decision.not_admissible = !admissible;
    // Nobody takes the wheel, at whosever word, where doing nothing is as good (plan_of).
    const bool needless =
        guarded && decision.verdict && admits(*decision.verdict, manoeuvre::doing_nothing);
    if (admissible && !needless) {
      decision.plan = wanted;
      decision.source = best->source;
    }
  }
  if (decision.source == Source::fallback && decision.verdict) {
    decision.plan = plan_of(*decision.verdict);
    decision.source = Source::arbiter;
  }
  return decision;
}

void ReflexPlane::begin(const Plan& plan, const Scene& scene) noexcept {
  under_way_ = UnderWay{
      .plan = plan, .begun = scene.time, .ego = scene.ego, .road = scene.road, .grip = scene.grip};
}

bool ReflexPlane::is_watched(const Scene& scene) const noexcept {
  return supervises() && tools_.thresholds.waiting_cost &&
         scene.time >= watched_at_ + look_ahead - rounding;
}

std::optional<Threat> ReflexPlane::foreseen(const Scene& scene,
                                            const TrackConfirmation& tracks) const noexcept {
  return measured_threat(scene, tools_.thresholds, tracks.confirmed());
}

bool ReflexPlane::agrees_with_last() noexcept {
  const double last = std::exchange(costly_at_, verdict_->time);
  return last < verdict_->time && verdict_->time <= last + look_ahead + verdict_expiry + rounding;
}

std::optional<Decision> ReflexPlane::decide_early(const Scene& scene,
                                                  const Threat& threat) noexcept {
  watched_at_ = scene.time;
  const auto cost = is_fresh(verdict_, scene) ? cost_of_waiting(*verdict_) : std::nullopt;
  if (cost && *cost <= *tools_.thresholds.waiting_cost) {
    costly_at_ = never;  // the next costly one stands alone again
  }
  if (!cost || *cost <= *tools_.thresholds.waiting_cost || !agrees_with_last()) {
    return std::nullopt;
  }
  Decision decision = decide(scene);
  decision.waiting_cost = cost;
  const bool leaves_lane = collision::milder(manoeuvre::PolicyId::aeb, decision.plan.policy);
  const bool is_too_early = leaves_lane && threat.time > tools_.thresholds.earliest_swerve;
  return decision.plan == manoeuvre::doing_nothing || is_too_early ? std::nullopt
                                                                   : std::optional(decision);
}

bool ReflexPlane::needs_verdict(const Scene& scene, bool finished) const noexcept {
  if (!supervises() || world::broken_rule(scene)) {
    return false;
  }
  TrackConfirmation tracks = tracks_;
  tracks.look(scene);
  const bool triggers = triggering_threat(scene, tools_.thresholds, tracks.confirmed()).has_value();
  if (under_way_) {
    return supervisor_.is_due(scene, *under_way_, triggers, finished);
  }
  return triggers || (is_watched(scene) && foreseen(scene, tracks));
}

std::optional<Switch> ReflexPlane::supervised(SupervisedScene now) noexcept {
  if (!is_fresh(verdict_, now.scene)) {
    return is_missing(verdict_, now.scene) ? supervised_by_atlas(now) : std::nullopt;
  }
  if (verdict_->time <= now.under_way.begun) {
    return std::nullopt;  // it was decided by this one, or knows no more
  }
  now.verdict = &*verdict_;
  return supervisor_.look(now, tools_.car);
}

std::optional<Switch> ReflexPlane::supervised_by_atlas(SupervisedScene now) noexcept {
  if (!may_do_more(now.under_way, now.finished) ||
      now.scene.time < judged_at_ + look_ahead - rounding ||
      !supervisor_.is_due(now.scene, now.under_way, now.triggers, now.finished)) {
    return std::nullopt;
  }
  judged_at_ = now.scene.time;
  const auto verdict = tools_.atlas ? tools_.atlas->judge(now.scene) : std::nullopt;
  if (verdict) {
    now.verdict = &*verdict;
    now.by_atlas = true;
    return supervisor_.look(now, tools_.car);
  }
  if (!is_idle(now.under_way, now.finished)) {
    return std::nullopt;
  }
  supervisor_.begin(now.scene);
  return Switch{.plan = manoeuvre::full_braking, .reason = SwitchReason::cannot_be_judged};
}

Reflex ReflexPlane::step(const Scene& scene, bool finished) noexcept {
  Reflex reflex;
  if (under_way_) {
    reflex.plan = under_way_->plan;
  }
  if (world::broken_rule(scene)) {
    reflex.refused_scene = true;
    return reflex;
  }
  tracks_.look(scene);
  const auto trigger = triggering_threat(scene, tools_.thresholds, tracks_.confirmed());
  reflex.threat = trigger ? trigger
                          : nearest_threat(scene, tools_.thresholds.preview,
                                           tools_.thresholds.trigger_tolerance);
  if (!decision_ && trigger) {
    decision_ = decide(scene);
  } else if (!decision_ && is_watched(scene)) {
    if (const auto threat = foreseen(scene, tracks_)) {
      decision_ = decide_early(scene, *threat);
      reflex.threat = decision_ ? threat : reflex.threat;
    }
  }
  if (decision_ && !under_way_) {
    begin(decision_->plan, scene);
    supervisor_.begin(scene);
    reflex.plan = decision_->plan;
    reflex.triggered = true;
    return reflex;
  }
  if (under_way_ && supervises()) {
    reflex.switched = supervised({.scene = scene,
                                  .under_way = *under_way_,
                                  .threatened = reflex.threat.has_value(),
                                  .triggers = trigger.has_value(),
                                  .finished = finished});
    if (reflex.switched) {
      begin(reflex.switched->plan, scene);
      reflex.plan = reflex.switched->plan;
    }
  }
  return reflex;
}

}  // namespace saca::reflex
