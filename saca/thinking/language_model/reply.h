#pragma once

#include <optional>
#include <string_view>

#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/language_model/language_model.h"

namespace saca::language_model {

/// "first", "ended" or "forced": what files and programs call an answer's kind.
[[nodiscard]] std::string_view name(Answer::Kind kind);
[[nodiscard]] std::optional<Answer::Kind> answer_kind_from(std::string_view name);

/// Of equals the first.
[[nodiscard]] manoeuvre::PolicyId likeliest_policy(const Answer& answer);

/// The policy that a text names in its last "Response to user: N".
/// @param text  anything
/// @return      nullopt when there is none, or N is no number from 0 to 7
[[nodiscard]] std::optional<manoeuvre::PolicyId> stated_policy(std::string_view text);

/// The text, where it came to its end; else its whole sentences: what the cut left of the last one
/// says nothing yet.
[[nodiscard]] std::string_view finished_part(const Reply& reply);

/// As stated_policy, of a text that was cut: an answer begun at its very end does not hide an
/// earlier one.
[[nodiscard]] std::optional<manoeuvre::PolicyId> stated_so_far(std::string_view text);

}  // namespace saca::language_model
