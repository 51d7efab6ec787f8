#include "saca/loop/hindsight.h"

#include <algorithm>

namespace saca::loop {
namespace {

constexpr double horizon = 10.0;  // [s], as outcome::roll_out: any stop, any lane change

/// Nobody drives on as if nothing had happened: the motion ends where somebody was hit.
void cut_at(manoeuvre::EgoMotion& motion, double time) {
  const double steps = (time - motion.track.start) / motion.track.step;
  const auto keep = std::min(motion.track.X_WA.size(), static_cast<std::size_t>(steps) + 1);
  motion.track.X_WA.resize(keep);
  motion.v_B.resize(keep);
  motion.yaw_rate.resize(keep);
}

}  // namespace

std::array<Hindsight, manoeuvre::num_policies> hindsight(const world::Scene& at_trigger,
                                                         const outcome::Others& others, double grip,
                                                         const manoeuvre::Car& car,
                                                         const outcome::HarmModel& harm) {
  std::array<Hindsight, manoeuvre::num_policies> all;
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    Hindsight& one = all[manoeuvre::index(policy)];
    one.facts.plan = manoeuvre::default_plan(policy, norm(at_trigger.ego.v_B));
    one.facts.refusal = manoeuvre::refusal(car, one.facts.plan, at_trigger).value_or("");
    if (!one.facts.refusal.empty()) {
      continue;
    }
    one.motion = manoeuvre::drive(car, one.facts.plan, at_trigger, grip, horizon);
    one.facts.outcome = outcome::judge(one.motion, at_trigger, others, harm);
    if (one.facts.outcome.contact) {
      cut_at(one.motion, one.facts.outcome.contact->time);
    }
  }
  return all;
}

}  // namespace saca::loop
