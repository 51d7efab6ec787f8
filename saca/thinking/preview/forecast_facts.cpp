#include "saca/thinking/preview/forecast_facts.h"
#include "saca/thinking/rollout/collision_sequence.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/onboard/collision/ordering.h"
#include "saca/onboard/forecast/atlas_way.h"
#include "saca/onboard/forecast/futures.h"
#include "saca/onboard/manoeuvre/drive.h"
#include "saca/onboard/reflex/followers.h"

namespace saca::preview {
namespace {

using manoeuvre::Plan;
using manoeuvre::PolicyId;
using world::Scene;
using world::SpreadOverTime;
using world::Track;

collision::Outcome outcome_of(const forecast::Future& future) {
  return {.contact = future.contact,
          .collision_loss = future.collision_loss,
          .harm = future.harm,
          .clearance = future.clearance,
          .nearest = future.nearest,
          .end_time = future.end_time};
}

/// The atlas' futures of some plans, while the followers react.
class FollowedFutures {
 public:
  FollowedFutures(const Scene& scene, const std::vector<Track>& tracks, const ForecastTools& tools,
                  std::vector<SpreadOverTime> spreads)
      : followers_(reflex::followers_of(scene)),
        scene_(reflex::with_kept_gaps(scene, followers_)),
        tools_(tools),
        moved_(tracks),
        spreads_(std::move(spreads)) {}

  [[nodiscard]] bool followed() const { return !followers_.empty(); }

  forecast::Future of(const Plan& plan) {
    forecast::Future one{.plan = plan};
    one.outside = tools_.atlas->outside(plan, scene_);
    if (one.outside) {
      return one;
    }
    if (followed()) {
      constexpr double step = 1.0 / 16.0;  // [s] of who reacts
      Track X_WB;
      forecast::atlas_way(*tools_.atlas, plan, scene_, forecast::usual_way, X_WB);
      reflex::let_react(scene_, followers_, X_WB, world::end_time(X_WB) + reflex::watched_after,
                        step, moved_);
    }
    return forecast::future(*tools_.atlas, plan, scene_, moved_, *tools_.harm,
                            {.spreads = spreads_});
  }

