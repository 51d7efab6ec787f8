#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "saca/lab/paper_comparison/reply_clock.h"
#include "saca/lab/paper_comparison/table_figures.h"
#include "saca/lab/paper_comparison/table_request.h"
#include "saca/lab/report/suite_page.h"

namespace saca::paper_comparison {

/// All tables: what is shown and written in the end.
struct TableBook {
  nlohmann::json meta;  ///< "meta.command" and so on
  nlohmann::json figures = nlohmann::json::object();
  report::SuitePage page;
  std::vector<std::string> failures;  ///< of each table in which something went wrong, in words
};

/// Without any table yet.
/// @param version  of the program
[[nodiscard]] TableBook empty_book(const TableRequest& request, std::string_view version);

/// @param figures   with `few`
/// @param made      "meta...." of the table's run: it says which memory and models were asked
/// @param failures  suites::failures_text of that run
void add_table(TableBook& book, const TableFigures& figures, const nlohmann::json& made,
               const std::string& failures);

/// Table IV.
void add_replies(TableBook& book, const std::vector<TimedModel>& timed);

/// The page as it is written, with how it was made at its foot.
[[nodiscard]] report::SuitePage page_of(const TableBook& book);

/// Figures and how they were made.
[[nodiscard]] nlohmann::json json_of(const TableBook& book);

/// All tables, and what there is to say of them.
[[nodiscard]] std::string text_of(const TableBook& book);

}  // namespace saca::paper_comparison
