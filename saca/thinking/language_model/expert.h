#pragma once

#include <optional>
#include <random>
#include <string>
#include <string_view>

#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/preview/situation.h"

namespace saca::language_model {

/// How an expert argues for a choice, in the form that prompts ask for: what models are taught
/// with.
///
/// Composed by a grammar of arguments from what stands in the prompt, so that every number and
/// claim holds by `truth_of`: who threatens and how sure that is; what comes of doing nothing or of
/// braking; what is blocked, what lies beyond an edge, whose lane it is, what the most alike case
/// says; and why this choice and not the next best. Who threatens, how that ends and the conclusion
/// are always said; of the details those that fit, in an order that is drawn.
///
/// @param scene_part   of this situation and case
/// @param nearest      as for the scene part
/// @param choice       admissible
/// @param most_tokens  of the reply (tokens_at_most); with what is always said it may be longer
/// @param random       same state, same text
/// @throws ContractViolation  if the choice is not admissible
[[nodiscard]] std::string expert_reply(const preview::Situation& situation,
                                       std::string_view scene_part,
                                       const std::optional<memory::Case>& nearest,
                                       manoeuvre::PolicyId choice, int most_tokens,
                                       std::mt19937_64& random);

/// As many tokens (tokens_at_most) as a reply may have that models are taught to give: some 47 of
/// SmolLM2's; what is always said may take more.
constexpr int most_taught_tokens = 55;

}  // namespace saca::language_model
