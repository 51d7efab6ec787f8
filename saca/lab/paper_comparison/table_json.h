#pragma once

#include <nlohmann/json.hpp>

#include "saca/lab/paper_comparison/reply_clock.h"
#include "saca/lab/paper_comparison/table_figures.h"

namespace saca::paper_comparison {

/// Under "tables.2...." and so on (docs/formats.md): over all draws, over ten of each condition,
/// and where all replies came in time.
void add_figures(nlohmann::json& out, const TableFigures& figures);

/// Table IV likewise, under "tables.4....".
void add_figures(nlohmann::json& out, const TimedModel& one);

}  // namespace saca::paper_comparison
