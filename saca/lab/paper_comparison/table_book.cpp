#include "saca/lab/paper_comparison/table_book.h"

#include <fmt/format.h>

#include "saca/lab/paper_comparison/table_json.h"
#include "saca/lab/paper_comparison/table_page.h"
#include "saca/lab/paper_comparison/table_text.h"
#include "saca/lab/suites/suite_run.h"

namespace saca::paper_comparison {

using nlohmann::json;

TableBook empty_book(const TableRequest& request, std::string_view version) {
  TableBook book;
  book.meta = {{"meta.command", command_text(request)},
               {"meta.seed", std::to_string(request.seed)},
               {"meta.version", version}};
  book.page.title = "Tables II to IV of the paper, published and ours";
  book.page.lines = {
      "Published: arXiv 2504.00115; its text gives 1.54 for SACA's Collision Loss in the "
      "intersection, its table 0.54. It counts only replies within T2 - T1; ours are counted "
      "whether they come in time or not, and beside it, for Collision Loss, the encounters in "
      "which each reply ended by itself in the time that it is charged in lockstep. \"SACA\" here "
      "is held to the verdict; the paper's own rule is \"SACA, as in the paper\", with what was "
      "given as --llm: without a model it brakes, unless memory knows better.",
      "T1 here is counted from bumper to edge, and comes 0.4 to 0.5 s before the paper's, which is "
      "counted between centres: in Tables II and III full braking is enough, so that their "
      "Collision Loss tells apart only who does something else. \"Best in hindsight\" is the plan "
      "begun at T1 that harms least; who acts earlier, or meets somebody more gently, may lose "
      "less.",
      "Where all draws lost alike the interval has no width: no loss in 10 draws does not exclude "
      "a loss in up to 31 %, none in 1,000 excludes more than 0.4 % (exact 95 %).",
      "A row's name leads to its encounters, with those in which SACA lost most."};
  return book;
}

void add_table(TableBook& book, const TableFigures& figures, const json& made,
               const std::string& failures) {
  add_figures(book.figures, figures);
  if (!failures.empty()) {
    book.failures.push_back(fmt::format("{}: {}", figures.table->title, failures));
  }
  for (const char* const key : {"meta.memory", "meta.model", "meta.untuned"}) {
    if (made.contains(key)) {
      book.meta[key] = made[key];
    }
  }
  book.page.tables.push_back(page_table(figures));
}

void add_replies(TableBook& book, const std::vector<TimedModel>& timed) {
  for (const TimedModel& one : timed) {
    add_figures(book.figures, one);
  }
  book.page.tables.push_back(replies_table(timed));
}

report::SuitePage page_of(const TableBook& book) {
  report::SuitePage page = book.page;
  page.footnotes = suites::footnotes_of(book.meta);
  page.footnotes.insert(page.footnotes.end(), book.failures.begin(), book.failures.end());
  return page;
}

json json_of(const TableBook& book) {
  json out = book.meta;
  out.update(book.figures);
  if (!book.failures.empty()) {
    out["meta.failures"] = fmt::format("{}", fmt::join(book.failures, "; "));
  }
  return out;
}

std::string text_of(const TableBook& book) {
  std::string text;
  for (const report::PageTable& table : book.page.tables) {
    text += text_of(table);
  }
  text += book.page.lines.front() + "\n";
  for (const std::string& failure : book.failures) {
    text += failure + "\n";
  }
  return text;
}

}  // namespace saca::paper_comparison
