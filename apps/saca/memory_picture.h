#pragma once

#include <span>
#include <string>

#include "saca/thinking/memory/case.h"

namespace saca::app {

/// A case and those most like it, as one SVG: the scenes, what every policy was expected to harm
/// and did, and in what they differ.
/// @param all  of the bank; `one` may be among them
[[nodiscard]] std::string case_picture(const memory::Case& one, std::span<const memory::Case> all);

/// The same as a page that needs no other file, with all that is known of the case.
/// @param command  that made it
[[nodiscard]] std::string case_page(const memory::Case& one, std::span<const memory::Case> all,
                                    const std::string& command);

}  // namespace saca::app
