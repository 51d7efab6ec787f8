#include "saca/lab/eval/danger_choice.h"

#include <algorithm>
#include <limits>

#include "saca/base/core/contract.h"
#include "saca/lab/learned_danger/acting.h"
#include "saca/lab/learned_danger/perceived.h"
#include "saca/onboard/manoeuvre/drive.h"
#include "saca/onboard/reflex/verdict.h"
#include "saca/thinking/arbitration/forecaster.h"
#include "saca/thinking/preview/forecast_danger.h"

namespace saca::eval {

using manoeuvre::Plan;
using world::Scene;

Plan of_least_danger(const Scene& scene, const std::vector<Plan>& plans, const manoeuvre::Car& car,
                     const learned_danger::Network& network, Beside beside) {
  expects(!plans.empty(), "a plan to choose");
  const std::vector<world::Track> tracks = preview::all_going_on(scene).tracks;
  const preview::DangerOfScene value = [&](const Scene& then) {
    const learned_danger::State state = learned_danger::most_dangerous(network, car, then);
    return beside == Beside::all
               ? learned_danger::joint_v(network, then.ego_footprint, state)
               : learned_danger::highest_single_v(network, then.ego_footprint, state);
  };
  Plan least = plans.front();
  double least_q = std::numeric_limits<double>::infinity();
  for (const Plan& plan : plans) {
    const auto q = preview::plan_danger(scene, tracks, plan, car, value);
    if (q && *q < least_q) {
      least = plan;
      least_q = *q;
    }
  }
  return least;
}

std::vector<Plan> drivable_plans(const manoeuvre::Car& car, const Scene& scene) {
  std::vector<Plan> plans;
  for (const Plan& plan : forecast::all_plans(scene.ego.v_B.x)) {
    if (!manoeuvre::why_refused(car, plan, scene)) {
      plans.push_back(plan);
    }
  }
  return plans;
}

std::vector<Plan> admissible_plans(const std::vector<preview::ExpectedHarm>& all) {
  reflex::Verdict verdict;
  for (const preview::ExpectedHarm& one : all) {
    verdict.plans.push_back(arbitration::judged(one));
  }
  std::vector<Plan> plans;
  for (const reflex::JudgedPlan& one : verdict.plans) {
    if (reflex::admits(verdict, one.plan)) {
      plans.push_back(one.plan);
    }
  }
  return plans.empty() ? std::vector{manoeuvre::full_braking} : plans;
}

}  // namespace saca::eval
