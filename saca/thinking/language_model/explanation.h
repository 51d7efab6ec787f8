#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/preview/situation.h"

namespace saca::language_model {

/// What is shown as a reason: numbered statements, a line each, that hold.
struct Explanation {
  enum class From : std::uint8_t {
    model,          ///< all that it wrote
    model_in_part,  ///< what it wrote, without what is false or cannot be checked
    facts,          ///< composed from what was computed
  };
  std::string text;
  From from = From::facts;
  int tries = 1;  ///< after how many replies of a model there was this; 1 without one, too
};
[[nodiscard]] std::string_view name(Explanation::From from);
[[nodiscard]] std::optional<Explanation::From> explanation_from(std::string_view name);

/// Of a model's numbered statements those that can be checked and are true.
///
/// @param written  whole sentences of a reply (finished_part)
/// @param choice   as for truth_of; where there is one, the last statement has to come to it
/// @return         nullopt: its last statement is not among them, or comes to another policy
[[nodiscard]] std::optional<Explanation> true_part(
    std::string_view written, std::string_view prompt, const preview::Situation& situation,
    const std::optional<manoeuvre::PolicyId>& choice);

/// Why a policy was chosen: what of a model's reasoning is true and ends with the policy; else what
/// an expert would say (expert_reply), or, of a policy that is not admissible, its facts beside the
/// best.
///
/// @param reasoning  whole sentences of it (finished_part); empty: the model wrote none
/// @param prompt     the scene part that it is about; must tell of `nearest`
/// @param chosen     can be driven
/// @throws ContractViolation  if it cannot
[[nodiscard]] Explanation explanation(std::string_view reasoning, std::string_view prompt,
                                      const preview::Situation& situation,
                                      const std::optional<memory::Case>& nearest,
                                      manoeuvre::PolicyId chosen);

}  // namespace saca::language_model
