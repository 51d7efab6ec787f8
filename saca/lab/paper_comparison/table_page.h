#pragma once

#include <vector>

#include "saca/lab/paper_comparison/reply_clock.h"
#include "saca/lab/paper_comparison/table_figures.h"
#include "saca/lab/report/suite_page.h"

namespace saca::paper_comparison {

/// Published and ours side by side, with a chart.
/// @param figures  with `few`
[[nodiscard]] report::PageTable page_table(const TableFigures& figures);

/// Table IV likewise.
[[nodiscard]] report::PageTable replies_table(const std::vector<TimedModel>& timed);

}  // namespace saca::paper_comparison
