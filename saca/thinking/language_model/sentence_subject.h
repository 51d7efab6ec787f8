#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/preview/situation.h"

namespace saca::language_model {

/// What a sentence is about.
struct Subject {
  std::vector<std::size_t> actors;                 ///< of the scene
  std::vector<std::string> unknown;                ///< names of our kind that nobody has
  std::vector<manoeuvre::PolicyId> policies;       ///< by number or name
  std::optional<manoeuvre::PolicyId> misnumbered;  ///< named beside a number that is not its own
  int side = 0;                                    ///< 1: left, -1: right, 0: none or both
  bool of_case = false;                            ///< it speaks of the most alike case

  /// Whether it names a road user, one whom nobody knows included, or a policy.
  [[nodiscard]] bool names_anything() const {
    return !actors.empty() || !unknown.empty() || !policies.empty();
  }
};

/// Whom and which policies a sentence names: "car3"; "policy 6", "actions 1, 3 and 5", "policies 1
/// to 4", "6 T-D-R" and "T-D-R"; "left", "rightward".
/// @param low  the sentence, lowered
[[nodiscard]] Subject subject_of(std::string_view low, const preview::Situation& situation);

/// The lines of the prompt that are about what a sentence names: a policy's own; of a road user's
/// those that name him, but not those of other policies than the ones that are named; the most
/// alike case's where the sentence speaks of it and names a policy that the line names; the ego's
/// in any case. All lines where the sentence names nobody and no policy.
[[nodiscard]] std::string lines_about(std::string_view prompt, const Subject& subject,
                                      const preview::Situation& situation);

}  // namespace saca::language_model
