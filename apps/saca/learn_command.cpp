#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/forecast_commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/learn_figures.h"
#include "apps/saca/planes_making.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "apps/saca/suite_running.h"
#include "apps/saca/version.h"
#include "saca/base/core/fnv.h"
#include "saca/base/core/journal.h"
#include "saca/base/core/parallel.h"
#include "saca/base/formats/json_text.h"
#include "saca/lab/banks/bank_files.h"
#include "saca/lab/eval/curriculum.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/long_work/resumable_work.h"
#include "saca/thinking/memory/case_json.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using eval::Curriculum;
using eval::Episode;
using eval::Episodes;
using nlohmann::json;

struct LearnOptions {
  SuiteCommandOptions from;  ///< which encounters; `count` of each seed
  int seeds = 5;
  double lies = 0.05;
  bool empty_memory = false;
  std::string folder;  ///< empty: runs/learn-NAME-SPLIT
  std::string svg;     ///< empty: none
  bool as_json = false;
};

/// The curricula of all seeds, and what they are made of.
struct School {
  SuiteEncounters encounters;
  std::unique_ptr<const PlanesOfCar> planes;
  std::unique_ptr<suites::SuiteThinking> thinking;
  std::vector<memory::MadeWith> made_with;
  std::vector<memory::Case> start;    ///< what memories know at the beginning
  std::vector<Curriculum> curricula;  ///< by seed
  std::uint64_t count = 0;            ///< encounters of each seed
  int threads = 1;
  std::optional<Error> failure;  ///< a bank could not be written

  /// Encounter `number` of all seeds, played and learnt. Each seed has encounters of its own.
  [[nodiscard]] Episodes teach(std::uint64_t number);
  /// The numbers of these encounters.
  [[nodiscard]] std::vector<std::uint64_t> numbers_of(std::uint64_t number) const;
  /// Learns what was played before.
  [[nodiscard]] std::optional<Error> learn(Episodes& episodes);
};

std::vector<std::uint64_t> School::numbers_of(std::uint64_t number) const {
  std::vector<std::uint64_t> numbers(curricula.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    numbers[k] = k * count + number;
  }
  return numbers;
}

Episodes School::teach(std::uint64_t number) {
  const std::vector<std::uint64_t> numbers = numbers_of(number);
  Episodes episodes;
  episodes.of.resize(curricula.size());
  in_parallel(curricula.size(), threads, [&](std::size_t k) {
    const auto encounter = encounters.at(numbers[k]);
    if (encounter.has_value()) {
      episodes.of[k] = curricula[k].play(encounter.value());
    } else {
      episodes.of[k].row.number = numbers[k];
      episodes.of[k].row.family = "?";
      episodes.of[k].row.fault = encounter.error().message;
    }
  });
  if (auto problem = learn(episodes)) {
    failure = std::move(problem);
  }
  return episodes;
}

std::optional<Error> School::learn(Episodes& episodes) {
  std::vector<std::optional<Error>> problems(curricula.size());
  episodes.size.resize(curricula.size());
  in_parallel(curricula.size(), threads, [&](std::size_t k) {
    problems[k] = curricula[k].learn(episodes.of[k]);
    episodes.size[k] = curricula[k].sizes();
  });
  const auto first = std::find_if(problems.begin(), problems.end(),
                                  [](const auto& problem) { return problem.has_value(); });
  return first == problems.end() ? std::nullopt : std::move(*first);
}

std::string line_of(const Episodes& episodes) {
  json line = json::array();
  for (const Episode& one : episodes.of) {
    line.push_back(to_json(one));
  }
  return line.dump();
}

/// @param numbers  of the encounter of each seed
Result<Episodes> episodes_from(const std::string& line, const std::vector<std::uint64_t>& numbers) {
  const auto read = formats::parse_json(line);
  if (!read.has_value()) {
    return read.error();
  }
  if (!read.value().is_array() || read.value().size() != numbers.size()) {
    return Error{Error::Code::malformed,
                 fmt::format("want the episodes of {} seeds", numbers.size())};
  }
  Episodes episodes;
  for (const json& one : read.value()) {
    auto episode = eval::episode_from_json(one);
    if (!episode.has_value()) {
      return episode.error();
    }
    const std::uint64_t number = numbers[episodes.of.size()];
    if (episode.value().row.number != number) {
      return Error{Error::Code::malformed,
                   fmt::format("want encounter {}, got {}", number, episode.value().row.number)};
    }
    episodes.of.push_back(std::move(episode).value());
  }
  return episodes;
}

