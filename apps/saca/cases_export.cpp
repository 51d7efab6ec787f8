#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/saca/cases_commands.h"
#include "apps/saca/cases_examples.h"
#include "apps/saca/json_output.h"
#include "apps/saca/settings.h"
#include "apps/saca/version.h"
#include "saca/base/core/parallel.h"
#include "saca/base/formats/json_lines.h"
#include "saca/lab/eval/reply_example.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/items_row.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/long_work/resumable_work.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/token_bound.h"

namespace saca::app {
namespace {

using eval::CrashCase;
using eval::ExampleSet;
using eval::ReplyExample;
using nlohmann::json;

constexpr std::string_view examples_schema = "saca.reply_examples/1";

struct CasesExportOptions {
  ExampleOptions examples;
  std::string format = "local";
  std::string output = "runs/reply_sets";
  int threads = usual_threads();
  bool as_json = false;
};

/// What one case and its twin gave.
using ExampleRow = long_work::ItemsRow<ReplyExample>;

ExampleRow row_of(const CrashCase& one, const ExampleSource& source,
                  const ExampleOptions& options) {
  DrawnExamples drawn = drawn_examples(one, source, options);
  ExampleRow row{.items = {}, .problem = std::move(drawn.problem)};
  for (DrawnExample& each : drawn.examples) {
    row.items.push_back(std::move(each.example));
  }
  return row;
}

/// What a table line tells of one set.
struct SetTally {
  int examples = 0;
  int twins = 0;
  int choosable = 0;  ///< more than one policy is admissible
  int tokens = 0;     ///< at most, without the system part
  std::map<std::string, int> families;
  std::map<std::string, int> choices;
};
using SetTallies = std::map<ExampleSet, SetTally>;

SetTallies tallied(const std::vector<ReplyExample>& examples) {
  SetTallies tallies;
  for (const ExampleSet set : eval::all_example_sets) {
    tallies[set];
  }
  for (const ReplyExample& one : examples) {
    SetTally& tally = tallies[one.set];
    ++tally.examples;
    tally.twins += one.is_twin ? 1 : 0;
    tally.choosable += one.admissible.count() > 1 ? 1 : 0;
    tally.tokens +=
        language_model::tokens_at_most(one.prompt) + language_model::tokens_at_most(one.reply);
    ++tally.families[one.family];
    ++tally.choices[std::string(name(one.choice))];
  }
  return tallies;
}

std::string data_card(const ExampleSource& with, const SetTallies& tallies,
                      const std::string& command) {
  std::string text = fmt::format(
      "# Examples of prompts and an expert's replies\n\nMade by `saca {}` (version {}). Each "
      "prompt is what SACA would ask about the likeliest situation when its trigger first fires in "
      "an encounter made of a record of FARS (Fatality Analysis Reporting System, NHTSA; public "
      "domain), or in its twin without risk; speeds, places and motions are drawn, not recorded. "
      "The reply is composed from computed facts. Its choice is to do nothing wherever that is "
      "admissible by what is forecast, because it is looked at again; else of what is admissible "
      "what harms least over draws of what is left to chance, or, with cues, by the law that they "
      "are drawn by.\n\n"
      "All examples of one record are of one set. Left out: {} recorded emergencies, {} cases of "
      "families that only the test split of the suites has. No shipped scenario is among them.\n\n"
      "| set | examples | of twins | several admissible | tokens at most "
      "|\n|---|---|---|---|---|\n",
      command, SACA_VERSION, with.recorded, with.test_only);
  for (const auto& [set, tally] : tallies) {
    text += fmt::format("| {} | {} | {} | {} | {} |\n", name(set), tally.examples, tally.twins,
                        tally.choosable, tally.tokens);
  }
  text += "\n| set | family | examples |\n|---|---|---|\n";
  for (const auto& [set, tally] : tallies) {
    for (const auto& [family, count] : tally.families) {
      text += fmt::format("| {} | {} | {} |\n", name(set), family, count);
    }
  }
  text += "\n| set | choice | examples |\n|---|---|---|\n";
  for (const auto& [set, tally] : tallies) {
    for (const auto& [choice, count] : tally.choices) {
      text += fmt::format("| {} | {} | {} |\n", name(set), choice, count);
    }
  }
  return text + "\nLicence: that of SACA. FARS is in the public domain.\n";
}

json figures_of(const ExampleSource& with, const SetTallies& tallies, int failed,
                const std::string& command) {
  json out{{"meta.command", "saca " + command},      {"meta.version", SACA_VERSION},
           {"export.num_cases", with.cases.size()},  {"export.num_recorded", with.recorded},
           {"export.num_test_only", with.test_only}, {"export.num_failed", failed}};
  for (const auto& [set, tally] : tallies) {
    const std::string key = fmt::format("export.{}.", name(set));
    out[key + "num_examples"] = tally.examples;
    out[key + "num_twins"] = tally.twins;
    out[key + "num_choosable"] = tally.choosable;
    out[key + "tokens_at_most"] = tally.tokens;
    for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
      const auto found = tally.choices.find(std::string(name(policy)));
      out[fmt::format("{}choice.{}", key, name(policy))] =
          found == tally.choices.end() ? 0 : found->second;
    }
  }
  return out;
}

std::optional<Error> write_sets(const std::vector<ReplyExample>& examples,
                                const ExampleSource& with, const CasesExportOptions& options,
                                const std::string& card) {
  const std::filesystem::path folder = options.output;
  const std::string system = language_model::system_part(with.planes->inputs.harm);
  for (const ExampleSet set : eval::all_example_sets) {
    std::string lines;
    std::size_t count = 0;
    for (const ReplyExample& one : examples) {
      if (one.set == set) {
        ++count;
        lines += (options.format == "openai" ? eval::chat_json(one, system) : eval::to_json(one))
                     .dump() +
                 '\n';
      }
    }
    if (options.format == "local") {
      lines.insert(0, formats::first_json_line(examples_schema, "examples", count));
    }
    if (auto problem =
            long_work::write_output(folder / (std::string(name(set)) + ".jsonl"), lines)) {
      return problem;
    }
  }
  if (auto problem = long_work::write_output(folder / "system.txt", system)) {
    return problem;
  }
  return long_work::write_output(folder / "README.md", card);
}

int export_cases(const CasesExportOptions& options) {
  const std::filesystem::path folder = options.output;
  if (const auto problem = long_work::why_outputs_unwritable({folder / "train.jsonl"})) {
    return refused(*problem);
  }
  long_work::watch_for_interrupt();
  const auto opened = open_examples(options.examples);
  if (!opened.has_value()) {
    return refused(opened.error());
  }
  const ExampleSource& with = opened.value();
  const std::string command = fmt::format("cases export {} --format {} {}", options.examples.file,
                                          options.format, example_text(options.examples));
  auto rows = long_work::rows_of<ExampleRow>(
      {.journal = (folder / "journal").string(),
       .title = fmt::format("saca {} cases export --car {} --seed {} ({:016x})", version_text(),
                            options.examples.car, options.examples.seed, with.digest),
       .progress = "examples of replies",
       .unit = "cases",
       .count = with.cases.size(),
       .display = progress_display(),
       .threads = options.threads,
       .row = [&](std::size_t i) { return row_of(with.cases[i], with, options.examples); },
       .line_of = long_work::items_line<ReplyExample>,
       .row_from =
           [](const std::string& line) {
             return long_work::items_row<ReplyExample>(line, eval::reply_example_from_json);
           }});
  if (!rows.has_value()) {
    return refused(rows.error());
  }
  if (!rows.value()) {
    complain("interrupted: the same command goes on from here");
    return was_interrupted;
  }
  const auto [examples, problems] = long_work::all_items(*std::move(rows).value());
  complain_of(problems);
  const auto failed = static_cast<int>(problems.size());
  const SetTallies tallies = tallied(examples);
  const std::string card = data_card(with, tallies, command);
  if (const auto problem = write_sets(examples, with, options, card)) {
    return refused(*problem);
  }
  if (options.as_json) {
    app::print_json(figures_of(with, tallies, failed, command));
  } else {
    app::print("{:<12} {:>9} {:>6} {:>10} {:>10}\n", "set", "examples", "twins", "choosable",
               "tokens <=");
    for (const auto& [set, tally] : tallies) {
      app::print("{:<12} {:>9} {:>6} {:>10} {:>10}\n", name(set), tally.examples, tally.twins,
                 tally.choosable, tally.tokens);
    }
    app::print("{}: of {} cases; left out: {} recorded, {} of families for tests\n", options.output,
               with.cases.size(), with.recorded, with.test_only);
  }
  return failed == 0 ? success : some_failed;
}

}  // namespace

void add_cases_export(CLI::App& cases, int& exit_code) {
  CLI::App* const command = cases.add_subcommand(
      "export", "Writes prompts and an expert's replies as sets to teach a language model with");
  const auto options = std::make_shared<CasesExportOptions>();
  add_example_options(*command, options->examples);
  command
      ->add_option("--format", options->format,
                   "local: with what is known of each, for `training/`; openai: chat fine-tuning")
      ->check(CLI::IsMember({"local", "openai"}))
      ->capture_default_str();
  command->add_option("--output,-o", options->output, "The folder where the sets go")
      ->capture_default_str();
  command->add_option("--threads", options->threads, "They do not change the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = export_cases(*options); });
}

}  // namespace saca::app
