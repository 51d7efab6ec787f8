#include "saca/loop/hindsight.h"

#include <utility>

#include "saca/outcome/roll_out.h"

namespace saca::loop {

std::vector<Hindsights> hindsights(std::span<const Moment> moments, const manoeuvre::Car& car,
                                   const outcome::HarmModel& harm, int threads) {
  std::vector<outcome::Attempt> attempts;
  for (const Moment& moment : moments) {
    for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
      const manoeuvre::Plan plan =
          moment.carried_out && moment.carried_out->policy == policy
              ? *moment.carried_out
              : manoeuvre::default_plan(policy, norm(moment.scene.ego.v_B));
      attempts.push_back({plan, &moment.scene, &moment.others, moment.grip, moment.unknown});
    }
  }
  std::vector<Hindsight> tried = preview::tried(car, attempts, harm, threads);
  std::vector<Hindsights> all(moments.size());
  for (std::size_t k = 0; k < tried.size(); ++k) {
    all[k / manoeuvre::num_policies][k % manoeuvre::num_policies] = std::move(tried[k]);
  }
  return all;
}

Hindsights hindsight(const Moment& moment, const manoeuvre::Car& car,
                     const outcome::HarmModel& harm) {
  return std::move(hindsights({&moment, 1}, car, harm).front());
}

}  // namespace saca::loop
