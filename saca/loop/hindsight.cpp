#include "saca/loop/hindsight.h"

#include "saca/manoeuvre/drive.h"

namespace saca::loop {

std::array<Hindsight, manoeuvre::num_policies> hindsight(const world::Scene& at_trigger,
                                                         const outcome::Others& others, double grip,
                                                         const manoeuvre::Car& car,
                                                         const outcome::HarmModel& harm,
                                                         const manoeuvre::Unknown& unknown) {
  std::array<Hindsight, manoeuvre::num_policies> all;
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    auto& [facts, course] = all[manoeuvre::index(policy)];
    facts.plan = manoeuvre::default_plan(policy, norm(at_trigger.ego.v_B));
    facts.refusal = manoeuvre::refusal(car, facts.plan, at_trigger).value_or("");
    if (facts.refusal.empty()) {
      course = outcome::roll_out(car, facts.plan, at_trigger, others, grip, harm, unknown);
      facts.outcome = course.outcome;
    }
  }
  return all;
}

}  // namespace saca::loop
