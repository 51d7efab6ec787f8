#pragma once

#include <optional>
#include <string>

#include "saca/memory/case.h"
#include "saca/preview/situation.h"

namespace saca::reason {

/// The part of the prompt that never changes: the policies, the rule by which they are chosen
/// (from `outcome::better`, with the order of `outcome::severity`), and the form of the reply.
[[nodiscard]] std::string system_part();

/// One forecast as the model reads it, in the sections of the paper's Fig. 8 and 10 and with what
/// was computed about each manoeuvre. The model weighs these facts; it does not compute.
///
/// Every word is from a fixed list and every name ours ("car1"): nothing that came from outside
/// stands in it as text. Positions are of centres, seen from the ego's centre of mass, ahead and
/// left in words; numbers have fixed decimals. At most six obstacles and participants are told,
/// those of the highest risk, then the nearest; the number of the others is.
///
/// @param nearest     the stored case that is most alike, if there is one
/// @param similarity  of that case, in [0, 1]
/// @throws ContractViolation  if the situation's lists and the scene's actors differ in number
[[nodiscard]] std::string scene_part(const preview::Situation& situation,
                                     const std::optional<memory::Case>& nearest, double similarity);

/// What a policy is forecast to end in, in one line: "0 AEB: clear by 0.6 m, no harm". Used
/// by prompt, terminal and report alike.
[[nodiscard]] std::string policy_line(const preview::PolicyFacts& facts, const world::Scene& scene);

}  // namespace saca::reason
