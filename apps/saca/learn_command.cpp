#include <fmt/core.h>

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
#include "apps/saca/planes_making.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "apps/saca/suite_running.h"
#include "apps/saca/version.h"
#include "apps/saca/within.h"
#include "saca/base/core/journal.h"
#include "saca/lab/banks/bank_files.h"
#include "saca/lab/curricula/bank_place.h"
#include "saca/lab/curricula/curriculum_json.h"
#include "saca/lab/curricula/curriculum_text.h"
#include "saca/lab/curricula/learn_request.h"
#include "saca/lab/curricula/learning_curves.h"
#include "saca/lab/curricula/school.h"
#include "saca/lab/curricula/start_digest.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using curricula::LearnRequest;

struct LearnOptions {
  LearnRequest learn;
  std::string svg;  ///< empty: none
  bool as_json = false;
};

/// What curricula are made of.
struct Lessons {
  SuiteEncounters encounters;
  std::uint64_t count = 0;  ///< encounters of each seed
  std::unique_ptr<const PlanesOfCar> planes;
  std::vector<memory::MadeWith> made_with;
  std::unique_ptr<suites::SuiteThinking> thinking;
  std::vector<memory::Case> start;  ///< what memories know at the beginning
};

/// What memories know at the beginning: a bank, the shipped cases, or nothing.
Result<std::vector<memory::Case>> first_cases(const LearnRequest& request, const Places& places) {
  if (request.empty_memory) {
    return std::vector<memory::Case>();
  }
  if (!request.from.thinking.memory.empty()) {
    auto bank = banks::read_bank(request.from.thinking.memory);
    if (!bank.has_value()) {
      return bank.error();
    }
    return std::move(bank).value().cases;
  }
  return banks::shipped_cases(places.root);
}

Result<Lessons> open_lessons(const LearnRequest& request) {
  Lessons lessons;
  suites::SuiteRequest from = request.from;
  from.count *= request.seeds;
  auto encounters = open_encounters(from, "learn");
  if (!encounters.has_value()) {
    return encounters.error();
  }
  lessons.encounters = std::move(encounters).value();
  lessons.count = static_cast<std::uint64_t>(lessons.encounters.count / request.seeds);
  if (lessons.count == 0) {
    return Error{Error::Code::out_of_range,
                 fmt::format("{}: want an encounter for each of {} seeds, got {}",
                             request.from.name, request.seeds, lessons.encounters.count)};
  }
  auto planes = open_planes(std::move(lessons.encounters.inputs));
  if (!planes.has_value()) {
    return planes.error();
  }
  lessons.planes = std::move(planes).value();
  const PlanesOfCar& of_car = *lessons.planes;
  lessons.made_with = made_with(of_car);
  auto thinking =
      suites::SuiteThinking::open({.memory = "", .model = request.from.thinking.model},
                                  lockstep_models(of_car.inputs.places, *of_car.setup.clock),
                                  lessons.made_with, request.from.threads, *of_car.setup.clock);
  if (!thinking.has_value()) {
    return thinking.error();
  }
  lessons.thinking = std::move(thinking).value();
  auto start = first_cases(request, of_car.inputs.places);
  if (!start.has_value()) {
    return start.error();
  }
  lessons.start = std::move(start).value();
  return lessons;
}

/// Goes through all lessons, from where the journal ends on.
/// @return  nullopt: interrupted
Result<std::optional<std::vector<eval::Episodes>>> learn(Lessons& lessons,
                                                         const LearnRequest& request,
                                                         const curricula::SchoolJournal& journal) {
  // Banks are replaced only where the journal is of this very work.
  if (const auto mine = Journal::open(journal.file, journal.title); !mine.has_value()) {
    return mine.error();
  }
  auto begun =
      curricula::begin_curricula({.saca = lessons.thinking->lend(lessons.planes->setup).setup,
                                  .intent = &lessons.planes->inputs.intent,
                                  .made_with = lessons.made_with,
                                  .seed = request.from.seed,
                                  .exact = request.from.exact,
                                  .lies = request.lies,
                                  .judging = {}},
                                 lessons.start, request.folder, request.seeds);
  if (!begun.has_value()) {
    return begun.error();
  }
  curricula::School school(std::move(begun).value(), lessons.encounters.at, lessons.count,
                           request.from.threads);
  return taught_by(school, journal);
}

