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
#include "apps/saca/progress.h"
#include "saca/config/json_reader.h"
#include "saca/config/json_text.h"
#include "saca/core/journal.h"
#include "saca/core/parallel.h"
#include "saca/eval/trigger_case.h"
#include "saca/loop/learnt_case.h"
#include "saca/memory/case_json.h"

namespace saca::app {
namespace {

using nlohmann::json;

struct BuildOptions {
  SuiteCommandOptions from;  ///< which encounters; nobody acts in them
  std::size_t draws = 64;
  bool no_twins = false;
  bool as_json = false;
};

/// What one encounter gave, and its twin without risk; as a line of the journal.
struct Gained {
  std::vector<memory::Case> cases;  ///< none where the trigger never fires
  std::string problem;              ///< why it could not be played; else empty
};

std::string line_of(const Gained& gained) {
  json cases = json::array();
  for (const memory::Case& one : gained.cases) {
    cases.push_back(memory::to_json(one));
  }
  return json{{"cases", cases}, {"problem", gained.problem}}.dump();
}

Result<Gained> gained_from(const std::string& line) {
  const auto parsed = config::parse_json(line);
  if (!parsed.has_value()) {
    return parsed.error();
  }
  std::optional<Error> problem;
  config::JsonReader reader(parsed.value(), "", problem, "line");
  Gained gained{.cases = {}, .problem = reader.text("problem")};
  const json* const cases = reader.list("cases");
  reader.refuse_others();
  for (std::size_t i = 0; cases != nullptr && i < cases->size(); ++i) {
    auto one = memory::case_from_json((*cases)[i]);
    if (!one.has_value()) {
      return one.error();
    }
    gained.cases.push_back(std::move(one).value());
  }
  if (problem) {
    return *problem;
  }
  return gained;
}

void gain(Gained& gained, const loop::Stage& stage, const preview::ForecastTools& tools,
          std::size_t draws, const std::vector<memory::MadeWith>& made_with) {
  auto one = eval::case_at_trigger(stage, tools, draws, made_with);
  if (!one.has_value()) {
    gained.problem = one.error().message;
  } else if (one.value()) {
    gained.cases.push_back(*std::move(one).value());
  }
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
  const std::string path =
      options.from.journal.empty() ? options.from.output + ".journal" : options.from.journal;
  if (auto problem = make_folder_of(path)) {
    return *problem;
  }
  const auto journal =
      Journal::open(path, fmt::format("saca {} {} of {}", SACA_VERSION, command, encounters.what));
  if (!journal.has_value()) {
    return journal.error();
  }
  std::vector<Gained> all;
  for (const std::string& line : journal.value().lines()) {
    auto gained = gained_from(line);
    if (!gained.has_value()) {
      return Error{Error::Code::malformed,
                   fmt::format("{}: line {}: {}", path, all.size() + 2, gained.error().message)};
    }
    all.push_back(std::move(gained).value());
  }
  const auto count = static_cast<std::size_t>(encounters.count);
  all.resize(std::min(all.size(), count));
  const auto before = static_cast<int>(all.size());
  SteadyClock clock;
  ProgressLine progress("memory of " + options.from.name, encounters.count, clock);
  const Inputs& inputs = planes.value()->inputs;
  const preview::ForecastTools& tools = planes.value()->setup.forecast;
  const auto made_with = loop::made_with(tools, inputs.intent, inputs.car_name);
  while (all.size() < count) {
    if (interrupted()) {
      return std::optional<std::vector<Gained>>();
    }
    const std::size_t first = all.size();
    constexpr std::size_t at_once = 32;
    std::vector<Gained> next(std::min(at_once, count - first));
    in_parallel(next.size(), options.from.threads, [&](std::size_t i) {
      const auto played = played_encounter(encounters, options.from, first + i);
      if (!played.has_value()) {
        next[i].problem = played.error().message;
        return;
      }
      gain(next[i], played.value().stage(inputs), tools, options.draws, made_with);
      if (played.value().twin && !options.no_twins) {
        gain(next[i], played.value().twin_stage(inputs), tools, options.draws, made_with);
      }
    });
    for (Gained& gained : next) {
      if (!journal.value().add(line_of(gained))) {
        return Error{Error::Code::unwritable, path + ": cannot be added to"};
      }
      all.push_back(std::move(gained));
    }
    progress.show(static_cast<int>(all.size()), before, " encounters");
  }
  return std::optional(std::move(all));
}

int build(const BuildOptions& options) {
  const SuiteCommandOptions& from = options.from;
  if (const auto problem = why_outputs_unwritable({from.output})) {
    return refused(*problem);
  }
  watch_for_interrupt();
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
  std::vector<Gained> all = *std::move(gathered).value();
  std::vector<memory::Case> cases;
  int num_failed = 0;
  std::array<int, manoeuvre::num_policies> best{};
  for (Gained& gained : all) {
    if (!gained.problem.empty()) {
      ++num_failed;
      complain(gained.problem);
    }
    for (memory::Case& one : gained.cases) {
      one.id = static_cast<memory::CaseId>(cases.size() + 1);
      ++best.at(manoeuvre::index(one.best));
      cases.push_back(std::move(one));
    }
  }
  if (const auto problem = write_output(from.output, memory::cases_text(cases))) {
    return refused(*problem);
  }
  if (options.as_json) {
    json out{{"meta.command", "saca " + command},
             {"meta.version", SACA_VERSION},
             {"memory.num_encounters", all.size()},
             {"memory.num_cases", cases.size()},
             {"memory.num_failed", num_failed}};
    for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
      out[fmt::format("memory.best.{}", name(policy))] = best.at(manoeuvre::index(policy));
    }
    app::print("{}\n", json_text(out));
  } else {
    app::print("{}: {} cases of {} encounters; best", from.output, cases.size(), all.size());
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
