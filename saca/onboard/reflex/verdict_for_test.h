#pragma once

// Verdicts of round numbers, for the tests of this module.

#include <initializer_list>
#include <utility>

#include "saca/onboard/reflex/verdict.h"

namespace saca::reflex {

/// Contact where there is harm.
inline void add_to(Verdict& verdict, const manoeuvre::Plan& plan, double harm) {
  verdict.plans.push_back(
      {.plan = plan, .drivable = true, .harm = harm, .contact = harm > 0.0 ? 0.5 : 0.0});
}

/// A verdict at `time` that has these plans with these expected harms.
inline Verdict verdict_of(double time,
                          std::initializer_list<std::pair<manoeuvre::PolicyId, double>> harms) {
  Verdict verdict{.time = time};
  for (const auto& [policy, harm] : harms) {
    const bool to_speed = manoeuvre::brakes_to_speed(policy);
    add_to(verdict, {policy, to_speed ? std::optional(10.0) : std::nullopt}, harm);
  }
  return verdict;
}

/// Braking with a share of the grip.
inline manoeuvre::Plan braking_at(double strength) {
  return {.policy = manoeuvre::PolicyId::aeb, .strength = strength};
}

/// Full braking, and braking with 0.8, 0.6 and 0.3 of the grip, are expected to harm so much; going
/// on more than all of them.
inline Verdict braking_verdict(double time, double full, double hard, double middle,
                               double gentle) {
  Verdict verdict{.time = time};
  add_to(verdict, manoeuvre::full_braking, full);
  add_to(verdict, braking_at(0.8), hard);
  add_to(verdict, braking_at(0.6), middle);
  add_to(verdict, braking_at(0.3), gentle);
  add_to(verdict, manoeuvre::doing_nothing, full + hard + middle + gentle + 0.1);
  return verdict;
}

}  // namespace saca::reflex
