#include <fmt/core.h>

#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/forecast_commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/memory_commands.h"
#include "apps/saca/places.h"
#include "apps/saca/planes_making.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "apps/saca/version.h"
#include "saca/lab/encounter/learnt_case.h"
#include "saca/lab/eval/trigger_case.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/items_row.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/long_work/resumable_work.h"
#include "saca/thinking/memory/case_json.h"

namespace saca::app {
namespace {

using nlohmann::json;

struct BuildOptions {
  SuiteCommandOptions from;  ///< which encounters; nobody acts in them
  std::size_t draws = 64;
  bool no_twins = false;
  bool as_json = false;
};

/// What one encounter gave, and its twin without risk: none where the trigger never fires.
using Gained = long_work::ItemsRow<memory::Case>;

/// What cases are worked out with; the planes outlive it.
struct CaseTools {
  CaseTools(const PlanesOfCar& of, std::size_t num_draws)
      : planes(of), draws(num_draws), made_with(app::made_with(of)) {}

  const PlanesOfCar& planes;
  std::size_t draws;
  std::vector<memory::MadeWith> made_with;
};

void gain(Gained& gained, const encounter::Stage& stage, const CaseTools& with) {
  auto one = eval::case_at_trigger(stage, with.planes.setup.forecast, with.draws, with.made_with);
  if (!one.has_value()) {
    gained.problem = one.error().message;
  } else if (one.value()) {
    gained.items.push_back(*std::move(one).value());
  }
}

Gained gained_of(const SuiteEncounters& encounters, const BuildOptions& options,
                 const CaseTools& with, std::size_t number) {
  Gained gained;
  const auto played = played_encounter(encounters, options.from, number);
  if (!played.has_value()) {
    gained.problem = played.error().message;
    return gained;
  }
  gain(gained, played.value().stage(with.planes.inputs), with);
  if (played.value().twin && !options.no_twins) {
    gain(gained, played.value().twin_stage(with.planes.inputs), with);
  }
  return gained;
}

/// All encounters, from where the journal ends on.
/// @return  nullopt: interrupted
Result<std::optional<std::vector<Gained>>> gather(const BuildOptions& options,
                                                  const std::string& command) {
  auto opened = open_encounters(options.from, command);
  if (!opened.has_value()) {
    return opened.error();
  }
  SuiteEncounters encounters = std::move(opened).value();
  const auto planes = open_planes(std::move(encounters.inputs));
  if (!planes.has_value()) {
    return planes.error();
  }
  const CaseTools with{*planes.value(), options.draws};
  return long_work::rows_of<Gained>(
      {.journal =
           options.from.journal.empty() ? options.from.output + ".journal" : options.from.journal,
       .title = fmt::format("saca {} {} of {}", version_text(), command, encounters.what),
       .progress = "memory of " + options.from.name,
       .unit = "encounters",
       .count = static_cast<std::size_t>(encounters.count),
       .display = progress_display(),
       .threads = options.from.threads,
       .row = [&](std::size_t number) { return gained_of(encounters, options, with, number); },
       .line_of = long_work::items_line<memory::Case>,
       .row_from =
           [](const std::string& line) {
             return long_work::items_row<memory::Case>(line, memory::case_from_json);
           }});
}

int build(const BuildOptions& options) {
  const SuiteCommandOptions& from = options.from;
  if (const auto problem = long_work::why_outputs_unwritable({from.output})) {
    return refused(*problem);
  }
  long_work::watch_for_interrupt();
  const std::string command =
      fmt::format("memory build {} --split {} --car {} --seed {} --draws {}{}{}", from.name,
                  from.split, from.car, from.seed, options.draws, from.exact ? " --exact" : "",
                  options.no_twins ? " --no-twins" : "");
  auto gathered = gather(options, command);
  if (!gathered.has_value()) {
    return refused(gathered.error());
  }
  if (!gathered.value()) {
    complain("interrupted: the same command goes on from here");
    return was_interrupted;
  }
  const std::size_t num_encounters = gathered.value()->size();
  auto [cases, problems] = long_work::all_items(*std::move(gathered).value());
  complain_of(problems);
  const std::size_t num_failed = problems.size();
  std::array<int, manoeuvre::num_policies> best{};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    cases[i].id = static_cast<match::CaseId>(i + 1);
    ++best.at(manoeuvre::index(cases[i].best));
  }
  if (const auto problem = long_work::write_output(from.output, memory::cases_text(cases))) {
    return refused(*problem);
  }
  if (options.as_json) {
    json out{{"meta.command", "saca " + command},
             {"meta.version", SACA_VERSION},
             {"memory.num_encounters", num_encounters},
             {"memory.num_cases", cases.size()},
             {"memory.num_failed", num_failed}};
    for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
      out[fmt::format("memory.best.{}", name(policy))] = best.at(manoeuvre::index(policy));
    }
    app::print("{}\n", json_text(out));
  } else {
    app::print("{}: {} cases of {} encounters; best", from.output, cases.size(), num_encounters);
    for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
      app::print(" {} {}", name(policy), best.at(manoeuvre::index(policy)));
    }
    app::print("\n");
  }
  return num_failed == 0 ? success : some_failed;
}

}  // namespace

void add_memory_build(CLI::App& memory, int& exit_code) {
  CLI::App* const command = memory.add_subcommand(
      "build", "Makes cases of the encounters of a suite, as JSON Lines for `import`");
  const auto options = std::make_shared<BuildOptions>();
  SuiteCommandOptions& from = options->from;
  from.split = "tuning";
  from.output = "runs/cases.jsonl";
  add_encounter_options(*command, from);
  command->add_option("--draws", options->draws, "That expected harm is the mean of")
      ->check(CLI::Range(1, 1'000))
      ->capture_default_str();
  command->add_flag("--no-twins", options->no_twins,
                    "Without those without risk: a memory of accidents alone expects them");
  command->add_option("--output,-o", from.output, "Where the cases go")->capture_default_str();
  command->add_option("--journal", from.journal,
                      "What was found so far (default: beside the output)");
  command->add_option("--threads", from.threads, "They do not change the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = build(*options); });
}

}  // namespace saca::app
