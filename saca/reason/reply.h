#pragma once

#include <optional>
#include <string_view>

#include "saca/manoeuvre/plan.h"
#include "saca/reason/language_model.h"

namespace saca::reason {

/// Of equals the first.
[[nodiscard]] manoeuvre::PolicyId likeliest_policy(const Answer& answer);

/// The policy that a text names in its last "Response to user: N".
/// @param text  anything
/// @return      nullopt when there is none, or N is no number from 0 to 7
[[nodiscard]] std::optional<manoeuvre::PolicyId> stated_policy(std::string_view text);

/// Likewise of a text that was cut: an answer begun at its very end does not hide an earlier one.
[[nodiscard]] std::optional<manoeuvre::PolicyId> stated_so_far(std::string_view text);

/// How many of the numbers that a text quotes stand in the prompt, in [0, 1].
///
/// A number is digits with at most one decimal point, compared by value without rounding: "14" is
/// "14.0", "14.2" is not. Its sign is not looked at. Not counted, in text and prompt alike: digits
/// within a name ("car1"), labels at the start of a line ("1.", "2)", "0 AEB"), and the number
/// after "policy", "action" or "Response to user:", which names a choice. Chance agreement is not
/// taken out.
///
/// @param text  anything
/// @return      nullopt when the text quotes no number
[[nodiscard]] std::optional<double> faithful_share(std::string_view text, std::string_view prompt);

}  // namespace saca::reason
