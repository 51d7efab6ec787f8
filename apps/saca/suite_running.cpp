#include "apps/saca/suite_running.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>

#include "apps/saca/danger_check.h"
#include "apps/saca/planes_making.h"
#include "apps/saca/settings.h"
#include "apps/saca/suite_sources.h"
#include "apps/saca/suite_thinking.h"
#include "apps/saca/surveying.h"
#include "apps/saca/thresholds_options.h"
#include "apps/saca/version.h"
#include "saca/base/core/csv.h"
#include "saca/base/core/file.h"
#include "saca/base/core/journal.h"
#include "saca/base/core/suggestion.h"
#include "saca/lab/learned_danger/learned.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/long_work/progress.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using eval::SuiteEncounter;
using eval::SuiteRow;

// Encounters between two looks at the signals; with a model, which takes seconds for each, one.
constexpr std::size_t batch_per_thread = 16;

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) {
    all += (all.empty() ? "" : ",") + word;
  }
  return all;
}

/// A recorded driver met the world as it was recorded: so do those who are compared with it.
eval::SuiteOptions how_of(const SuiteCommandOptions& options,
                          const std::vector<std::string>& methods) {
  return {
      .methods = methods, .seed = options.seed, .exact = options.exact || options.name == "100car"};
}

/// All that encounters are run with.
struct Bench {
  SuiteEncounters source;
  std::unique_ptr<const PlanesOfCar> planes;
  std::unique_ptr<SuiteThinking> thinking;
  std::shared_ptr<const learned_danger::Network> danger;  ///< nullptr: no method needs it
  std::shared_ptr<const eval::Imitators> imitators;       ///< with those that methods need
  eval::SuiteOptions how;
};

/// The weights that are named.
/// @return  an error where they are of another car
Result<std::shared_ptr<const learned_danger::Network>> danger_of(const SuiteCommandOptions& options,
                                                                 const Inputs& inputs) {
  if (options.danger.empty()) {
    return std::shared_ptr<const learned_danger::Network>();
  }
  auto weights = read_danger_weights(options.danger);
  if (!weights.has_value()) {
    return weights.error();
  }
  const std::string ours = learned_danger::vehicle_word(inputs.car);
  if (learned_danger::vehicle_word(weights.value().inputs.car) != ours) {
    return Error{Error::Code::malformed,
                 fmt::format("{}: want weights of {}, got those of {}", options.danger,
                             inputs.car_name, weights.value().car_name)};
  }
  return std::make_shared<const learned_danger::Network>(std::move(weights).value().network);
}

Result<std::shared_ptr<Bench>> open_bench(const SuiteCommandOptions& options,
                                          const std::string& command,
                                          const std::vector<std::string>& methods) {
  auto source = open_encounters(options, command);
  if (!source.has_value()) {
    return source.error();
  }
  SuiteEncounters opened = std::move(source).value();
  auto planes = open_planes(std::move(opened.inputs), options.thresholds);
  if (!planes.has_value()) {
    return planes.error();
  }
  const PlanesOfCar& of_car = *planes.value();
  auto thinking = SuiteThinking::open(options.thinking, of_car.inputs.places, made_with(of_car),
                                      options.threads, *of_car.setup.clock);
  if (!thinking.has_value()) {
    return thinking.error();
  }
  auto danger = danger_of(options, planes.value()->inputs);
  if (!danger.has_value()) {
    return danger.error();
  }
  auto imitators = imitators_of(methods, planes.value()->inputs.places);
  if (!imitators.has_value()) {
    return imitators.error();
  }
  eval::SuiteOptions how = how_of(options, methods);
  how.imitators = imitators.value().get();
  how.danger = danger.value().get();
  how.untuned = thinking.value()->untuned();
  how.experience = thinking.value()->experience();
  return std::make_shared<Bench>(Bench{std::move(opened), std::move(planes).value(),
                                       std::move(thinking).value(), std::move(danger).value(),
                                       std::move(imitators).value(), std::move(how)});
}

