#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
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
#include "apps/saca/table_figures.h"
#include "apps/saca/within.h"
#include "saca/base/core/file.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using eval::PaperTable;
using nlohmann::json;

struct TablesCommand {
  int count = 1'000;
  std::uint64_t seed = 1;
  int threads = usual_threads();
  ThinkingOptions thinking;
  std::string methods;  ///< names, separated by commas; empty: methods_for
  std::string output = "runs/tables";
  bool as_json = false;
  std::vector<std::string> only;  ///< numbers of tables; empty: all
};

bool is_wanted(const PaperTable& table, const TablesCommand& options) {
  return options.only.empty() || std::find(options.only.begin(), options.only.end(),
                                           number_of(table)) != options.only.end();
}

/// SACA and the paper's algorithm with all that is given and without each part of it; beside them
/// the paper's baseline, published rules, and what could be had.
std::vector<std::string> methods_for(const ThinkingOptions& thinking) {
  const bool has_model = thinking.model != "off";
  std::vector<std::string> methods{"saca"};
  const auto add = [&](bool is_there, std::initializer_list<const char*> names) {
    methods.insert(methods.end(), is_there ? names.begin() : names.end(), names.end());
  };
  add(!thinking.memory.empty(), {"saca_no_memory"});
  add(has_model, {"saca_no_model"});
  add(!thinking.untuned.empty(), {"saca_untuned"});
  add(true, {"saca_unaware", "saca_paper"});
  add(!thinking.untuned.empty(), {"saca_paper_untuned"});
  add(has_model, {"saca_paper_unaware"});
  add(true, {"imitation", "aeb", "rss", "beliefs_rolled_out", "oracle"});
  return methods;
}

/// A table of a page, for the terminal: one row a line.
void print(const report::PageTable& table) {
  app::print("{}\n", table.heading);
  for (const std::string& line : table.lines) {
    app::print("  {}\n", line);
  }
  std::size_t widest = 0;
  std::vector<std::size_t> widths;
  for (const std::string& column : table.columns) {
    widths.push_back(column.size());
  }
  for (const report::PageTable::Row& row : table.rows) {
    widest = std::max(widest, row.name.size());
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      widths[i] = std::max(widths[i], row.cells[i].size());
    }
  }
  const auto line = [&](const std::string& name, const std::vector<std::string>& cells) {
    std::string text = fmt::format("  {:{}}", name, widest);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      text += fmt::format("  {:>{}}", cells[i], widths[i]);
    }
    app::print("{}\n", text);
  };
  line("", table.columns);
  for (const report::PageTable::Row& row : table.rows) {
    line(row.name, row.cells);
  }
  app::print("\n");
}

/// The encounters of a table as a suite, which a journal goes on with.
SuiteCommandOptions suite_of(const PaperTable& table, int count, const TablesCommand& options) {
  SuiteCommandOptions suite;
  suite.name = table.name;
  suite.count = count;
  suite.thinking = options.thinking;
  suite.seed = options.seed;
  suite.threads = options.threads;
  suite.output = (fs::path(options.output) / fmt::format("{}.h5", table.name)).string();
  return suite;
}

/// A model whose replies are timed.
struct AskedModel {
  std::string choice;
  const char* option = "";
  const char* title = "";  ///< for readers
  const char* key = "";    ///< of the figures
};

std::vector<AskedModel> asked_models(const ThinkingOptions& thinking) {
  std::vector<AskedModel> models;
  if (thinking.model != "off") {
    models.push_back({thinking.model, "--llm", "the model", "model"});
  }
  if (!thinking.untuned.empty()) {
    models.push_back({thinking.untuned, "--untuned", "the model without fine-tuning", "untuned"});
  }
  return models;
}

/// The first questions in about ten draws of a table, as many of each condition.
Result<std::vector<std::vector<std::string>>> questions_of(const PaperTable& table,
                                                           const PlanesOfCar& planes,
                                                           std::uint64_t seed) {
  const auto conditions =
      eval::encounters_of(table, planes.inputs.places.root / "scenarios", planes.inputs.car);
  if (!conditions.has_value()) {
    return conditions.error();
  }
  const std::size_t num = conditions.value().size();
  std::vector<eval::SuiteEncounter> draws;
  for (std::size_t k = 0; k < (few_draws + num - 1) / num * num; ++k) {
    draws.push_back(conditions.value()[k % num]);
    draws.back().number = k;
  }
  return eval::first_questions(draws, {.methods = {}, .seed = seed}, planes.setup,
                               planes.inputs.intent);
}

