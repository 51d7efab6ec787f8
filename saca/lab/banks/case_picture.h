#pragma once

#include <span>
#include <string>

#include "saca/lab/banks/case_neighbours.h"
#include "saca/lab/report/scene_svg.h"
#include "saca/thinking/memory/case.h"

namespace saca::banks {

/// "Case 7".
[[nodiscard]] std::string title_of(const memory::Case& one);

/// What is to be told of how far a case is trusted: "unchecked", "quarantined"; trusted is nothing
/// to tell.
[[nodiscard]] std::string trust_badge(const memory::Case& one);

/// The scene at the trigger and two seconds more, everybody going on as they do, with what every
/// policy was expected to harm and did.
[[nodiscard]] report::SceneView case_view(const memory::Case& one, std::string title,
                                          std::string badge);
/// The same in a sentence.
inline constexpr const char* case_view_note =
    "The scene at the trigger and two seconds more, everybody going on as they do; the colour is "
    "that of the policy that was the best in hindsight.";

/// A case and those most like it, as one SVG: the scenes, what every policy was expected to harm
/// and did, and in what they differ.
[[nodiscard]] std::string case_picture(const memory::Case& one,
                                       std::span<const CaseNeighbour> neighbours);

}  // namespace saca::banks