/// A row, whatever happens: what cannot be drawn is a fault of that encounter.
SuiteRow row_of(Bench& bench, std::uint64_t number) {
  const auto encounter = bench.source.at(number);
  if (!encounter.has_value()) {
    return {.number = number,
            .family = "?",
            .fault = encounter.error().message,
            .risk = {},
            .twin = {},
            .driver = {}};
  }
  const SuiteThinking::Loan loan = bench.thinking->lend(bench.planes->setup);
  return eval::run_encounter(encounter.value(), bench.how, loan.setup, bench.planes->inputs.intent);
}

std::optional<std::string> untuned_text(const Bench& bench) {
  const language_model::LanguageModel* const model = bench.thinking->untuned();
  return model == nullptr ? std::nullopt : std::optional(model->description());
}

/// What the rows depend on besides the encounters.
std::string work_of(const Bench& bench, const SuiteCommandOptions& options) {
  const auto part = [](const char* name, const std::optional<std::string>& text) {
    return text ? fmt::format(", {}: {}", name, *text) : std::string();
  };
  std::string imitators;
  for (const auto& [method, network] : *bench.imitators) {
    imitators += fmt::format(", {}: {:016x}", method, network.digest());
  }
  return fmt::format(
      "{}, {}, seed {}{}{}{}{}{}: {}", bench.source.what, options.car, options.seed,
      options.exact ? ", exact" : "", thresholds_arguments(options.thresholds),
      part("memory", bench.thinking->memory_text()), part("model", bench.thinking->model_text()),
      part("untuned", untuned_text(bench)) +
          part("danger", bench.danger == nullptr
                             ? std::nullopt
                             : std::optional(fmt::format("{:016x}", bench.danger->digest()))) +
          imitators,
      joined(bench.how.methods));
}

/// Why there is no such row with this memory, model and weights; nullptr: there is.
const char* missing_for(const eval::MethodInfo& info, const ThinkingOptions& thinking,
                        const std::string& danger) {
  switch (info.needs) {
    case eval::Needs::memory:
      return thinking.memory.empty() ? "--memory FILE" : nullptr;
    case eval::Needs::model:
      return thinking.model == "off" ? "--llm MODEL" : nullptr;
    case eval::Needs::untuned:
      return thinking.untuned.empty() ? "--untuned MODEL" : nullptr;
    case eval::Needs::danger:
      return danger.empty() ? "--danger WEIGHTS" : nullptr;
    case eval::Needs::imitator:  // it is shipped
    case eval::Needs::nothing:
      return nullptr;
  }
  return nullptr;
}

}  // namespace

std::optional<std::size_t> index_of(const std::vector<std::string>& methods,
                                    std::string_view method) {
  const auto found = std::find(methods.begin(), methods.end(), method);
  return found == methods.end() ? std::nullopt
                                : std::optional(static_cast<std::size_t>(found - methods.begin()));
}

Result<std::shared_ptr<const eval::Imitators>> imitators_of(const std::vector<std::string>& methods,
                                                            const Places& places) {
  constexpr std::array<std::pair<std::string_view, const char*>, 2> files{
      {{"imitation", "compact_rwd_ev.safetensors"}, {"imitation_drivers", "drivers.safetensors"}}};
  eval::Imitators all;
  for (const auto& [method, file] : files) {
    if (!index_of(methods, method)) {
      continue;
    }
    auto read = eval::Imitator::read(places.root / "models" / "imitator" / file);
    if (!read.has_value()) {
      return read.error();
    }
    all.emplace(method, std::move(read).value());
  }
  return std::make_shared<const eval::Imitators>(std::move(all));
}

