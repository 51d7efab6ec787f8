#pragma once

#include <string>

#include "saca/lab/report/suite_page.h"

namespace saca::paper_comparison {

/// A table of a page for a terminal: heading, its lines, and one row a line, columns aligned to the
/// right; an empty line behind it.
[[nodiscard]] std::string text_of(const report::PageTable& table);

}  // namespace saca::paper_comparison
