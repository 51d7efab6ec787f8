#pragma once

#include <span>
#include <string>

#include "saca/lab/banks/case_neighbours.h"
#include "saca/thinking/memory/case.h"

namespace saca::banks {

/// A case and those most like it as an HTML page that needs no other file, with all that is known
/// of the case.
/// @param command  that made it
[[nodiscard]] std::string case_page(const memory::Case& one,
                                    std::span<const CaseNeighbour> neighbours,
                                    const std::string& command);

}  // namespace saca::banks