Result<std::vector<std::string>> methods_from(const std::string& list,
                                              const ThinkingOptions& thinking,
                                              const std::string& danger) {
  std::vector<std::string> names;
  std::vector<std::string> known;
  for (const eval::MethodInfo& info : eval::methods()) {
    known.emplace_back(info.name);
    if (list.empty() && missing_for(info, thinking, danger) == nullptr) {
      names.emplace_back(info.name);
    }
  }
  if (list.empty()) {
    return names;
  }
  for (const std::string_view word : fields_of(list, ',')) {
    const eval::MethodInfo* const info = eval::find_method(word);
    if (info == nullptr) {
      return Error{Error::Code::out_of_range, fmt::format("--methods: no method is called {}; {}",
                                                          word, suggestion(word, known))};
    }
    if (const char* const missing = missing_for(*info, thinking, danger)) {
      return Error{
          Error::Code::out_of_range,
          fmt::format("--methods: want {} with \"{}\", which {}", missing, word,
                      info->needs == eval::Needs::danger    ? "chooses by V_h"
                      : info->needs == eval::Needs::untuned ? "asks that one"
                                                            : "is SACA with all but that")};
    }
    if (std::find(names.begin(), names.end(), word) != names.end()) {
      return Error{Error::Code::out_of_range,
                   fmt::format("--methods: want each method once, got \"{}\" twice", word)};
    }
    names.emplace_back(word);
  }
  return names;
}

Result<std::optional<SuiteRun>> run_suite(const SuiteCommandOptions& options,
                                          const std::string& command,
                                          const std::vector<std::string>& methods) {
  const auto opened = open_bench(options, command, methods);
  if (!opened.has_value()) {
    return opened.error();
  }
  const std::shared_ptr<Bench>& bench = opened.value();
  const SuiteEncounters& source = bench->source;
  const std::string path = options.journal.empty() ? options.output + ".journal" : options.journal;
  if (auto problem = long_work::make_folder_of(path)) {
    return *problem;
  }
  const auto journal = Journal::open(
      path, fmt::format("saca {} {} of {}", version_text(), command, work_of(*bench, options)));
  if (!journal.has_value()) {
    return journal.error();
  }
  SuiteRun done{.methods = methods,
                .rows = {},
                .meta = {},
                .notes = source.notes,
                .encounter_at = source.at,
                .tried_in = {}};
  done.tried_in = [bench](const SuiteEncounter& encounter) {
    return eval::tried_in(encounter, bench->how, bench->planes->setup,
                          bench->planes->inputs.intent);
  };
  for (const std::string& line : journal.value().lines()) {
    auto row = eval::suite_row_from(line, methods.size());
    if (!row.has_value() || row.value().number != done.rows.size()) {
      return Error{Error::Code::malformed,
                   fmt::format("{}: line {}: {}", path, done.rows.size() + 2,
                               row.has_value() ? "another encounter's" : row.error().message)};
    }
    done.rows.push_back(std::move(row).value());
  }
  const auto count = static_cast<std::size_t>(source.count);
  done.rows.resize(std::min(done.rows.size(), count));

  SteadyClock clock;
  long_work::watch_for_interrupt();
  const auto before = static_cast<int>(done.rows.size());
  long_work::ProgressLine progress(command, source.count, clock, progress_display());
  const Clock::Time start = clock.now();
  const SuiteThinking& thinking = *bench->thinking;
  const std::size_t at_once =
      static_cast<std::size_t>(options.threads) * (thinking.has_model() ? 1 : batch_per_thread);
  while (done.rows.size() < count) {
    if (long_work::interrupted()) {
      return std::optional<SuiteRun>();
    }
    const std::size_t first = done.rows.size();
    std::vector<SuiteRow> next(std::min(at_once, count - first));
    in_parallel(next.size(), options.threads,
                [&](std::size_t i) { next[i] = row_of(*bench, first + i); });
    if (thinking.has_model() && long_work::interrupted()) {  // questions may have been withdrawn
      return std::optional<SuiteRun>();
    }
    if (const auto failure = thinking.failure()) {
      return Error{failure->code,
                   fmt::format("{} (in encounters {} to {}; the same command goes on there)",
                               failure->message, first, first + next.size() - 1)};
    }
    for (SuiteRow& row : next) {
      if (!journal.value().add(eval::line_of(row))) {
        return Error{Error::Code::unwritable, path + ": cannot be added to"};
      }
      done.rows.push_back(std::move(row));
    }
    progress.show(static_cast<int>(done.rows.size()), before, " encounters");
  }
  done.worked = static_cast<int>(count) - before;
  done.seconds = to_seconds(clock.now() - start);
  done.meta = {
      {"meta.command",
       fmt::format("saca {} {} --methods {} --count {} --split {} --car {} --seed {}{}{}", command,
                   options.name, joined(methods), options.count, options.split, options.car,
                   options.seed, options.exact ? " --exact" : "",
                   thinking_text(options.thinking) + thresholds_arguments(options.thresholds) +
                       (options.danger.empty() ? "" : " --danger " + options.danger) +
                       (options.no_twins ? std::string(" --no-twins") : std::string()) +
                       (options.data.empty() ? "" : " --data FOLDER"))},
      {"meta.seed", std::to_string(options.seed)},
      {"meta.n", std::to_string(count)},
      {"meta.split", options.split},
      {"meta.car", options.car},
      {"meta.version", SACA_VERSION}};
  if (const auto& memory = thinking.memory_text()) {
    done.meta["meta.memory"] = *memory;
  }
  if (const auto model = thinking.model_text()) {
    done.meta["meta.model"] = *model;
  }
  if (const auto model = untuned_text(*bench)) {
    done.meta["meta.untuned"] = *model;
  }
  return std::optional(std::move(done));
}

