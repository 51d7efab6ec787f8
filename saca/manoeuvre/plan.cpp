#include "saca/manoeuvre/plan.h"

namespace saca::manoeuvre {

std::string_view name(PolicyId policy) {
  constexpr std::array<std::string_view, num_policies> names{"AEB",    "AES-L", "AES-R", "ES-B-L",
                                                             "ES-B-R", "T-D-L", "T-D-R", "NI"};
  return names[index(policy)];
}

std::optional<PolicyId> policy_from(int id) {
  if (id < 0 || id >= static_cast<int>(num_policies)) {
    return std::nullopt;
  }
  return static_cast<PolicyId>(id);
}

Plan default_plan(PolicyId policy, double speed) {
  if (!brakes_to_speed(policy)) {
    return {.policy = policy, .target_speed = std::nullopt};
  }
  return {.policy = policy,
          .target_speed = 0.5 * speed};  // half: an assumption, the paper gives none
}

}  // namespace saca::manoeuvre
