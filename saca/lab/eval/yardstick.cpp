#include "saca/lab/eval/yardstick.h"

#include "saca/base/core/contract.h"

namespace saca::eval {

std::vector<preview::RolledOut> try_all(const encounter::ClosedLoop& now, const manoeuvre::Car& car,
                                        const collision::HarmModel& harm, Knowledge knowledge) {
  const sim::Stepper& truth = now.truth();
  world::Scene scene = truth.whole_scene();
  scene.grip = now.seen().grip;
  const collision::Others others = truth.others();
  const bool all = knowledge == Knowledge::everything;
  std::vector<rollout::Attempt> attempts;
  for (const manoeuvre::Plan& plan : forecast::all_plans(scene.ego.v_B.x)) {
    attempts.push_back({plan, &scene, &others, all ? truth.grip() : scene.grip,
                        all ? truth.perturbation_from_now() : manoeuvre::ParameterPerturbation{}});
  }
  return preview::tried(car, attempts, harm);
}

std::size_t best_of(const std::vector<preview::RolledOut>& tried, forecast::Braking braking) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < tried.size(); ++i) {
    const preview::PolicyFacts& one = tried[i].facts;
    if (!one.drivable() || (braking == forecast::Braking::full && one.plan.strength)) {
      continue;
    }
    if (!best || preview::better(one, tried[*best].facts)) {
      best = i;
    }
  }
  expects(best.has_value(), "full braking can always be driven");
  return *best;
}

const std::vector<preview::RolledOut>& Hindsight::at(const encounter::ClosedLoop& now) {
  if (time_ != now.time()) {
    tried_ = try_all(now, car_, harm_, Knowledge::everything);
    time_ = now.time();
  }
  return tried_;
}

}  // namespace saca::eval
