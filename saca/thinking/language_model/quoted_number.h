#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace saca::language_model {

/// A number that a text quotes.
struct QuotedNumber {
  std::string text;  ///< as written: digits with at most one decimal point, no sign
  double value = 0.0;
  double resolution = 1.0;  ///< of the last digit: 0.1 of "14.0"
  std::string unit;         ///< "m", "m/s", "s" or "%"; empty: none of these follows
  bool after_equals = false;
  std::string where;  ///< "ahead", "behind", "left", "right" or "away", if that follows at once
  /// What it is of, if that stands right before it: "risk", "harm", "grip", "left edge", "right
  /// edge", "edge", or an intention ("lane change left", "maintain") as the prompt calls them.
  std::string of_what;
};

/// The numbers of a text, in its order. Not among them: digits within a name ("car1"), labels at
/// the start of a line ("1.", "2)"), the digit right before a policy's name ("3 ES-B-L"; whether it
/// is that policy's own, `Subject::misnumbered` says), and what follows "policy", "action" or
/// "Response to user:", a list of several as well: those name choices.
/// @param text  anything
[[nodiscard]] std::vector<QuotedNumber> quoted_numbers(std::string_view text);

/// What joins two numbers of a list of choices, as in "1, 3 and 5" or "1 to 4".
/// @param text  from behind the first of the two on
/// @return      the joint with which it begins; empty: the list ends there
[[nodiscard]] std::string_view joint_at(std::string_view text);

}  // namespace saca::language_model
