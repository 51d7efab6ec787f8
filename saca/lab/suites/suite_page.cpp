#include "saca/lab/suites/suite_page.h"

#include <fmt/core.h>

#include <utility>

#include "saca/lab/suites/decisions.h"
#include "saca/lab/suites/method_list.h"
#include "saca/lab/suites/suite_sentences.h"
#include "saca/lab/suites/suite_tables.h"

namespace saca::suites {
namespace {

using eval::MethodFigures;
using eval::SuiteRow;

constexpr std::size_t most_footnotes = 30;  // with encounters that are left out

}  // namespace

report::SuitePage page_of(const SuiteRun& run, const SuiteResult& result,
                          const SuiteRequest& request, const PictureOf& picture_of) {
  report::SuitePage page;
  page.title = fmt::format("{}: {} encounters, {} methods", request.name, run.rows.size(),
                           run.methods.size());
  if (result.all.empty()) {
    page.lines = {failures_text(run)};
    return page;
  }
  page.lines = sentences_of(run, result);
  page.lines.insert(page.lines.end(), run.notes.begin(), run.notes.end());
  page.chart = harm_chart(result);
  page.tables = {figures_table(result), families_table(result)};
  for (const MethodFigures& one : result.all) {
    if (one.thinking || &one == &result.all.front()) {
      page.tables.push_back(decisions_table(one));
    }
  }
  if (auto drivers = drivers_table(run)) {
    page.tables.insert(page.tables.begin(), std::move(*drivers));
  }
  page.gallery_heading = "The encounters in which " + title_of(result.all.front().method) +
                         " lost most: what it did, and what would have been best";
  page.gallery = gallery_of(run, request, picture_of);
  page.footnotes = footnotes_of(run.meta);
  for (const SuiteRow& row : run.rows) {
    const auto failure = failure_of(row, run.methods);
    if (failure && page.footnotes.size() < most_footnotes) {
      page.footnotes.push_back(fmt::format("encounter {} {}", row.number, *failure));
    }
  }
  return page;
}

}  // namespace saca::suites
