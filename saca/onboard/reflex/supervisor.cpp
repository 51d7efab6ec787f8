#include "saca/onboard/reflex/supervisor.h"

#include <algorithm>
#include <array>

#include "saca/base/core/names.h"
#include "saca/base/world/time_to_conflict.h"
#include "saca/onboard/collision/ordering.h"
#include "saca/onboard/manoeuvre/drive.h"

namespace saca::reflex {
namespace {

using manoeuvre::Plan;
using manoeuvre::PolicyId;
using world::Scene;

constexpr std::array<std::string_view, 5> reason_names{
    "needed after all", "no longer needed", "better by far", "harder needed", "cannot be judged"};
constexpr double rest_speed = 0.5;  // [m/s]

double harm_of_going_on(const SupervisedScene& now) {
  const JudgedPlan* const rest = going_on(*now.verdict, now.under_way.plan);
  return rest == nullptr ? 0.0 : rest->harm;
}

/// Braking that is harder than what is under way.
bool is_harder(const Plan& plan, const Plan& under_way) {
  return plan.policy == PolicyId::aeb && under_way.policy == PolicyId::aeb &&
         strength_of(plan) > strength_of(under_way);
}

/// Does another plan take the place of what is under way? A lane change to another speed does not.
bool is_another(const Plan& plan, const Plan& under_way) {
  return plan.policy != under_way.policy ||
         (plan.policy == PolicyId::aeb && strength_of(plan) < strength_of(under_way));
}

double harm_of(const Verdict& verdict, const Plan& plan) {
  const JudgedPlan* const judged = find_plan(verdict, plan);
  return judged == nullptr ? 0.0 : judged->harm;
}

/// What the verdict speaks for, where nothing is under way and the trigger's rule fires.
std::optional<Switch> needed_after_all(const SupervisedScene& now) {
  const Plan wanted = plan_of(*now.verdict);
  if (wanted.policy == PolicyId::no_intervention || !now.triggers) {
    return std::nullopt;
  }
  return Switch{.plan = wanted,
                .reason = SwitchReason::needed_after_all,
                .harm = harm_of(*now.verdict, wanted),
                .harm_before = harm_of(*now.verdict, manoeuvre::doing_nothing)};
}

/// Harder braking, where that is expected to harm less than going on.
std::optional<Switch> harder(const SupervisedScene& now) {
  const JudgedPlan* const best = best_braking(*now.verdict);
  const double before = harm_of_going_on(now);
  if (best == nullptr || !is_harder(best->plan, now.under_way.plan) ||
      best->harm + collision::harm_tie >= before) {
    return std::nullopt;
  }
  return Switch{.plan = best->plan,
                .reason = SwitchReason::harder_needed,
                .harm = best->harm,
                .harm_before = before};
}

}  // namespace

std::string_view name(SwitchReason reason) {
  return name_of(reason, reason_names);
}

bool is_idle(const UnderWay& under_way, bool finished) noexcept {
  return under_way.plan.policy == PolicyId::no_intervention || finished;
}

bool may_do_more(const UnderWay& under_way, bool finished) noexcept {
  return is_idle(under_way, finished) || is_harder(manoeuvre::full_braking, under_way.plan);
}

const JudgedPlan* going_on(const Verdict& verdict, const Plan& under_way) noexcept {
  if (!has_past(under_way)) {
    return find_plan(verdict, under_way);
  }
  return verdict.under_way ? &*verdict.under_way : nullptr;
}

bool Supervisor::is_due(const Scene& scene, const UnderWay& under_way, bool triggers,
                        bool finished) const noexcept {
  constexpr double rounding = 1e-9;  // [s]
  if (norm(scene.ego.v_B) < rest_speed || scene.time < looked_at_ + period - rounding) {
    return false;
  }
  return !is_idle(under_way, finished) || triggers;
}

void Supervisor::begin(const Scene& scene) noexcept {
  *this = {};
  note(scene);
}

void Supervisor::note(const Scene& scene) noexcept {
  known_.clear();
  for (const world::Actor& actor : scene.actors) {
    known_.push_back({actor.kind, actor.id});
  }
}

bool Supervisor::somebody_came(const Scene& scene) const noexcept {
  return std::any_of(scene.actors.begin(), scene.actors.end(), [&](const world::Actor& actor) {
    return std::none_of(known_.begin(), known_.end(), [&](const Name& name) {
      return name.kind == actor.kind && name.id == actor.id;
    });
  });
}

std::optional<Switch> Supervisor::better(const SupervisedScene& now) noexcept {
  const JudgedPlan* const least = least_harmful(*now.verdict);
  const Plan wanted = plan_of(*now.verdict);  // as good as the least, as far as can be told
  const double harm = harm_of(*now.verdict, wanted);
  const double before = harm_of_going_on(now);
  const bool is_better = least != nullptr && least->harm + material_harm <= before &&
                         harm < before && !manoeuvre::drifts(now.under_way.plan.policy);
  const bool twice = is_better && better_before_ == wanted.policy;
  better_before_ = is_better ? std::optional(wanted.policy) : std::nullopt;
  if (!twice || !is_another(wanted, now.under_way.plan) ||
      (switched_ && !somebody_came(now.scene))) {
    return std::nullopt;
  }
  return Switch{
      .plan = wanted, .reason = SwitchReason::better_by_far, .harm = harm, .harm_before = before};
}

std::optional<Switch> Supervisor::look(const SupervisedScene& now,
                                       const manoeuvre::Car* car) noexcept {
  if (!is_due(now.scene, now.under_way, now.triggers, now.finished) ||
      now.verdict->time <= verdict_at_) {
    return std::nullopt;
  }
  if (!now.by_atlas) {  // the forecaster's next is looked at as soon as it comes
    looked_at_ = now.scene.time;
    verdict_at_ = now.verdict->time;
  }
  const PolicyId policy = now.under_way.plan.policy;
  const bool is_clear = plan_of(*now.verdict).policy == PolicyId::no_intervention &&
                        find_plan(*now.verdict, manoeuvre::doing_nothing)->contact == 0.0;
  std::optional<Switch> change;
  if (!is_clear) {
    clear_since_.reset();
  }
  if (is_idle(now.under_way, now.finished)) {
    change = needed_after_all(now);
  } else if (now.by_atlas) {
    change = harder(now);
  } else if (is_clear && policy == PolicyId::aeb) {
    clear_since_ = clear_since_.value_or(now.verdict->time);
    if (now.verdict->time >= *clear_since_ + clear_time && !now.threatened) {
      change = Switch{.plan = manoeuvre::doing_nothing, .reason = SwitchReason::no_longer_needed};
    } else {
      change = better(now);
    }
  } else {
    change = better(now);
    if (!change) {
      change = harder(now);
    }
  }
  if (change && car != nullptr && manoeuvre::why_refused(*car, change->plan, now.scene)) {
    return std::nullopt;
  }
  if (change && change->reason != SwitchReason::harder_needed) {
    switched_ = switched_ || change->reason == SwitchReason::better_by_far;
    clear_since_.reset();
    better_before_.reset();
    note(now.scene);
  }
  return change;
}

}  // namespace saca::reflex
