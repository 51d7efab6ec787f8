#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "apps/saca/cases_commands.h"
#include "apps/saca/cases_making.h"
#include "apps/saca/json_output.h"
#include "apps/saca/resumable.h"
#include "saca/config/compressed_text.h"
#include "saca/config/json_lines.h"
#include "saca/config/json_reader.h"
#include "saca/config/json_text.h"
#include "saca/core/file.h"
#include "saca/core/fnv.h"
#include "saca/core/parallel.h"
#include "saca/eval/reply_example.h"
#include "saca/memory/case_json.h"
#include "saca/memory/store.h"
#include "saca/reason/prompt.h"
#include "saca/reason/token_bound.h"
#include "saca/sim/splits.h"

namespace saca::app {
namespace {

using eval::CrashCase;
using eval::ExampleSet;
using eval::ReplyExample;
using nlohmann::json;

constexpr std::string_view examples_schema = "saca.reply_examples/1";

struct CasesExportOptions {
  std::string file;
  std::string format = "local";
  std::string memory;  ///< a bank; empty: prompts tell of no case
  std::string car = "compact_rwd_ev";
  std::uint64_t seed = 1;
  std::string output = "runs/reply_sets";
  int threads = usual_threads();
  bool as_json = false;
};

/// What one case and its twin gave; as a line of the journal.
struct ExampleRow {
  std::vector<ReplyExample> examples;
  std::string problem;  ///< why it could not be played; else empty
};

std::string row_line(const ExampleRow& row) {
  json examples = json::array();
  for (const ReplyExample& one : row.examples) {
    examples.push_back(eval::to_json(one));
  }
  return json{{"examples", std::move(examples)}, {"problem", row.problem}}.dump();
}

Result<ExampleRow> row_from(const std::string& line) {
  const auto parsed = config::parse_json(line);
  if (!parsed.has_value()) {
    return parsed.error();
  }
  std::optional<Error> problem;
  config::JsonReader reader(parsed.value(), "", problem, "line");
  ExampleRow row{.examples = {}, .problem = reader.text("problem")};
  const json* const examples = reader.list("examples");
  reader.refuse_others();
  for (std::size_t i = 0; examples != nullptr && i < examples->size(); ++i) {
    auto one = eval::reply_example_from_json((*examples)[i]);
    if (!one.has_value()) {
      return one.error();
    }
    row.examples.push_back(std::move(one).value());
  }
  if (problem) {
    return *problem;
  }
  return row;
}

/// Cases that prompts tell of, as a run's memory would: asked by several threads.
class ToldCases {
 public:
  explicit ToldCases(std::vector<memory::Case> cases)
      : cases_(std::move(cases)), experience_(cases_) {
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      place_of_[cases_[i].id] = i;
    }
  }

  [[nodiscard]] std::optional<eval::ToldCase> in(const world::Scene& scene) const {
    const auto recalled = experience_.recall(memory::features(scene));
    if (!recalled) {
      return std::nullopt;
    }
    return eval::ToldCase{cases_[place_of_.at(recalled->nearest)], recalled->similarity};
  }

 private:
  std::vector<memory::Case> cases_;
  memory::Experience experience_;
  std::unordered_map<memory::CaseId, std::size_t> place_of_;
};

/// The cases that are exported, and what examples are made of them with.
struct Exporting {
  std::vector<CrashCase> cases;  ///< drawn from families that training may see
  int recorded = 0;              ///< left out: they cannot be drawn again
  int test_only = 0;             ///< left out: of a family that only the test split has
  std::unique_ptr<const PlanesOfCar> planes;
  std::optional<ToldCases> told;
  std::uint64_t digest = 0;  ///< of all that examples depend on, but for the options
};

Result<Exporting> open_exporting(const CasesExportOptions& options) {
  Exporting all;
  const auto text = config::read_compressed(options.file, many_bytes);
  if (!text.has_value()) {
    return text.error();
  }
  auto cases = eval::crash_cases_from_text(text.value(), options.file);
  if (!cases.has_value()) {
    return cases.error();
  }
  auto planes = open_planes(options.car);
  if (!planes.has_value()) {
    return planes.error();
  }
  all.planes = std::move(planes).value();
  const auto splits =
      sim::load_splits(all.planes->inputs.places.root / "scenarios" / "splits.toml");
  if (!splits.has_value()) {
    return splits.error();
  }
  Fnv hash;
  hash.add(text.value());
  for (CrashCase& one : std::move(cases).value()) {
    const auto& test_only = splits.value().test_only;
    if (!one.kind) {
      ++all.recorded;
    } else if (std::find(test_only.begin(), test_only.end(), *one.kind) != test_only.end()) {
      ++all.test_only;
    } else {
      all.cases.push_back(std::move(one));
    }
  }
  if (all.cases.empty()) {
    return Error{Error::Code::out_of_range,
                 fmt::format("{}: want cases that were drawn from families of the tuning split, "
                             "got {} recorded ones and {} of families for tests",
                             options.file, all.recorded, all.test_only)};
  }
  if (!options.memory.empty()) {
    auto bank = memory::Store::open_existing(options.memory);
    auto stored = bank.has_value() ? std::move(bank).value().all()
                                   : Result<std::vector<memory::Case>>(bank.error());
    if (!stored.has_value()) {
      return stored.error();
    }
    hash.add(memory::cases_text(stored.value()));
    all.told.emplace(std::move(stored).value());
  }
  all.digest = hash.value();
  return all;
}

/// Adds the example of one encounter, where its trigger fires.
void add_example(ExampleRow& row, const sim::Scenario& drawn, ReplyExample example,
                 const Exporting& with, const CasesExportOptions& options, std::uint64_t seed) {
  const Inputs& inputs = with.planes->inputs;
  const sim::Scenario world = case_world(drawn, seed);
  const auto situation = eval::situation_at_trigger(
      case_stage(world, inputs, seed, example.record + (example.is_twin ? "_twin" : "")),
      with.planes->setup.forecast);
  if (!situation.has_value()) {
    row.problem = example.record + ": " + situation.error().message;
    return;
  }
  if (!situation.value()) {
    return;
  }
  const auto told = with.told ? with.told->in(situation.value()->scene_at_trigger) : std::nullopt;
  auto made = eval::reply_example(std::move(example), *situation.value(), told, options.seed);
  if (made) {
    row.examples.push_back(*std::move(made));
  }
}

ExampleRow row_of(const CrashCase& one, const Exporting& with, const CasesExportOptions& options) {
  ExampleRow row;
  const Inputs& inputs = with.planes->inputs;
  const auto again = eval::drawn_again(one, inputs.car_name, manoeuvre::footprint(inputs.car));
  if (!again.has_value()) {
    row.problem = again.error().message;
    return row;
  }
  ReplyExample example{.record = one.record.name, .family = one.family};
  for (std::size_t k = 0; k < one.judged.happened.size(); ++k) {
    if (one.judged.happened.at(k)) {
      example.known.at(k) = one.judged.happened.at(k)->harm.value;
    }
  }
  add_example(row, again.value().scenario, example, with, options, one.seed);
  example.known = {};
  example.is_twin = true;
  add_example(row, again.value().twin, std::move(example), with, options, one.seed);
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
    tally.tokens += reason::tokens_at_most(one.prompt) + reason::tokens_at_most(one.reply);
    ++tally.families[one.family];
    ++tally.choices[std::string(name(one.choice))];
  }
  return tallies;
}