int show(const std::vector<eval::Episodes>& all, nlohmann::json figures,
         const LearnOptions& options) {
  const std::string suite = suite_of(options.learn);
  figures.update(curricula::json_of(all, suite));
  if (!options.svg.empty()) {
    if (auto problem = long_work::write_output(
            options.svg, report::chart_svg(curricula::learning_curves(all, suite)))) {
      return refused(*problem);
    }
  }
  if (options.as_json) {
    app::print_json(figures);
  } else {
    app::print("{}\nbanks: {}/seed-*/\n", curricula::text_of(all), options.learn.folder);
  }
  return figures["learn." + suite + ".faults"].get<int>() > 0 ? some_failed : success;
}

/// Before long work: why what is to be left could not be.
std::optional<Error> why_unwritable(const LearnOptions& options, const fs::path& journal) {
  if (auto problem = long_work::why_outputs_unwritable({journal, options.svg})) {
    return problem;
  }
  if (auto problem = long_work::make_folder_of(journal)) {
    return problem;
  }
  if (auto problem =
          curricula::why_in_the_way(options.learn.from.thinking.memory, options.learn.folder)) {
    return Error{problem->code, "--memory: " + problem->message};
  }
  return std::nullopt;
}

int run(LearnOptions options) {
  LearnRequest& request = options.learn;
  if (request.folder.empty()) {
    request.folder = usual_folder(request);
  }
  const fs::path journal = fs::path(request.folder) / "episodes.journal";
  if (const auto problem = why_unwritable(options, journal)) {
    return refused(*problem);
  }
  long_work::watch_for_interrupt();
  auto opened = open_lessons(request);
  if (!opened.has_value()) {
    return refused(opened.error());
  }
  Lessons lessons = std::move(opened).value();
  const std::string command = command_text(request);
  const auto model = lessons.thinking->model_text();
  const curricula::StartDigest digest = curricula::digest_of(lessons.start, lessons.made_with);
  const auto taught =
      learn(lessons, request,
            {.file = journal,
             .title = fmt::format("saca {} {} of {}, from {}{}, with {:016x}", version_text(),
                                  command, lessons.encounters.what, digest.start,
                                  model ? ", model: " + *model : "", digest.all),
             .display = progress_display(),
             .spoilt_by_interrupt = lessons.thinking->has_model(),
             .failure = [&] { return lessons.thinking->failure(); }});
  if (!taught.has_value()) {
    return refused(taught.error());
  }
  if (!taught.value()) {
    complain("interrupted: the same command goes on from here");
    return was_interrupted;
  }
  nlohmann::json figures{{"meta.command", "saca " + command},
                         {"meta.version", SACA_VERSION},
                         {"meta.memory", digest.start}};
  if (model) {
    figures["meta.model"] = *model;
  }
  return show(*taught.value(), std::move(figures), options);
}

}  // namespace

void add_learn(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand(
      "learn",
      "Goes through encounters one after the other and remembers them; beside it the same that "
      "remembers nothing, and one that is lied to");
  const auto options = std::make_shared<LearnOptions>();
  LearnRequest& learn = options->learn;
  suites::SuiteRequest& from = learn.from;
  from.count = 200;
  add_encounter_options(*command, from);
  command->get_option("--count")->description("How many encounters of each seed");
  add_thinking_options(*command, from.thinking);
  CLI::Option* const memory = command->get_option("--memory");
  memory->description(
      "The bank that all begin with, which stays as it is (default: the shipped "
      "cases)");
  command->add_flag("--empty-memory", learn.empty_memory, "All begin with no case")
      ->excludes(memory);
  command->add_option("--seeds", learn.seeds, "How many such ways, each with encounters of its own")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command
      ->add_option("--lies", learn.lies,
                   "Share of what one memory is told that is the opposite of the truth")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_flag("--no-twins", from.no_twins,
                    "Without those without risk, which half of the encounters else are");
  command->add_option("-o,--output", learn.folder,
                      "The folder for banks and journal (default: runs/learn-...)");
  command->add_option("--svg", options->svg, "Draw how regret and memory change");
  add_threads(*command, from.threads);
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace saca::app
