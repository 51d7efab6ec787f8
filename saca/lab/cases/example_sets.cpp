#include "saca/lab/cases/example_sets.h"

#include <fmt/core.h>

#include <utility>

#include "saca/base/formats/json_lines.h"
#include "saca/lab/cases/drawn_examples.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/long_work/resumable_work.h"
#include "saca/thinking/language_model/token_bound.h"

namespace saca::cases {

using nlohmann::json;

namespace {

constexpr std::string_view examples_schema = "saca.reply_examples/1";

/// What one case and its twin gave.
using ExampleRow = long_work::ItemsRow<ReplyExample>;

ExampleRow example_row(const CrashCase& one, const ExampleSource& source, std::uint64_t words) {
  DrawnExamples drawn = drawn_examples(one, source, words);
  ExampleRow row{.items = {}, .problem = std::move(drawn.problem)};
  for (DrawnExample& each : drawn.examples) {
    row.items.push_back(std::move(each.example));
  }
  return row;
}

/// A file's text.
std::string set_lines(const std::vector<ReplyExample>& examples, ExampleSet set, SetFormat format,
                      const std::string& system) {
  std::string lines;
  std::size_t count = 0;
  for (const ReplyExample& one : examples) {
    if (one.set == set) {
      ++count;
      const json line = format == SetFormat::openai ? chat_json(one, system) : to_json(one);
      lines += line.dump() + '\n';
    }
  }
  if (format == SetFormat::local) {
    lines.insert(0, formats::first_json_line(examples_schema, "examples", count));
  }
  return lines;
}

}  // namespace

Result<std::optional<long_work::AllItems<ReplyExample>>> all_examples(const ExampleSource& source,
                                                                      const ExampleWork& work) {
  auto rows = long_work::rows_of<ExampleRow>(
      {.journal = work.journal,
       .title = fmt::format("{} ({:016x})", work.title, source.digest),
       .progress = "examples of replies",
       .unit = "cases",
       .count = source.cases.size(),
       .display = work.display,
       .threads = work.threads,
       .row = [&](std::size_t i) { return example_row(source.cases[i], source, work.words); },
       .line_of = long_work::items_line<ReplyExample>,
       .row_from =
           [](const std::string& line) {
             return long_work::items_row<ReplyExample>(line, reply_example_from_json);
           }});
  if (!rows.has_value()) {
    return rows.error();
  }
  if (!rows.value()) {
    return std::optional<long_work::AllItems<ReplyExample>>();
  }
  return std::optional(long_work::all_items(*std::move(rows).value()));
}

SetTallies set_tallies(const std::vector<ReplyExample>& examples) {
  SetTallies tallies;
  for (const ExampleSet set : all_example_sets) {
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

std::string data_card(const ExampleSource& source, const SetTallies& tallies,
                      const std::string& command, std::string_view version) {
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
      command, version, source.recorded, source.test_only);
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

json sets_json(const ExampleSource& source, const SetTallies& tallies, std::size_t failed) {
  json out{{"export.num_cases", source.cases.size()},
           {"export.num_recorded", source.recorded},
           {"export.num_test_only", source.test_only},
           {"export.num_failed", failed}};
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

std::string sets_text(const ExampleSource& source, const SetTallies& tallies,
                      const std::string& folder) {
  std::string text = fmt::format("{:<12} {:>9} {:>6} {:>10} {:>10}\n", "set", "examples", "twins",
                                 "choosable", "tokens <=");
  for (const auto& [set, tally] : tallies) {
    text += fmt::format("{:<12} {:>9} {:>6} {:>10} {:>10}\n", name(set), tally.examples,
                        tally.twins, tally.choosable, tally.tokens);
  }
  return text + fmt::format("{}: of {} cases; left out: {} recorded, {} of families for tests\n",
                            folder, source.cases.size(), source.recorded, source.test_only);
}

std::optional<SetFormat> set_format_from(std::string_view name) {
  return name == "local"    ? std::optional(SetFormat::local)
         : name == "openai" ? std::optional(SetFormat::openai)
                            : std::nullopt;
}

std::optional<Error> write_sets(const std::filesystem::path& folder,
                                const std::vector<ReplyExample>& examples, SetFormat format,
                                const std::string& system, const std::string& card) {
  for (const ExampleSet set : all_example_sets) {
    if (auto problem = long_work::write_output(folder / (std::string(name(set)) + ".jsonl"),
                                               set_lines(examples, set, format, system))) {
      return problem;
    }
  }
  if (auto problem = long_work::write_output(folder / "system.txt", system)) {
    return problem;
  }
  return long_work::write_output(folder / "README.md", card);
}

}  // namespace saca::cases
