#include "saca/loop/hindsight.h"

#include <utility>

#include "saca/manoeuvre/drive.h"
#include "saca/outcome/roll_out.h"

namespace saca::loop {

std::vector<Hindsights> hindsights(std::span<const Moment> moments, const manoeuvre::Car& car,
                                   const outcome::HarmModel& harm, int threads) {
  std::vector<Hindsights> all(moments.size());
  std::vector<outcome::Attempt> attempts;
  std::vector<Hindsight*> of_attempt;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const Moment& moment = moments[i];
    for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
      Hindsight& one = all[i][manoeuvre::index(policy)];
      one.facts.plan = moment.carried_out && moment.carried_out->policy == policy
                           ? *moment.carried_out
                           : manoeuvre::default_plan(policy, norm(moment.scene.ego.v_B));
      one.facts.refusal = manoeuvre::refusal(car, one.facts.plan, moment.scene).value_or("");
      one.facts.rolled_out = true;
      if (one.facts.refusal.empty()) {
        attempts.push_back(
            {one.facts.plan, &moment.scene, &moment.others, moment.grip, moment.unknown});
        of_attempt.push_back(&one);
      }
    }
  }
  std::vector<outcome::Course> courses = outcome::roll_out_all(car, attempts, harm, threads);
  for (std::size_t k = 0; k < courses.size(); ++k) {
    of_attempt[k]->course = std::move(courses[k]);
    preview::PolicyFacts& facts = of_attempt[k]->facts;
    facts.outcome = of_attempt[k]->course.outcome;
    facts.probability = facts.outcome.contact ? 1.0 : 0.0;
  }
  return all;
}

Hindsights hindsight(const Moment& moment, const manoeuvre::Car& car,
                     const outcome::HarmModel& harm) {
  return std::move(hindsights({&moment, 1}, car, harm).front());
}

}  // namespace saca::loop