/// What memories know at the beginning: a bank, the shipped cases, or nothing.
Result<std::vector<memory::Case>> first_cases(const LearnOptions& options, const School& school) {
  if (options.empty_memory) {
    return std::vector<memory::Case>();
  }
  if (!options.from.thinking.memory.empty()) {
    auto bank = banks::read_bank(options.from.thinking.memory);
    if (!bank.has_value()) {
      return bank.error();
    }
    return std::move(bank).value().cases;
  }
  return banks::shipped_cases(school.planes->inputs.places.root);
}

/// Makes the banks of all seeds, in the place of those that were there.
std::optional<Error> enrol(School& school, const LearnOptions& options) {
  for (int k = 0; k < options.seeds; ++k) {
    const fs::path folder = fs::path(options.folder) / fmt::format("seed-{}", k + 1);
    if (auto problem = long_work::make_folder_of(folder / "bank")) {
      return problem;
    }
    eval::CurriculumSetup setup{.saca = school.thinking->lend(school.planes->setup).setup,
                                .intent = &school.planes->inputs.intent,
                                .made_with = school.made_with,
                                .seed = options.from.seed + static_cast<std::uint64_t>(k),
                                .exact = options.from.exact,
                                .lies = options.lies,
                                .judging = {}};
    auto curriculum = Curriculum::begin(std::move(setup), school.start, folder);
    if (!curriculum.has_value()) {
      return curriculum.error();
    }
    school.curricula.push_back(std::move(curriculum).value());
  }
  return std::nullopt;
}

Result<std::unique_ptr<School>> open_school(const LearnOptions& options) {
  auto school = std::make_unique<School>();
  SuiteCommandOptions from = options.from;
  from.count *= options.seeds;
  auto encounters = open_encounters(from, "learn");
  if (!encounters.has_value()) {
    return encounters.error();
  }
  school->encounters = std::move(encounters).value();
  school->count = static_cast<std::uint64_t>(school->encounters.count / options.seeds);
  school->threads = options.from.threads;
  if (school->count == 0) {
    return Error{Error::Code::out_of_range,
                 fmt::format("{}: want an encounter for each of {} seeds, got {}",
                             options.from.name, options.seeds, school->encounters.count)};
  }
  auto planes = open_planes(std::move(school->encounters.inputs));
  if (!planes.has_value()) {
    return planes.error();
  }
  school->planes = std::move(planes).value();
  school->made_with = made_with(*school->planes);
  auto thinking = suites::SuiteThinking::open(
      {.memory = "", .model = options.from.thinking.model},
      lockstep_models(school->planes->inputs.places, *school->planes->setup.clock),
      school->made_with, options.from.threads, *school->planes->setup.clock);
  if (!thinking.has_value()) {
    return thinking.error();
  }
  school->thinking = std::move(thinking).value();
  auto start = first_cases(options, *school);
  if (!start.has_value()) {
    return start.error();
  }
  school->start = std::move(start).value();
  return school;
}

/// All encounters one after the other, from where the journal ends on.
/// @return  nullopt: interrupted
Result<std::optional<std::vector<Episodes>>> taught_by(School& school, const fs::path& journal,
                                                       const std::string& title) {
  return long_work::rows_of<Episodes>(
      {.journal = journal.string(),
       .title = title,
       .progress = "learn",
       .unit = "encounters of each seed",
       .count = school.count,
       .display = progress_display(),
       .threads = 1,  // one after the other: seeds are worked on at the same time
       .row = [&](std::size_t number) { return school.teach(number); },
       .line_of = [](const Episodes& episodes) { return line_of(episodes); },
       .row_from = [&, number =
                           std::uint64_t{0}](const std::string& line) mutable -> Result<Episodes> {
         auto read = episodes_from(line, school.numbers_of(number++));
         if (!read.has_value()) {
           return read;
         }
         Episodes episodes = std::move(read).value();
         if (auto problem = school.learn(episodes)) {
           return *std::move(problem);
         }
         return episodes;
       },
       .spoilt_by_interrupt = school.thinking->has_model(),
       .failure = [&]() -> std::optional<Error> {
         const auto failure = school.thinking->failure();
         return failure ? failure : school.failure;
       }});
}

/// A bank that lies where banks are replaced.
std::optional<Error> why_in_the_way(const LearnOptions& options) {
  std::error_code ignored;
  const fs::path bank = fs::weakly_canonical(options.from.thinking.memory, ignored);
  const fs::path folder = fs::weakly_canonical(options.folder, ignored);
  const bool inside =
      std::mismatch(folder.begin(), folder.end(), bank.begin(), bank.end()).first == folder.end();
  return inside ? std::optional(Error{
                      Error::Code::out_of_range,
                      fmt::format("--memory: want a bank outside of {}, whose banks are replaced, "
                                  "got {}",
                                  options.folder, options.from.thinking.memory)})
                : std::nullopt;
}

