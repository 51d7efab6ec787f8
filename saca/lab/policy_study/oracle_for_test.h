#pragma once

// An oracle by hand, for the tests of this module.

#include "saca/lab/eval/oracle.h"

namespace saca::policy_study {

/// At 2.5 s, 20 m/s, a car ahead: AEB at 80 % of the grip stays clear by 1.5 m and is best, doing
/// nothing strikes the car with its front at 12 m/s; all others are refused.
inline eval::Oracle oracle_by_hand() {
  eval::Oracle oracle;
  oracle.scene.time = 2.5;
  oracle.scene.ego.v_B = {20.0, 0.0};
  oracle.scene.actors.push_back({.id = 1, .mass = 1'500.0});
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    preview::PolicyFacts& facts = oracle.verdicts[manoeuvre::index(policy)].written.facts;
    facts.plan.policy = policy;
    facts.end = preview::Refusal{"no room"};
  }
  eval::Verdict& aeb = oracle.verdicts[0];
  aeb.written.facts.plan.strength = 0.8;
  aeb.written.facts.end = preview::RolledOutcome{{.clearance = 1.5}};
  aeb.expected = {{0.01, 0.005, 0.015}, {0.5, 0.25, 0.75}, {0.125, 0.0, 0.5}};
  eval::Verdict& nothing = oracle.verdicts[7];
  collision::Outcome crash{.collision_loss = 4.2, .harm = 0.4, .clearance = 0.0};
  crash.contact = collision::Contact{.time = 4.0, .actor = 0, .relative_speed = 12.0};
  crash.contact->ego_delta_v = 5.0;
  crash.contact->other_delta_v = 6.0;
  nothing.written.facts.end = preview::RolledOutcome{crash};
  nothing.expected = {{0.41, 0.31, 0.51}, {4.0, 3.0, 5.0}, {1.0, 0.9, 1.0}};
  nothing.behind = {0.4, 0.3, 0.5};
  oracle.ranking = {manoeuvre::PolicyId::aeb, manoeuvre::PolicyId::no_intervention};
  return oracle;
}

}  // namespace saca::policy_study
