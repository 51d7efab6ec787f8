#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/inputs.h"
#include "apps/saca/json_output.h"
#include "apps/saca/model.h"
#include "apps/saca/planes_making.h"
#include "apps/saca/printing.h"
#include "apps/saca/suite_pages.h"
#include "apps/saca/suite_running.h"
#include "apps/saca/within.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/paper_comparison/table_book.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using eval::PaperTable;
using paper_comparison::TableBook;
using paper_comparison::TableRequest;
using paper_comparison::TimedModel;

struct TablesCommand {
  TableRequest tables;
  bool as_json = false;
};

Result<std::vector<TimedModel>> time_replies(const TableRequest& request) {
  const auto planes = open_planes("compact_rwd_ev");
  if (!planes.has_value()) {
    return planes.error();
  }
  const PlanesOfCar& of_car = *planes.value();
  return timed_models({.scenarios = of_car.inputs.places.root / "scenarios",
                       .car = &of_car.inputs.car,
                       .setup = &of_car.setup,
                       .intent = &of_car.inputs.intent,
                       .open =
                           [&](const paper_comparison::AskedModel& asked) {
                             return open_needed_model(of_car.inputs.places, asked.choice,
                                                      runtime::Pace::real, *of_car.setup.clock,
                                                      asked.option);
                           }},
                      request);
}

int interrupted_run() {
  complain("interrupted; the same command goes on where this one stopped");
  return was_interrupted;
}

/// Runs one table, or what is left of it, and adds it to the book.
/// @return  how the program ends, where it does
std::optional<int> add_table(const PaperTable& table, const TableRequest& request,
                             const std::vector<std::string>& methods, const Inputs& inputs,
                             TableBook& book) {
  const auto conditions = eval::encounters_of(table, inputs.places.root / "scenarios", inputs.car);
  if (!conditions.has_value()) {
    return refused(conditions.error());
  }
  const std::size_t num = conditions.value().size();
  const suites::SuiteRequest suite = suite_of(table, num, request);
  const auto ran = run_suite(suite, "suite", methods);
  if (!ran.has_value()) {
    return refused(ran.error());
  }
  if (!ran.value()) {
    return interrupted_run();
  }
  const SuiteRun& done = *ran.value();
  const SuiteResult result = result_of(done, request.seed);
  const int few = paper_comparison::num_few(num);
  const auto figures =
      paper_comparison::table_figures(table, done, static_cast<std::size_t>(few), request.seed);
  if (figures.few.empty()) {
    complain(fmt::format("{}: none of the first {} encounters could be played: {}", table.title,
                         few, done.rows.front().fault));
    return some_failed;
  }
  if (const auto problem = write_rows_and_page(done, result, suite)) {
    return refused(*problem);
  }
  add_table(book, figures, done.meta);
  book.faults = book.faults || result.faults + result.method_faults > 0;
  return std::nullopt;
}

int finish(const TableBook& book, const TablesCommand& options) {
  const fs::path index = fs::path(options.tables.output) / "index.html";
  const nlohmann::json out = json_of(book);
  auto problem = long_work::write_output(index, report::suite_page(page_of(book)));
  if (!problem) {
    problem = long_work::write_output(fs::path(options.tables.output) / "tables.json",
                                      json_text(out) + "\n");
  }
  if (problem) {
    return refused(*problem);
  }
  if (options.as_json) {
    app::print_json(out);
  } else {
    app::print("{}{}page: {}\n", text_of(book),
               paper_comparison::asked_models(options.tables.thinking).empty()
                   ? "Table IV, how long replies take, needs a model: --llm local.\n"
                   : "",
               index.string());
  }
  return book.faults ? some_failed : success;
}

int run(const TablesCommand& options) {
  const TableRequest& request = options.tables;
  if (const auto problem =
          long_work::why_outputs_unwritable({fs::path(request.output) / "index.html"})) {
    return refused(*problem);
  }
  const auto inputs = read_inputs("compact_rwd_ev");
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  const auto methods = request.methods.empty()
                           ? Result(paper_comparison::compared_methods(request.thinking))
                           : methods_from(request.methods, request.thinking, "");
  if (!methods.has_value()) {
    complain(methods.error().message);
    return wrong_command_line;
  }
  long_work::watch_for_interrupt();
  TableBook book = paper_comparison::empty_book(request, SACA_VERSION);
  for (const PaperTable& table : eval::paper_tables()) {
    if (is_wanted(table, request)) {
      if (const auto ended = add_table(table, request, methods.value(), inputs.value(), book)) {
        return *ended;
      }
    }
  }
  if (!paper_comparison::asked_models(request.thinking).empty()) {
    const auto timed = time_replies(request);
    if (long_work::interrupted()) {  // whoever interrupts a terminal interrupts the model as well
      return interrupted_run();
    }
    if (!timed.has_value()) {
      return refused(timed.error());
    }
    add_replies(book, timed.value());
  }
  return finish(book, options);
}

}  // namespace

void add_tables(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand(
      "tables", "Tables II to IV of the paper, published and ours; can be interrupted");
  const auto options = std::make_shared<TablesCommand>();
  TableRequest& tables = options->tables;
  command
      ->add_option("--count", tables.count,
                   "Encounters of each table, at least; ten draws of each condition in any case. "
                   "With a model one takes half a minute")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  std::vector<std::string> numbers;
  for (const PaperTable& table : eval::paper_tables()) {
    numbers.push_back(paper_comparison::number_of(table));
  }
  command->add_option("--table", tables.only, "Only these: 2, 2_late, 3; all unless given")
      ->delimiter(',')
      ->check(one_of(numbers));
  command->add_option("--methods", tables.methods,
                      "Names of methods, separated by commas; default: SACA and the paper's "
                      "algorithm, each without its parts, and baselines");
  add_thinking_options(*command, tables.thinking);
  add_untuned_option(*command, tables.thinking);
  command->add_option("--seed", tables.seed, "Of all that is drawn")->capture_default_str();
  command->add_option("--output", tables.output, "Folder for the page and the rows")
      ->capture_default_str();
  add_threads(*command, tables.threads);
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace saca::app