int run(LearnOptions options) {
  if (options.folder.empty()) {
    options.folder = fmt::format(
        "runs/learn-{}-{}", fs::path(options.from.name).filename().string(), options.from.split);
  }
  const fs::path journal = fs::path(options.folder) / "episodes.journal";
  if (const auto problem = long_work::why_outputs_unwritable({journal, options.svg})) {
    return refused(*problem);
  }
  if (auto problem = long_work::make_folder_of(journal)) {
    return refused(*problem);
  }
  if (auto problem = why_in_the_way(options)) {
    return refused(*problem);
  }
  long_work::watch_for_interrupt();
  const auto opened = open_school(options);
  if (!opened.has_value()) {
    return refused(opened.error());
  }
  School& school = *opened.value();
  const SuiteCommandOptions& from = options.from;
  const std::string command =
      fmt::format("learn {} --count {} --seeds {} --split {} --car {} --seed {} --lies {}{}{}{}{}",
                  from.name, from.count, options.seeds, from.split, from.car, from.seed,
                  options.lies, from.exact ? " --exact" : "", from.no_twins ? " --no-twins" : "",
                  options.empty_memory ? " --empty-memory" : "", thinking_text(from.thinking));
  const auto model = school.thinking->model_text();
  Fnv hash;
  hash.add(memory::cases_text(school.start));
  const std::string starts_with =
      fmt::format("{} cases ({:016x})", school.start.size(), hash.value());
  for (const memory::MadeWith& one : school.made_with) {
    hash.add(one.digest);
  }
  const std::string title = fmt::format("saca {} {} of {}, from {}{}, with {:016x}", version_text(),
                                        command, school.encounters.what, starts_with,
                                        model ? ", model: " + *model : "", hash.value());
  // Banks are replaced only where the journal is of this very work.
  if (const auto mine = Journal::open(journal, title); !mine.has_value()) {
    return refused(mine.error());
  }
  if (auto problem = enrol(school, options)) {
    return refused(*problem);
  }
  const auto taught = taught_by(school, journal, title);
  if (!taught.has_value()) {
    return refused(taught.error());
  }
  if (!taught.value()) {
    complain("interrupted: the same command goes on from here");
    return was_interrupted;
  }
  const std::vector<Episodes>& all = *taught.value();
  const std::string suite = fs::path(from.name).filename().string();
  json figures = learn_figures(all, suite);
  figures["meta.command"] = "saca " + command;
  figures["meta.version"] = SACA_VERSION;
  figures["meta.memory"] = starts_with;
  if (model) {
    figures["meta.model"] = *model;
  }
  if (!options.svg.empty()) {
    if (auto problem = long_work::write_output(options.svg, learn_curve(all, suite))) {
      return refused(*problem);
    }
  }
  if (options.as_json) {
    app::print_json(figures);
  } else {
    print_learnt(all);
    app::print("\nbanks: {}/seed-*/\n", options.folder);
  }
  return figures["learn." + suite + ".faults"].get<int>() > 0 ? some_failed : success;
}

}  // namespace

void add_learn(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand(
      "learn",
      "Goes through encounters one after the other and remembers them; beside it the same that "
      "remembers nothing, and one that is lied to");
  const auto options = std::make_shared<LearnOptions>();
  SuiteCommandOptions& from = options->from;
  from.count = 200;
  add_encounter_options(*command, from);
  command->get_option("--count")->description("How many encounters of each seed");
  add_thinking_options(*command, from.thinking);
  CLI::Option* const memory = command->get_option("--memory");
  memory->description(
      "The bank that all begin with, which stays as it is (default: the shipped "
      "cases)");
  command->add_flag("--empty-memory", options->empty_memory, "All begin with no case")
      ->excludes(memory);
  command
      ->add_option("--seeds", options->seeds, "How many such ways, each with encounters of its own")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command
      ->add_option("--lies", options->lies,
                   "Share of what one memory is told that is the opposite of the truth")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_flag("--no-twins", from.no_twins,
                    "Without those without risk, which half of the encounters else are");
  command->add_option("-o,--output", options->folder,
                      "The folder for banks and journal (default: runs/learn-...)");
  command->add_option("--svg", options->svg, "Draw how regret and memory change");
  command->add_option("--threads", from.threads, "They do not change the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace saca::app
