#include "saca/thinking/arbitration/forecaster.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/thinking/preview/drawn_motions.h"
#include "saca/thinking/preview/supposed.h"
#include "saca/thinking/rollout/batch.h"

namespace saca::arbitration {
namespace {

using manoeuvre::EgoMotion;
using world::LanePose;
using world::Scene;

constexpr double settling_time = 0.5;  // [s], assumption: after which 1/e of what the controller
                                       // was off its way is left
constexpr double longest_rest = 20.0;  // [s] of a way

/// What is left of the way that was meant, from where the ego is: what it is ahead along the lane
/// it stays ahead, and across and in direction it comes back onto the way.
EgoMotion rest_of(const reflex::UnderWay& under_way, const Scene& scene,
                  const manoeuvre::Car& car) {
  const double since = scene.time - under_way.begun;
  const double longest = since + longest_rest;
  Scene then;
  then.time = under_way.begun;
  then.ego = under_way.ego;
  then.road = under_way.road;
  then.grip = under_way.grip;
  const rollout::Drive drive = rollout::drive_from(car, under_way.plan, then, longest);
  const EgoMotion meant = rollout::drive_all({&drive, 1}, longest).front();
  const auto first = std::min(static_cast<std::size_t>(std::lround(since / meant.track.step)),
                              meant.track.X_WA.size() - 1);
  const LanePose here = to_lane(under_way.road, scene.ego.X_WB);
  const LanePose wanted = to_lane(under_way.road, meant.track.X_WA[first]);
  EgoMotion rest{.track = {.start = scene.time, .step = meant.track.step, .X_WA = {}},
                 .ended = meant.ended};
  for (std::size_t k = first; k < meant.track.X_WA.size(); ++k) {
    const double left =
        std::exp(-static_cast<double>(k - first) * meant.track.step / settling_time);
    LanePose at = to_lane(under_way.road, meant.track.X_WA[k]);
    at.s += here.s - wanted.s;
    at.d += left * (here.d - wanted.d);
    at.heading += left * wrap_angle(here.heading - wanted.heading);
    rest.track.X_WA.push_back(from_lane(under_way.road, at));
  }
  const auto kept = static_cast<std::ptrdiff_t>(first);
  rest.v_B.assign(meant.v_B.begin() + kept, meant.v_B.end());
  rest.yaw_rate.assign(meant.yaw_rate.begin() + kept, meant.yaw_rate.end());
  return rest;
}

/// `plan`, the next gentler way to brake, and all that are harder; of full braking that alone.
forecast::Plans not_much_gentler(const manoeuvre::Plan& plan, double speed) {
  forecast::Plans braking;
  bool is_next = strength_of(plan) < 1.0;
  for (const manoeuvre::Plan& one : forecast::all_plans(speed)) {  // hardest first
    const bool gentler = strength_of(one) < strength_of(plan);
    if (one.policy == plan.policy && (!gentler || is_next)) {
      braking.push_back(one);
      is_next = is_next && !gentler;
    }
  }
  return braking;
}

/// Full braking, and the few plans that harm least now: one of them is the best a moment later.
forecast::Plans candidates_for_later(const reflex::Verdict& verdict) {
  constexpr std::size_t most = 5;
  std::vector<reflex::JudgedPlan> by_harm;
  for (const reflex::JudgedPlan& one : verdict.plans) {
    if (one.drivable && one.plan != manoeuvre::full_braking) {
      by_harm.push_back(one);
    }
  }
  std::stable_sort(
      by_harm.begin(), by_harm.end(),
      [](const reflex::JudgedPlan& a, const reflex::JudgedPlan& b) { return a.harm < b.harm; });
  forecast::Plans plans;
  plans.push_back(manoeuvre::full_braking);
  for (const reflex::JudgedPlan& one : by_harm) {
    if (plans.size() < most) {
      plans.push_back(one.plan);
    }
  }
  return plans;
}

/// Likewise Verdict::later, before strengths are spread.
std::optional<double> least_harm_later(const reflex::Verdict& verdict,
                                       const preview::PreparedMotions& motions) {
  const reflex::JudgedPlan* const nothing = reflex::find_plan(verdict, manoeuvre::doing_nothing);
  if (nothing != nullptr && nothing->drivable && nothing->harm == 0.0) {
    return 0.0;  // as a moment later
  }
  const forecast::Plans plans = candidates_for_later(verdict);
  std::optional<double> least;
  for (const preview::ExpectedHarm& one :
       motions.harms_later(reflex::waited, {plans.begin(), plans.size()})) {
    if (one.refusal.empty()) {
      least = std::min(one.harm, least.value_or(one.harm));
    }
  }
  return least;
}

/// Waiting costs this much, whatever has become of the plans' harms since it was worked out.
void keep_waiting_cost(reflex::Verdict& verdict, const std::optional<double>& cost) {
  const reflex::JudgedPlan* const best = reflex::least_harmful(verdict);
  verdict.later.reset();
  if (cost && best != nullptr) {
    verdict.later = std::max(0.0, best->harm + *cost);
  }
}

reflex::JudgedPlan judged_by_half(const preview::ExpectedHarm& one) {
  return {.plan = one.plan,
          .drivable = one.refusal.empty(),
          .harm = one.harm_by_half,
          .contact = one.contact_by_half};
}

// ---- What cues of a scene stand for

/// Where doing nothing is admissible: the one plan that takes no wheel.
bool speaks_for_nothing(const reflex::Verdict& verdict) {
  return reflex::plan_of(verdict) == manoeuvre::doing_nothing;
}

/// Adds what a supposition makes of each plan: its harm there less that as seen, by the same draws,
/// as likely as it is. Who tries there what cannot be driven slides on: it counts as doing nothing
/// does.
void mix_in(reflex::Verdict& verdict, const reflex::Verdict& as_seen,
            const reflex::Verdict& supposed, double probability) {
  const reflex::JudgedPlan* const sliding = reflex::find_plan(supposed, manoeuvre::doing_nothing);
  const auto mix = [&](reflex::JudgedPlan& one, const reflex::JudgedPlan& seen,
                       const reflex::JudgedPlan* other) {
    if (other == nullptr || !other->drivable) {
      other = sliding;
    }
    if (one.drivable && other != nullptr && other->drivable) {
      one.harm += probability * (other->harm - seen.harm);
      one.contact += probability * (other->contact - seen.contact);
    }
  };
  for (std::size_t i = 0; i < verdict.plans.size(); ++i) {
    mix(verdict.plans[i], as_seen.plans[i], reflex::find_plan(supposed, verdict.plans[i].plan));
  }
  if (verdict.under_way && supposed.under_way) {
    mix(*verdict.under_way, *as_seen.under_way, &*supposed.under_way);
  }
}

}  // namespace

std::vector<preview::JointMotion> draws_of(const Scene& scene, const intent::Beliefs& beliefs,
                                           std::size_t num_draws) {
  return preview::drawn_motions(scene, beliefs, intent::MotionLaw{}, num_draws);
}

double judgements_of(const Scene& scene, const intent::Beliefs& beliefs,
                     const intent::CueLaw* law) {
  constexpr double share = 0.6;  // of a whole verdict's time that half of the draws take, measured
  return law == nullptr || scene.cues.empty()
             ? 1.0
             : 1.0 +
                   share * static_cast<double>(preview::suppositions(scene, beliefs, *law).size());
}

Forecaster::Forecaster(const preview::ForecastTools& tools, std::size_t num_draws)
    : tools_(tools), num_draws_(num_draws) {
  expects(tools.car != nullptr && tools.harm != nullptr, "car and harm are given");
  expects(num_draws >= 1, "at least one draw");
}

reflex::Verdict Forecaster::judge(const Scene& scene, const intent::Beliefs& beliefs,
                                  const std::optional<reflex::UnderWay>& under_way) const {
  const preview::Suppositions all = tools_.cues == nullptr || scene.cues.empty()
                                        ? preview::Suppositions()
                                        : preview::suppositions(scene, beliefs, *tools_.cues);
  const Depth of_seen{.half = false, .later = true, .may_be_short = all.empty()};
  const BothDepths seen = judge_as_seen(scene, beliefs, under_way, of_seen);
  if (all.empty() || speaks_for_nothing(seen.verdict)) {
    return seen.verdict;
  }
  reflex::Verdict verdict = seen.verdict;
  const auto note = [](reflex::JudgedPlan& one) {
    one.as_seen = one.drivable ? std::optional(one.harm) : std::nullopt;
  };
  std::for_each(verdict.plans.begin(), verdict.plans.end(), note);
  if (verdict.under_way) {
    note(*verdict.under_way);
  }
  const Depth of_supposed{.half = true, .later = false, .may_be_short = false};
  for (const preview::Supposition& one : all) {
    reflex::Verdict supposed =
        judge_as_seen(one.scene, one.beliefs, under_way, of_supposed).verdict;
    if (one.is_slippery) {
      supposed.under_way.reset();
    }
    mix_in(verdict, seen.by_half, supposed, one.probability);
  }
  keep_waiting_cost(verdict, reflex::cost_of_waiting(seen.verdict));
  return verdict;
}

Forecaster::BothDepths Forecaster::judge_as_seen(const Scene& scene, const intent::Beliefs& beliefs,
                                                 const std::optional<reflex::UnderWay>& under_way,
                                                 const Depth& depth) const {
  auto draws = draws_of(scene, beliefs, num_draws_);
  draws.resize(depth.half ? (num_draws_ + 1) / 2 : num_draws_);
  const preview::PreparedMotions motions(scene, draws, tools_);
  BothDepths both{.verdict = {.time = scene.time}, .by_half = {.time = scene.time}};
  reflex::Verdict& verdict = both.verdict;
  const auto judge_plans = [&](std::span<const manoeuvre::Plan> plans) {
    for (const preview::ExpectedHarm& one : motions.harms(plans)) {
      verdict.plans.push_back(judged(one));
      both.by_half.plans.push_back(judged_by_half(one));
    }
  };
  if (depth.may_be_short && under_way && under_way->plan.policy == manoeuvre::PolicyId::aeb) {
    const forecast::Plans braking = not_much_gentler(under_way->plan, scene.ego.v_B.x);
    judge_plans({braking.begin(), braking.size()});
    reflex::spread_over_strengths(verdict);
    if (reflex::find_plan(verdict, under_way->plan)->harm < reflex::material_harm) {
      judge_plans({&manoeuvre::doing_nothing, 1});
      return both;
    }
    verdict.plans.clear();
    both.by_half.plans.clear();
  }
  const forecast::Plans plans = forecast::all_plans(scene.ego.v_B.x, tools_.braking);
  judge_plans({plans.begin(), plans.size()});
  if (depth.later && !under_way) {
    verdict.later = least_harm_later(verdict, motions);
  }
  const auto cost = reflex::cost_of_waiting(verdict);
  reflex::spread_over_strengths(verdict);
  reflex::spread_over_strengths(both.by_half);
  keep_waiting_cost(verdict, cost);
  if (under_way && reflex::has_past(under_way->plan)) {
    preview::ExpectedHarm rest = motions.harm(rest_of(*under_way, scene, *tools_.car));
    rest.plan = under_way->plan;
    verdict.under_way = judged(rest);
    both.by_half.under_way = judged_by_half(rest);
  }
  return both;
}

reflex::JudgedPlan judged(const preview::ExpectedHarm& one) {
  return {
      .plan = one.plan, .drivable = one.refusal.empty(), .harm = one.harm, .contact = one.contact};
}

Judge judge_with(const preview::ForecastTools& tools) {
  return
      [forecaster = Forecaster(tools)](const auto&... seen) { return forecaster.judge(seen...); };
}

}  // namespace saca::arbitration