 private:
  reflex::Followers followers_;
  Scene scene_;
  const ForecastTools& tools_;
  std::vector<Track> moved_;
  std::vector<SpreadOverTime> spreads_;
};

/// What the atlas has of each policy: of 3 and 4 of the best of their target speeds, of 0 of the
/// best of its strengths.
forecast::Futures read(const Scene& scene, const std::vector<Track>& tracks,
                       const ForecastTools& tools, const std::vector<SpreadOverTime>& spreads) {
  FollowedFutures futures(scene, tracks, tools, spreads);
  if (!futures.followed()) {
    return forecast::futures(*tools.atlas, scene, tracks, *tools.harm,
                             {.strengths = forecast::strengths_of(tools.braking)},
                             {.spreads = spreads});
  }
  forecast::Futures best;
  std::array<bool, manoeuvre::num_policies> found{};
  for (const Plan& plan : forecast::all_plans(scene.ego.v_B.x, tools.braking)) {
    const forecast::Future one = futures.of(plan);
    const std::size_t i = manoeuvre::index(plan.policy);
    if (!found[i] || forecast::better(one, best[i])) {
      best[i] = one;
    }
    found[i] = true;
  }
  return best;
}

/// nullopt: it can be driven, and the atlas does not have it.
std::optional<PolicyFacts> facts_of(const forecast::Future& future, const Scene& scene,
                                    const ForecastTools& tools) {
  if (auto refusal = manoeuvre::refusal(*tools.car, future.plan, scene)) {
    return PolicyFacts{future.plan, Refusal{*std::move(refusal)}};
  }
  if (future.outside) {
    return std::nullopt;
  }
  return PolicyFacts{future.plan, ExpectedOutcome{outcome_of(future), future.probability}};
}

/// nullopt: the atlas does not have all that can be driven.
std::optional<AllFacts> read_facts(const Scene& scene, const std::vector<Track>& tracks,
                                   const ForecastTools& tools,
                                   const std::vector<SpreadOverTime>& spreads) {
  const forecast::Futures futures = read(scene, tracks, tools, spreads);
  AllFacts facts;
  for (std::size_t i = 0; i < facts.size(); ++i) {
    auto one = facts_of(futures[i], scene, tools);
    if (!one) {
      return std::nullopt;
    }
    facts[i] = std::move(*one);
  }
  return facts;
}

}  // namespace

std::optional<std::vector<PolicyFacts>> read_plans(const Scene& scene,
                                                   const std::vector<Track>& tracks,
                                                   std::span<const Plan> plans,
                                                   const ForecastTools& tools) {
  expects(tools.car != nullptr && tools.harm != nullptr, "car and harm are given");
  if (tools.atlas == nullptr) {
    return std::nullopt;
  }
  FollowedFutures futures(scene, tracks, tools, {});
  std::vector<PolicyFacts> facts;
  for (const Plan& plan : plans) {
    auto one = facts_of(futures.of(plan), scene, tools);
    if (!one) {
      return std::nullopt;
    }
    facts.push_back(std::move(*one));
  }
  return facts;
}

std::vector<RolledOut> tried(const manoeuvre::Car& car, std::span<const rollout::Attempt> attempts,
                             const collision::HarmModel& harm, int threads) {
  std::vector<RolledOut> all(attempts.size());
  std::vector<rollout::Attempt> driven;
  for (std::size_t i = 0; i < attempts.size(); ++i) {
    const rollout::Attempt& attempt = attempts[i];
    expects(attempt.scene != nullptr, "an attempt has a scene");
    all[i].facts.plan = attempt.plan;
    if (auto refusal = manoeuvre::refusal(car, attempt.plan, *attempt.scene)) {
      all[i].facts.end = Refusal{*std::move(refusal)};
    } else {
      driven.push_back(attempt);
    }
  }
  std::vector<rollout::CollisionSequence> sequences = roll_out_all(car, driven, harm, threads);
  auto next = sequences.begin();
  for (auto& [facts, sequence] : all) {
    if (facts.drivable()) {
      sequence = std::move(*next++);
      facts.end = RolledOutcome{sequence.outcome};
    }
  }
  return all;
}

std::vector<PolicyFacts> rolled_out(const Scene& scene, const std::vector<Track>& tracks,
                                    std::span<const Plan> plans, const ForecastTools& tools) {
  expects(tools.car != nullptr && tools.harm != nullptr, "car and harm are given");
  const collision::Others others = reflex::with_reacting_followers(scene, tracks);
  std::vector<rollout::Attempt> attempts;
  for (const Plan& plan : plans) {
    attempts.push_back({plan, &scene, &others, scene.grip, {}});
  }
  std::vector<PolicyFacts> facts;
  for (RolledOut& one : tried(*tools.car, attempts, *tools.harm)) {
    facts.push_back(std::move(one.facts));
  }
  return facts;
}

AllFacts policy_facts(const Scene& scene, const std::vector<Track>& tracks,
                      const ForecastTools& tools, const std::vector<SpreadOverTime>& spreads) {
  expects(tools.car != nullptr && tools.harm != nullptr, "car and harm are given");
  expects(spreads.empty() || spreads.size() == scene.actors.size(), "one spread per actor");
  if (tools.atlas != nullptr) {
    if (auto facts = read_facts(scene, tracks, tools, spreads)) {
      return *facts;
    }
  }
  AllFacts best;
  std::array<bool, manoeuvre::num_policies> found{};
  for (PolicyFacts& fact :
       rolled_out(scene, tracks, forecast::all_plans(scene.ego.v_B.x, tools.braking), tools)) {
    const std::size_t i = manoeuvre::index(fact.plan.policy);
    if (!found[i] || better(fact, best[i])) {
      best[i] = std::move(fact);
    }
    found[i] = true;
  }
  return best;
}

PolicyId best_by_forecast(const AllFacts& facts) {
  const PolicyFacts* best = &facts[manoeuvre::index(PolicyId::aeb)];
  for (const PolicyFacts& fact : facts) {
    if (better(fact, *best)) {
      best = &fact;
    }
  }
  return best->plan.policy;
}

}  // namespace saca::preview