/// Of the tables of which the paper has replies.
/// @return  those of whom there was time to ask before an interrupt
Result<std::vector<TimedModel>> time_replies(const TablesCommand& options) {
  const auto planes = open_planes("compact_rwd_ev");
  if (!planes.has_value()) {
    return planes.error();
  }
  const PlanesOfCar& of_car = *planes.value();
  const reflex::Thresholds& thresholds = of_car.setup.thresholds;
  constexpr double patience = 60.0;  // [s]
  const long_work::InterruptStop interrupt;
  std::vector<TimedModel> timed;
  for (const eval::PublishedReplies& published : eval::published_replies()) {
    const PaperTable& table = *eval::find_paper_table(published.table);
    if (!is_wanted(table, options) || long_work::interrupted()) {
      continue;
    }
    const auto questions = questions_of(table, of_car, options.seed);
    if (!questions.has_value()) {
      return questions.error();
    }
    for (const AskedModel& asked : asked_models(options.thinking)) {
      const auto model = open_needed_model(of_car.inputs.places, asked.choice, runtime::Pace::real,
                                           *of_car.setup.clock, asked.option);
      if (!model.has_value()) {
        return model.error();
      }
      const auto times =
          eval::timed_replies(*model.value(), *of_car.setup.clock, questions.value(),
                              thresholds.preview - thresholds.trigger, patience, interrupt.token());
      if (!times.has_value()) {
        return Error{times.error().code,
                     fmt::format("{}: {}", asked.option, times.error().message)};
      }
      timed.push_back({std::string(table.name), asked.title, asked.key, times.value()});
    }
  }
  return timed;
}

int interrupted_run() {
  complain("interrupted; the same command goes on where this one stopped");
  return was_interrupted;
}

/// What is shown and written in the end.
struct Book {
  json meta;
  json figures = json::object();
  report::SuitePage page;
  bool faults = false;
};

Book empty_book(const TablesCommand& options) {
  Book book;
  book.meta = {
      {"meta.command",
       fmt::format(
           "saca tables --count {} --seed {}{}{}{}", options.count, options.seed,
           thinking_text(options.thinking),
           options.methods.empty() ? "" : " --methods " + options.methods,
           options.only.empty() ? "" : fmt::format(" --table {}", fmt::join(options.only, ",")))},
      {"meta.seed", std::to_string(options.seed)},
      {"meta.version", SACA_VERSION}};
  book.page.title = "Tables II to IV of the paper, published and ours";
  book.page.lines = {
      "Published: arXiv 2504.00115; its text gives 1.54 for SACA's Collision Loss in the "
      "intersection, its table 0.54. It counts only replies within T2 - T1; ours are counted "
      "whether "
      "they come in time or not, and beside it those that do. \"SACA\" here is held to the "
      "verdict; "
      "the paper's own rule is \"SACA, as in the paper\", with what was given as --llm, if "
      "anything.",
      "A row's name leads to its encounters, with those in which SACA lost most."};
  return book;
}

