#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace saca::manoeuvre {

/// The policy library: Table I of the paper (arXiv 2504.00115). The number is the paper's ID.
enum class PolicyId : std::uint8_t {
  aeb = 0,              ///< full braking, lane kept
  aes_left = 1,         ///< lane change to the left at constant speed, direction recovered
  aes_right = 2,        ///< likewise to the right
  es_b_left = 3,        ///< lane change to the left while braking to a target speed
  es_b_right = 4,       ///< likewise to the right
  t_drift_left = 5,     ///< induced rear slip to a stop across the lane, facing left
  t_drift_right = 6,    ///< likewise facing right
  no_intervention = 7,  ///< lane and speed kept
};

constexpr std::size_t num_policies = 8;
constexpr std::array<PolicyId, num_policies> all_policies{
    PolicyId::aeb,           PolicyId::aes_left,       PolicyId::aes_right,
    PolicyId::es_b_left,     PolicyId::es_b_right,     PolicyId::t_drift_left,
    PolicyId::t_drift_right, PolicyId::no_intervention};

constexpr std::size_t index(PolicyId policy) {
  return static_cast<std::size_t>(policy);
}

/// Policies 3 and 4: the only ones with a target speed.
constexpr bool brakes_to_speed(PolicyId policy) {
  return policy == PolicyId::es_b_left || policy == PolicyId::es_b_right;
}

/// Policy 0: the only one with a strength.
constexpr bool takes_strength(PolicyId policy) {
  return policy == PolicyId::aeb;
}

/// Where the policy takes the ego: +1 to the left (1, 3, 5), -1 to the right (2, 4, 6), 0 ahead.
constexpr int side(PolicyId policy) {
  const int id = static_cast<int>(policy);
  return id >= 1 && id <= 6 ? (id % 2 == 1 ? 1 : -1) : 0;
}

/// Policies 1 to 4.
constexpr bool changes_lane(PolicyId policy) {
  return policy == PolicyId::aes_left || policy == PolicyId::aes_right || brakes_to_speed(policy);
}

/// Policies 5 and 6.
constexpr bool drifts(PolicyId policy) {
  return policy == PolicyId::t_drift_left || policy == PolicyId::t_drift_right;
}

/// The paper's short name: "AEB", "AES-L", ..., "NI".
[[nodiscard]] std::string_view name(PolicyId policy);

/// @param id  0 to 7; nullopt for any other number
[[nodiscard]] std::optional<PolicyId> policy_from(int id);

/// A policy as people type it: its number, or its short name in any case, `_` for `-`.
[[nodiscard]] std::optional<PolicyId> policy_named(std::string_view text);

/// The gentlest braking of policy 0 that can be asked for, as a share of the grip [-]: below it a
/// stop takes minutes, and slowing is no answer to an emergency. An assumption.
constexpr double least_strength = 0.2;

/// A complete manoeuvre: which policy, for policies 3 and 4 down to which speed, and for policy 0
/// how hard.
struct Plan {
  PolicyId policy = PolicyId::aeb;
  std::optional<double> target_speed;  ///< [m/s], >= 0; only 3 and 4 have one
  /// Share of the believed grip that the brakes are asked for [-], in [least_strength, 1]; only 0
  /// may have one. nullopt: all of it, as the paper has it, and as 1 has.
  std::optional<double> strength = std::nullopt;

  bool operator==(const Plan&) const = default;
};

/// How hard a plan of policy 0 brakes: 1 is full braking.
constexpr double strength_of(const Plan& plan) {
  return plan.strength.value_or(1.0);
}

/// Of what has a plan, that whose plan is of the same policy, with the nearest target speed or
/// strength; of several as near, the first. nullptr: none is of that policy.
template <class Planned>
[[nodiscard]] const Planned* most_like(std::span<const Planned> all, const Plan& plan) noexcept {
  const Planned* nearest = nullptr;
  const auto off = [&](const Planned& one) {
    return std::abs(one.plan.target_speed.value_or(0.0) - plan.target_speed.value_or(0.0)) +
           std::abs(strength_of(one.plan) - strength_of(plan));
  };
  for (const Planned& one : all) {
    if (one.plan.policy == plan.policy && (nearest == nullptr || off(one) < off(*nearest))) {
      nearest = &one;
    }
  }
  return nearest;
}

/// Strengths below 1 that plans are chosen from, the hardest first (decisions/0019).
inline constexpr std::array braking_strengths{0.8, 0.6, 0.45, 0.3};

/// The two that are always possible.
constexpr Plan full_braking{PolicyId::aeb, std::nullopt};
constexpr Plan doing_nothing{PolicyId::no_intervention, std::nullopt};

/// A plan as people are told of it: the policy's name, the speed that it brakes to, and how hard
/// where that is not with all the grip: "ES-B-L to 7.0 m/s", "AEB at 45 % of the grip".
[[nodiscard]] std::string plan_name(const Plan& plan);
/// The same after the policy's number: "3 ES-B-L to 7.0 m/s".
[[nodiscard]] std::string plan_text(const Plan& plan);

/// The plan of a policy begun at `speed` [m/s]: 3 and 4 brake to half of it, 0 with all the grip.
[[nodiscard]] Plan default_plan(PolicyId policy, double speed);

}  // namespace saca::manoeuvre
