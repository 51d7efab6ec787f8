#include "saca/lab/encounter/hindsight.h"

#include <iterator>
#include <utility>

#include "saca/onboard/collision/ordering.h"
#include "saca/thinking/rollout/roll_out.h"

namespace saca::encounter {

std::vector<Hindsights> hindsights(std::span<const DecisionPoint> points, const manoeuvre::Car& car,
                                   const collision::HarmModel& harm, int threads) {
  std::vector<rollout::Attempt> attempts;
  for (const DecisionPoint& point : points) {
    for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
      const manoeuvre::Plan plan = point.carried_out && point.carried_out->policy == policy
                                       ? *point.carried_out
                                       : manoeuvre::default_plan(policy, norm(point.scene.ego.v_B));
      attempts.push_back({plan, &point.scene, &point.others, point.grip, point.perturbation});
    }
  }
  std::vector<Hindsight> tried = preview::tried(car, attempts, harm, threads);
  std::vector<Hindsights> all(points.size());
  for (std::size_t k = 0; k < tried.size(); ++k) {
    all[k / manoeuvre::num_policies][k % manoeuvre::num_policies] = std::move(tried[k]);
  }
  return all;
}

std::vector<std::vector<Hindsight>> all_plans_tried(std::span<const DecisionPoint> points,
                                                    const manoeuvre::Car& car,
                                                    const collision::HarmModel& harm,
                                                    forecast::Braking braking, int threads) {
  std::vector<rollout::Attempt> attempts;
  std::vector<std::size_t> num_plans;
  for (const DecisionPoint& point : points) {
    const forecast::Plans plans = forecast::all_plans(norm(point.scene.ego.v_B), braking);
    bool carried_out_stands = !point.carried_out;
    for (const manoeuvre::Plan& plan : plans) {
      const bool first = !carried_out_stands && point.carried_out->policy == plan.policy;
      carried_out_stands = carried_out_stands || first;
      attempts.push_back({first ? *point.carried_out : plan, &point.scene, &point.others,
                          point.grip, point.perturbation});
    }
    num_plans.push_back(plans.size());
  }
  std::vector<Hindsight> tried = preview::tried(car, attempts, harm, threads);
  std::vector<std::vector<Hindsight>> all;
  auto next = tried.begin();
  for (const std::size_t count : num_plans) {
    const auto end = next + static_cast<std::ptrdiff_t>(count);
    all.emplace_back(std::move_iterator(next), std::move_iterator(end));
    next = end;
  }
  return all;
}

Hindsights hindsight_of_all_speeds(const DecisionPoint& point, const manoeuvre::Car& car,
                                   const collision::HarmModel& harm) {
  std::vector<Hindsight> tried =
      std::move(all_plans_tried({&point, 1}, car, harm, forecast::Braking::full).front());
  std::array<std::optional<std::size_t>, manoeuvre::num_policies> best;
  for (std::size_t i = 0; i < tried.size(); ++i) {
    std::optional<std::size_t>& of_policy = best[manoeuvre::index(tried[i].facts.plan.policy)];
    const auto harm_of = [&](std::size_t one) {
      return collision::harm_class(tried[one].facts.outcome().harm);
    };
    if (!of_policy || (tried[i].facts.drivable() &&
                       (!tried[*of_policy].facts.drivable() || harm_of(i) < harm_of(*of_policy)))) {
      of_policy = i;
    }
  }
  Hindsights all;
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = std::move(tried[*best[i]]);
  }
  return all;
}

Hindsights hindsight(const DecisionPoint& point, const manoeuvre::Car& car,
                     const collision::HarmModel& harm) {
  return std::move(hindsights({&point, 1}, car, harm).front());
}

}  // namespace saca::encounter