std::string data_card(const Exporting& with, const SetTallies& tallies,
                      const std::string& command) {
  std::string text = fmt::format(
      "# Examples of prompts and an expert's replies\n\nMade by `saca {}` (version {}). Each "
      "prompt is what SACA would ask about the likeliest situation when its trigger first fires in "
      "an encounter made of a record of FARS (Fatality Analysis Reporting System, NHTSA; public "
      "domain), or in its twin without risk; speeds, places and motions are drawn, not recorded. "
      "The reply is composed from computed facts. Its choice is admissible by what is forecast, "
      "and of what is admissible harms least over draws of what is left to chance.\n\n"
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

json figures_of(const Exporting& with, const SetTallies& tallies, int failed,
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

std::optional<Error> write_sets(const std::vector<ReplyExample>& examples, const Exporting& with,
                                const CasesExportOptions& options, const std::string& card) {
  const std::filesystem::path folder = options.output;
  const std::string system = reason::system_part(with.planes->inputs.harm);
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
      lines.insert(0, config::first_json_line(examples_schema, "examples", count));
    }
    if (auto problem = write_output(folder / (std::string(name(set)) + ".jsonl"), lines)) {
      return problem;
    }
  }
  if (auto problem = write_output(folder / "system.txt", system)) {
    return problem;
  }
  return write_output(folder / "README.md", card);
}

int export_cases(const CasesExportOptions& options) {
  const std::filesystem::path folder = options.output;
  if (const auto problem = why_outputs_unwritable({folder / "train.jsonl"})) {
    return refused(*problem);
  }
  watch_for_interrupt();
  const auto opened = open_exporting(options);
  if (!opened.has_value()) {
    return refused(opened.error());
  }
  const Exporting& with = opened.value();
  const std::string command = fmt::format(
      "cases export {} --format {} --car {} --seed {}{}", options.file, options.format, options.car,
      options.seed, options.memory.empty() ? "" : " --memory " + options.memory);
  auto rows = rows_of<ExampleRow>(
      {.journal = (folder / "journal").string(),
       .title = fmt::format("saca {} cases export --car {} --seed {} ({:016x})", SACA_VERSION,
                            options.car, options.seed, with.digest),
       .progress = "examples of replies",
       .unit = "cases",
       .count = with.cases.size(),
       .threads = options.threads,
       .row = [&](std::size_t i) { return row_of(with.cases[i], with, options); },
       .line_of = row_line,
       .row_from = row_from});
  if (!rows.has_value()) {
    return refused(rows.error());
  }
  if (!rows.value()) {
    complain("interrupted: the same command goes on from here");
    return was_interrupted;
  }
  std::vector<ReplyExample> examples;
  int failed = 0;
  std::vector<ExampleRow> all = *std::move(rows).value();
  for (ExampleRow& row : all) {
    if (!row.problem.empty()) {
      ++failed;
      complain(row.problem);
    }
    std::move(row.examples.begin(), row.examples.end(), std::back_inserter(examples));
  }
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
  command->add_option("FILE", options->file, "What `build` wrote")->required();
  command
      ->add_option("--format", options->format,
                   "local: with what is known of each, for `training/`; openai: chat fine-tuning")
      ->check(CLI::IsMember({"local", "openai"}))
      ->capture_default_str();
  command->add_option("--memory", options->memory,
                      "A bank whose most alike case prompts tell of; without, they tell of none");
  command->add_option("--car", options->car, "That the cases were made with")
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Of the replies' words: same seed, same bytes")
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
