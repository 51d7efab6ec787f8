#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "saca/thinking/language_model/quoted_number.h"

namespace saca::language_model {

/// Whether a text speaks of an edge of the road, or of what lies beyond one.
/// @param low  the text, lowered
[[nodiscard]] bool is_of_an_edge(std::string_view low);

/// The numbers that a text quotes, in its order. How far "away" something is has no direction;
/// where the text is_of_an_edge, that is how far an edge is, the one of the side that it names.
/// @param side  1: the text names the left, -1: the right, 0: neither or both
[[nodiscard]] std::vector<QuotedNumber> numbers_said(std::string_view text, int side);

/// The first of these numbers that does not stand in some lines of a prompt: with the same unit
/// where both have one, in the same direction and of the same where that is said, rounded at most
/// to a tenth of it. "No harm" stands there as 0. The quotient of the two numbers before it, after
/// "=", needs to stand nowhere.
/// @param said   of numbers_said
/// @param lines  of the prompt
/// @return       nullopt: all are founded
[[nodiscard]] std::optional<QuotedNumber> unfounded(const std::vector<QuotedNumber>& said,
                                                    std::string_view lines);

}  // namespace saca::language_model
