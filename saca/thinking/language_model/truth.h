#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/language_model/language_model.h"
#include "saca/thinking/preview/situation.h"

namespace saca::language_model {

/// A statement that what was computed does not bear out.
struct FalseStatement {
  std::string text;           ///< as written, at most 200 characters of it
  std::string why;            ///< what is so, in our words
  bool load_bearing = false;  ///< the choice rests on it
};

/// How far a reasoning is true.
struct Truth {
  int num_checked = 0;  ///< statements that say something which can be checked
  std::vector<FalseStatement> wrong;

  /// Share of the checked statements that are true; nullopt: there is none.
  [[nodiscard]] std::optional<double> score() const;
  /// Whether the choice rests on something false.
  [[nodiscard]] bool is_choice_unfounded() const;
  /// What is so in place of the first false statement that the choice rests on; empty: none is.
  [[nodiscard]] std::string wrong_reason() const;
};

/// Compares a reasoning with the situation that it is about: each sentence, in parts where it
/// claims several things.
///
/// * A number must stand in the prompt, with the same unit where both have one, rounded at most to
///   a tenth of it: "16" is a rounded 16.4, "1" no rounded 0.9; where the sentence names road users
///   or policies, in a line about them (lines_about). A part that names neither ("harm 0.013")
///   speaks of what the part before it does, but where it speaks of an edge of the road or of a
///   cue. Where the number says in which direction ("6.4 m left"), or of what ("lane change left
///   0.93", "risk 0.94"), it stands there so; "away" from trees or a barrier is how far an edge is,
///   that of the side which is named. Numbers after "=" that are the quotient of the two before it
///   are true as well.
/// * What lies beyond an edge ("trees") must lie there, at the side that is named.
/// * A name of our kind ("car3") must be somebody of the scene; who a named policy "hits" must be
///   among those that it is forecast to hit.
/// * A number right before a policy's name ("6 T-D-R") must be that policy's.
/// * "clear", "no harm", "hits", "leaves the road", "not possible", "blocked", "least harm" of a
///   named policy must be its forecast; of a named side ("left is blocked") that of all policies to
///   it, "clear" of one. "Blocked" is what is not possible or forecast to hit.
/// * The choice must not be what the text calls blocked or not possible. What is said of the
///   policy that a sentence names first beside one other must be so: "as good as", "harms about
///   as little", "milder", "less often", "out of the oncoming lane"; that it "alone is possible" as
///   well. What is called "next" behind it must be the best forecast of the others; of equals any.
/// * What "was best" or "was carried out" in a like case, and that this did "no harm", must be what
///   the prompt tells of it.
/// What is said about the policy or the side that was chosen is load-bearing. What says nothing of
/// this kind, or denies or excepts in another way ("not blocked", "all but AEB"), is not judged.
///
/// @param reasoning  anything
/// @param prompt     the scene part that was reasoned about
/// @param choice     nullopt: there was no answer
[[nodiscard]] Truth truth_of(std::string_view reasoning, std::string_view prompt,
                             const preview::Situation& situation,
                             const std::optional<manoeuvre::PolicyId>& choice);

/// Of a reply and its last answer; where that was cut, of its whole sentences.
[[nodiscard]] Truth truth_of(const Reply& reply, std::string_view prompt,
                             const preview::Situation& situation);

}  // namespace saca::language_model
