#pragma once

#include "saca/thinking/language_model/example_situation.h"

namespace saca::language_model {

inline preview::PolicyFacts& of(preview::Situation& situation, manoeuvre::PolicyId policy) {
  return situation.facts[manoeuvre::index(policy)];
}

/// Both ways of going left in reach: they harm little, braking and the right more.
inline preview::Situation left_is_open() {
  using manoeuvre::PolicyId;
  preview::Situation situation = example_situation();
  for (const PolicyId policy : {PolicyId::aes_left, PolicyId::es_b_left}) {
    auto& end = of(situation, policy).end.emplace<preview::ExpectedOutcome>();
    end.outcome.clearance = 1.5;
    end.contact_probability = 0.02;
  }
  of(situation, PolicyId::aeb).end = of(situation, PolicyId::aes_right).end;
  of(situation, PolicyId::aeb).outcome().harm = 0.1;
  return situation;
}

}  // namespace saca::language_model
