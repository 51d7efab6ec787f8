#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "saca/lab/eval/suite_figures.h"
#include "saca/lab/report/suite_page.h"

namespace saca::suites {

/// Where the decisions of a method came from, as a page shows it: sources, reasons, and of what
/// thinks ahead what became of its forecasts.
[[nodiscard]] report::PageTable decisions_table(const eval::MethodFigures& figures);

/// The same as figures, their names after `place`.
void add_decisions(nlohmann::json& out, const std::string& place,
                   const eval::MethodFigures& figures);

/// What its verdicts expected at T1 and what would have happened, in two sentences; empty where it
/// decides by none.
[[nodiscard]] std::string expectations_text(const eval::MethodFigures& figures);

/// Where the decisions came from in a line, for the terminal.
[[nodiscard]] std::string decisions_text(const eval::MethodFigures& figures);

}  // namespace saca::suites
