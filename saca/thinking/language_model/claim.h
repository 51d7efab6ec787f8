#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace saca::language_model {

/// What a sentence says of a manoeuvre.
enum class Claim : std::uint8_t { not_possible, blocked, hits, leaves, no_harm, least_harm, clear };

/// @param low  a sentence or a part of one, lowered
/// @return     nullopt: nothing of the kind, or it denies or excepts in another way (is_denied)
[[nodiscard]] std::optional<Claim> claim_of(std::string_view low);

/// A text without what cues are called in it: a siren "of an emergency vehicle that is not seen"
/// denies nothing.
/// @param low  a text, lowered
[[nodiscard]] std::string without_cues(std::string_view low);

/// Whether something is denied or excepted in another way than claim_of() knows, names of cues left
/// out.
/// @param text  a sentence or a part of one, lowered
[[nodiscard]] bool is_denied(std::string_view text);

/// A sentence in parts that claim one thing each: "1 and 3 are blocked, 2 is clear".
[[nodiscard]] std::vector<std::string_view> clauses(std::string_view sentence);

}  // namespace saca::language_model
