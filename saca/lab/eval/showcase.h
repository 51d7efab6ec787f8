#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saca/lab/eval/oracle.h"
#include "saca/lab/eval/survey.h"

namespace saca::eval {

/// What a scene must be to show what a policy is for.
struct ShowcaseRule {
  double clear = 0.005;  ///< least expected harm by which it beats every other: half a per cent of
                         ///< a severely injured person
  int draws = 100;       ///< under which it must do so, the lower end of the 95 % interval above 0
};

/// Findings that may show what `policy` is for, most convincing first: it is alone; where it meets
/// nobody before where it does, then by the margin. For no intervention, where nothing can be
/// gained: it is best though others would do harm, those first in which the mildest other harms
/// most.
[[nodiscard]] std::vector<Finding> candidates(std::span<const Finding> findings,
                                              manoeuvre::PolicyId policy);

/// Does the scene show it, under noise? For no intervention: it harms no more than every other.
[[nodiscard]] bool convinces(const Oracle& oracle, manoeuvre::PolicyId policy,
                             const ShowcaseRule& rule);

/// One sentence that says why the policy is right, from the oracle's figures.
[[nodiscard]] std::string why_right(const Oracle& oracle, manoeuvre::PolicyId policy);

}  // namespace saca::eval
