#include "saca/preview/policy_facts.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "saca/core/contract.h"
#include "saca/manoeuvre/drive.h"
#include "saca/outcome/atlas_way.h"
#include "saca/outcome/futures.h"
#include "saca/outcome/loss.h"
#include "saca/outcome/ordering.h"
#include "saca/outcome/roll_out.h"
#include "saca/preview/followers.h"

namespace saca::preview {
namespace {

using manoeuvre::Plan;
using manoeuvre::PolicyId;
using world::Scene;
using world::Track;

using AllFacts = std::array<PolicyFacts, manoeuvre::num_policies>;

/// Each policy with every target speed that it may have; the default comes first.
std::vector<Plan> all_plans(double speed) {
  std::vector<Plan> plans;
  for (const PolicyId policy : manoeuvre::all_policies) {
    if (!manoeuvre::brakes_to_speed(policy)) {
      plans.push_back({policy, std::nullopt});
      continue;
    }
    for (const double share : outcome::target_shares) {
      plans.push_back({policy, share * speed});
    }
  }
  return plans;
}

outcome::Outcome outcome_of(const outcome::Future& future) {
  return {.contact = future.contact,
          .collision_loss = future.contact ? outcome::collision_loss(future.contact->ego_face,
                                                                     future.contact->relative_speed)
                                           : 0.0,
          .harm = future.harm,
          .clearance = future.clearance,
          .end_time = future.end_time};
}

/// nullopt: outside the atlas.
std::optional<PolicyFacts> read(const Plan& plan, const Scene& scene, const outcome::Others& others,
                                const ForecastTools& tools) {
  if (tools.atlas->outside(plan, scene)) {
    return std::nullopt;
  }
  manoeuvre::EgoMotion way;
  outcome::atlas_way(*tools.atlas, plan, scene, outcome::usual_way, way.track);
  const std::vector<Track> tracks = others(way);
  const outcome::Future future = outcome::future(*tools.atlas, plan, scene, tracks, *tools.harm);
  if (future.outside) {
    return std::nullopt;
  }
  return PolicyFacts{.plan = plan, .refusal = {}, .outcome = outcome_of(future)};
}

std::string refusal_of(const Plan& plan, const Scene& scene, const ForecastTools& tools) {
  return manoeuvre::refusal(*tools.car, plan, scene).value_or("");
}

bool is_better(const PolicyFacts& a, const PolicyFacts& b) {
  return a.refusal.empty() && outcome::better(a.outcome, a.plan.policy, b.outcome, b.plan.policy);
}

/// All of those that can be driven, but for target speeds that the atlas does not have while it has
/// another of the policy; or none.
std::optional<std::vector<PolicyFacts>> all_read(const std::vector<Plan>& plans, const Scene& scene,
                                                 const outcome::Others& others,
                                                 const ForecastTools& tools) {
  if (tools.atlas == nullptr) {
    return std::nullopt;
  }
  std::vector<PolicyFacts> facts;
  for (const Plan& plan : plans) {
    std::string refusal = refusal_of(plan, scene, tools);
    if (!refusal.empty()) {
      facts.push_back({.plan = plan, .refusal = std::move(refusal), .outcome = {}});
      continue;
    }
    if (auto one = read(plan, scene, others, tools)) {
      facts.push_back(std::move(*one));
    }
  }
  const bool complete = std::all_of(
      manoeuvre::all_policies.begin(), manoeuvre::all_policies.end(), [&](PolicyId policy) {
        return std::any_of(facts.begin(), facts.end(),
                           [&](const PolicyFacts& fact) { return fact.plan.policy == policy; });
      });
  return complete ? std::optional(std::move(facts)) : std::nullopt;
}

}  // namespace

std::vector<PolicyFacts> rolled_out(const Scene& scene, const std::vector<Track>& tracks,
                                    std::span<const Plan> plans, const ForecastTools& tools) {
  expects(tools.car != nullptr && tools.harm != nullptr, "car and harm are given");
  const outcome::Others others = with_reacting_followers(scene, tracks);
  std::vector<PolicyFacts> facts;
  std::vector<outcome::Attempt> attempts;
  for (const Plan& plan : plans) {
    facts.push_back({.plan = plan,
                     .refusal = refusal_of(plan, scene, tools),
                     .outcome = {},
                     .rolled_out = true});
    if (facts.back().refusal.empty()) {
      attempts.push_back({plan, &scene, &others, scene.grip, {}});
    }
  }
  const auto courses = outcome::roll_out_all(*tools.car, attempts, *tools.harm);
  auto next = courses.begin();
  for (PolicyFacts& fact : facts) {
    if (fact.refusal.empty()) {
      fact.outcome = (next++)->outcome;
    }
  }
  return facts;
}

AllFacts policy_facts(const Scene& scene, const std::vector<Track>& tracks,
                      const ForecastTools& tools) {
  expects(tools.car != nullptr && tools.harm != nullptr, "car and harm are given");
  const std::vector<Plan> plans = all_plans(norm(scene.ego.v_B));
  auto facts = all_read(plans, scene, with_reacting_followers(scene, tracks), tools);
  if (!facts) {
    facts = rolled_out(scene, tracks, plans, tools);
  }
  AllFacts best;
  std::array<bool, manoeuvre::num_policies> found{};
  for (PolicyFacts& fact : *facts) {
    const std::size_t i = manoeuvre::index(fact.plan.policy);
    PolicyFacts& best_so_far = best[i];
    if (!found[i] || !best_so_far.refusal.empty() || is_better(fact, best_so_far)) {
      best_so_far = std::move(fact);
    }
    found[i] = true;
  }
  return best;
}

PolicyId best_by_forecast(const AllFacts& facts) {
  const PolicyFacts* best = &facts[manoeuvre::index(PolicyId::aeb)];
  for (const PolicyFacts& fact : facts) {
    if (is_better(fact, *best)) {
      best = &fact;
    }
  }
  return best->plan.policy;
}

}  // namespace saca::preview