Result<std::string> write_encounter(const SuiteCommandOptions& options, std::uint64_t number) {
  const auto source = open_encounters(options, "suite");
  if (!source.has_value()) {
    return source.error();
  }
  const auto encounter = source.value().at(number);
  if (!encounter.has_value()) {
    return encounter.error();
  }
  const eval::SuiteOptions how = how_of(options, {});
  const fs::path file =
      fs::path("runs") / fmt::format("{}-{}-{}.toml", fs::path(options.name).filename().string(),
                                     options.split, number);
  if (auto problem = long_work::write_output(
          file, scenario::write_scenario(eval::as_played(encounter.value().scenario, how)))) {
    return *problem;
  }
  const ThinkingOptions& thinking = options.thinking;
  return fmt::format(
      "saca run {} --pace lockstep --llm {}{}{}", file.string(), thinking.model,
      (thinking.model == "off" ? "" : " --danger off") +
          (thinking.memory.empty() ? " --no-memory" : " --no-learning --memory " + thinking.memory),
      how.exact ? std::string()
                : fmt::format(" --seed {}", eval::encounter_seed(options.seed, number)));
}

void add_suite_options(CLI::App& command, SuiteCommandOptions& options) {
  command
      .add_option(
          "name", options.name,
          "A suite (natural, balanced), a family, a table of the paper (table_2, table_2_late, "
          "table_3), a folder of scenarios, 100car, traffic, or a regulation (fmvss127, r152)")
      ->required();
  command.add_option("--data", options.data,
                     "Of 100car the folder of the study's release; of traffic (SACA in shadow) "
                     "folders with CommonRoad files or that release");
  add_draw_options(command, options.count, options.split, options.test_log, options.car);
  add_thinking_options(command, options.thinking);
  add_thresholds_options(command, options.thresholds);
  command.add_option("--danger", options.danger,
                     "Weights of V_h and Q_h (models/danger), for methods that choose by them");
  command.add_option("--seed", options.seed, "Of all that is drawn: same seed, same rows")
      ->capture_default_str();
  command.add_flag("--exact", options.exact,
                   "Nothing is left to chance, and perception is as the scenarios have it");
  command.add_option("--output", options.output,
                     "Rows as HDF5; beside them .json and .html (default: runs/...)");
  command.add_option("--threads", options.threads, "They do not change the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
}

}  // namespace saca::app
