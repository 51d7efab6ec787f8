#include "saca/onboard/manoeuvre/plan.h"

#include <algorithm>
#include <cstdio>

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

std::optional<PolicyId> policy_named(std::string_view text) {
  const auto plain = [](char letter) {
    return letter == '_'                    ? '-'
           : letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A')
                                            : letter;
  };
  for (const PolicyId policy : all_policies) {
    const std::string_view known = name(policy);
    if (text == std::to_string(index(policy)) ||
        std::equal(known.begin(), known.end(), text.begin(), text.end(),
                   [&](char a, char b) { return a == plain(b); })) {
      return policy;
    }
  }
  return std::nullopt;
}

std::string plan_name(const Plan& plan) {
  std::array<char, 64> parameter{};
  if (plan.target_speed) {
    (void)std::snprintf(parameter.data(), parameter.size(), " to %.1f m/s", *plan.target_speed);
  } else if (strength_of(plan) < 1.0) {
    (void)std::snprintf(parameter.data(), parameter.size(), " at %.0f %% of the grip",
                        100.0 * strength_of(plan));
  }
  return std::string(name(plan.policy)) + parameter.data();
}

std::string plan_text(const Plan& plan) {
  return std::to_string(index(plan.policy)) + " " + plan_name(plan);
}

Plan default_plan(PolicyId policy, double speed) {
  if (!brakes_to_speed(policy)) {
    return {.policy = policy, .target_speed = std::nullopt};
  }
  return {.policy = policy,
          .target_speed = 0.5 * speed};  // half: an assumption, the paper gives none
}

}  // namespace saca::manoeuvre