/// Runs one table, or what is left of it, and adds it to the book.
/// @return  how the program ends, where it does
std::optional<int> add_table(const PaperTable& table, const TablesCommand& options,
                             const std::vector<std::string>& methods, const Inputs& inputs,
                             Book& book) {
  const auto conditions = eval::encounters_of(table, inputs.places.root / "scenarios", inputs.car);
  if (!conditions.has_value()) {
    return refused(conditions.error());
  }
  const auto num = static_cast<int>(conditions.value().size());
  const int draws = std::max(few_draws, (options.count + num - 1) / num);
  const SuiteCommandOptions suite = suite_of(table, draws * num, options);
  const auto ran = run_suite(suite, "suite", methods);
  if (!ran.has_value()) {
    return refused(ran.error());
  }
  if (!ran.value()) {
    return interrupted_run();
  }
  const SuiteRun& done = *ran.value();
  const SuiteResult result = result_of(done, options.seed);
  TableFigures figures = table_figures(
      table, done, static_cast<std::size_t>(few_draws) * static_cast<std::size_t>(num),
      options.seed);
  if (figures.few.empty()) {
    complain(fmt::format("{}: none of the first {} encounters could be played: {}", table.title,
                         few_draws * num, done.rows.front().fault));
    return some_failed;
  }
  if (const auto problem = write_rows_and_page(done, result, suite)) {
    return refused(*problem);
  }
  figures.page = fmt::format("{}.html", table.name);
  add_figures(book.figures, figures);
  for (const char* const key : {"meta.memory", "meta.model", "meta.untuned"}) {
    if (done.meta.contains(key)) {
      book.meta[key] = done.meta[key];
    }
  }
  book.page.tables.push_back(page_table(figures));
  book.faults = book.faults || result.faults + result.method_faults > 0;
  return std::nullopt;
}

int run(const TablesCommand& options) {
  const fs::path index = fs::path(options.output) / "index.html";
  if (const auto problem = long_work::why_outputs_unwritable({index})) {
    return refused(*problem);
  }
  const auto inputs = read_inputs("compact_rwd_ev");
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  const auto methods = options.methods.empty()
                           ? Result(methods_for(options.thinking))
                           : methods_from(options.methods, options.thinking, "");
  if (!methods.has_value()) {
    complain(methods.error().message);
    return wrong_command_line;
  }
  long_work::watch_for_interrupt();
  Book book = empty_book(options);
  for (const PaperTable& table : eval::paper_tables()) {
    if (is_wanted(table, options)) {
      if (const auto ended = add_table(table, options, methods.value(), inputs.value(), book)) {
        return *ended;
      }
    }
  }
  const bool has_model = !asked_models(options.thinking).empty();
  if (has_model) {
    const auto timed = time_replies(options);
    if (long_work::interrupted()) {  // whoever interrupts a terminal interrupts the model as well
      return interrupted_run();
    }
    if (!timed.has_value()) {
      return refused(timed.error());
    }
    for (const TimedModel& one : timed.value()) {
      add_figures(book.figures, one);
    }
    book.page.tables.push_back(replies_table(timed.value()));
  }
  book.page.footnotes = footnotes_of(book.meta);
  json out = book.meta;
  out.update(book.figures);
  auto problem = long_work::write_output(index, report::suite_page(book.page));
  if (!problem) {
    problem =
        long_work::write_output(fs::path(options.output) / "tables.json", json_text(out) + "\n");
  }
  if (problem) {
    return refused(*problem);
  }
  if (options.as_json) {
    app::print_json(out);
  } else {
    for (const report::PageTable& table : book.page.tables) {
      print(table);
    }
    app::print("{}\n{}page: {}\n", book.page.lines.front(),
               has_model ? "" : "Table IV, how long replies take, needs a model: --llm local.\n",
               index.string());
  }
  return book.faults ? some_failed : success;
}

}  // namespace

void add_tables(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand(
      "tables", "Tables II to IV of the paper, published and ours; can be interrupted");
  const auto options = std::make_shared<TablesCommand>();
  command
      ->add_option("--count", options->count,
                   "Encounters of each table, at least; ten draws of each condition in any case. "
                   "With a model one takes half a minute")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  std::vector<std::string> numbers;
  for (const PaperTable& table : eval::paper_tables()) {
    numbers.push_back(number_of(table));
  }
  command->add_option("--table", options->only, "Only these: 2, 2_late, 3; all unless given")
      ->delimiter(',')
      ->check(one_of(numbers));
  command->add_option("--methods", options->methods,
                      "Names of methods, separated by commas; default: SACA and the paper's "
                      "algorithm, each without its parts, and baselines");
  add_thinking_options(*command, options->thinking);
  add_untuned_option(*command, options->thinking);
  command->add_option("--seed", options->seed, "Of all that is drawn")->capture_default_str();
  command->add_option("--output", options->output, "Folder for the page and the rows")
      ->capture_default_str();
  command->add_option("--threads", options->threads, "They do not change the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace saca::app
