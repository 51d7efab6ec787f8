#include "apps/saca/options.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/paper_comparison/table_book.h"
#include "saca/lab/paper_comparison/table_run.h"
#include "saca/lab/suites/method_list.h"

namespace saca::app {
namespace {

using eval::PaperTable;
using paper_comparison::TableRequest;

struct TablesOptions {
  TableRequest tables;
  bool as_json = false;
};

/// Runs what is wanted, or what is left of it.
paper_comparison::TableBook made_book(const TableRequest& request,
                                      const std::vector<std::string>& methods) {
  auto book = paper_comparison::empty_book(request, SACA_VERSION);
  for (const PaperTable& table : eval::paper_tables()) {
    if (!is_wanted(table, request)) {
      continue;
    }
    const auto run = need_whole(paper_comparison::run_table(here(), table, request, methods));
    if (run.figures.few.empty()) {
      refuse(some_failed, fmt::format("{}: none of the first {} encounters could be played: {}",
                                      table.title, run.num_few, run.failures));
    }
    add_table(book, run.figures, run.made, run.failures);
  }
  if (!paper_comparison::asked_models(request.thinking).empty()) {
    auto timed = paper_comparison::time_replies(here(), request);
    if (long_work::interrupted()) {  // whoever interrupts a terminal interrupts the model as well
      refuse(was_interrupted, goes_on);
    }
    add_replies(book, need(std::move(timed)));
  }
  return book;
}

ExitCode make_tables(const TablesOptions& options) {
  const TableRequest& request = options.tables;
  const fs::path index = fs::path(request.output) / "index.html";
  need_writable({index});
  const auto methods =
      request.methods.empty()
          ? paper_comparison::compared_methods(request.thinking)
          : need_of_line(suites::methods_from(request.methods, request.thinking, ""));
  long_work::watch_for_interrupt();
  const auto book = made_book(request, methods);
  const nlohmann::json figures = json_of(book);
  write(index, report::suite_page(page_of(book)));
  write(fs::path(request.output) / "tables.json", json_text(figures));
  tell(options.as_json, figures,
       fmt::format("{}{}page: {}\n", text_of(book),
                   paper_comparison::asked_models(request.thinking).empty()
                       ? "Table IV, how long replies take, needs a model: --llm local.\n"
                       : "",
                   index.string()));
  return book.failures.empty() ? success : some_failed;
}

}  // namespace

void add_tables(CLI::App& line) {
  const auto [command, options] = add_command<TablesOptions>(
      line, "tables", "Tables II to IV of the paper, published and ours; can be interrupted",
      make_tables);
  TableRequest& tables = options.tables;
  add(command, "--count", tables.count,
      "Encounters of each table, at least; ten draws of each condition in any case. With a model "
      "one takes half a minute",
      CLI::Range(1, 1'000'000));
  std::vector<std::string> numbers;
  for (const PaperTable& table : eval::paper_tables()) {
    numbers.push_back(paper_comparison::number_of(table));
  }
  add(command, "--table", tables.only, "Only these: 2, 2_late, 3; all unless given",
      one_of(numbers))
      ->delimiter(',');
  add(command, "--methods", tables.methods,
      "Names of methods, separated by commas; default: SACA and the paper's algorithm, each "
      "without its parts, and baselines");
  add_thinking_options(command, tables.thinking.memory, tables.thinking.model);
  add_untuned_option(command, tables.thinking.untuned);
  add(command, "--seed", tables.seed, "Of all that is drawn");
  add(command, "--output", tables.output, "Folder for the page and the rows");
  add_threads(command, tables.threads);
  add_json(command, options.as_json);
}

}  // namespace saca::app
