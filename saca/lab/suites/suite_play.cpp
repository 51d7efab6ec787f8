#include "saca/lab/suites/suite_play.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "saca/base/core/clock.h"
#include "saca/base/core/journal.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/suites/method_list.h"
#include "saca/lab/suites/thresholds_text.h"

namespace saca::suites {
namespace {

namespace fs = std::filesystem;
using eval::SuiteEncounter;
using eval::SuiteRow;

// Encounters between two looks at the signals; with a model, which takes seconds for each, one.
constexpr std::size_t batch_per_thread = 16;

/// A bench, and how methods use it: they point into it.
struct Play {
  SuiteBench bench;
  eval::SuiteOptions how;
};

std::shared_ptr<Play> play_of(SuiteBench bench, const SuiteRequest& request,
                              const std::vector<std::string>& methods) {
  auto play = std::make_shared<Play>(Play{std::move(bench), how_of(request, methods)});
  play->how.imitators = play->bench.imitators.get();
  play->how.danger = play->bench.danger.get();
  play->how.untuned = play->bench.thinking->untuned();
  play->how.experience = play->bench.thinking->experience();
  return play;
}

/// A row, whatever happens: what cannot be drawn is a fault of that encounter.
SuiteRow row_of(Play& play, std::uint64_t number) {
  const auto encounter = play.bench.source.at(number);
  if (!encounter.has_value()) {
    return {.number = number,
            .family = "?",
            .fault = encounter.error().message,
            .risk = {},
            .twin = {},
            .driver = {}};
  }
  const SuiteThinking::Loan loan = play.bench.thinking->lend(*play.bench.setup);
  return eval::run_encounter(encounter.value(), play.how, loan.setup, *play.bench.intent);
}

std::optional<std::string> untuned_text(const SuiteThinking& thinking) {
  const language_model::LanguageModel* const model = thinking.untuned();
  return model == nullptr ? std::nullopt : std::optional(model->description());
}

/// What the rows depend on besides the encounters.
std::string work_of(const Play& play, const SuiteRequest& request) {
  const auto part = [](const char* name, const std::optional<std::string>& text) {
    return text ? fmt::format(", {}: {}", name, *text) : std::string();
  };
  const SuiteBench& bench = play.bench;
  std::string imitators;
  for (const auto& [method, network] : *bench.imitators) {
    imitators += fmt::format(", {}: {:016x}", method, network.digest());
  }
  return fmt::format(
      "{}, intentions {:016x}, {}, seed {}{}{}{}{}{}: {}", bench.source.what,
      intent::digest(*bench.intent), request.car, request.seed,
      std::string(request.exact ? ", exact" : "") + (request.no_twins ? ", no twins" : ""),
      thresholds_arguments(request.thresholds), part("memory", bench.thinking->memory_text()),
      part("model", bench.thinking->model_text()),
      part("untuned", untuned_text(*bench.thinking)) +
          part("danger", bench.danger == nullptr
                             ? std::nullopt
                             : std::optional(fmt::format("{:016x}", bench.danger->digest()))) +
          imitators,
      joined(play.how.methods));
}

/// What the journal holds, as far as it was asked for.
std::optional<Error> take_up_rows(const Journal& journal, const std::string& path,
                                  std::size_t count, SuiteRun& run) {
  for (const std::string& line : journal.lines()) {
    auto row = eval::suite_row_from(line, run.methods.size());
    if (!row.has_value() || row.value().number != run.rows.size()) {
      return Error{Error::Code::malformed,
                   fmt::format("{}: line {}: {}", path, run.rows.size() + 2,
                               row.has_value() ? "another encounter's" : row.error().message)};
    }
    run.rows.push_back(std::move(row).value());
  }
  run.rows.resize(std::min(run.rows.size(), count));
  return std::nullopt;
}

/// Whether all rows are there.
enum class Played { all, interrupted };

/// The next rows, at once.
std::vector<SuiteRow> next_rows(Play& play, std::size_t first, std::size_t num, int threads) {
  std::vector<SuiteRow> next(num);
  in_parallel(num, threads, [&](std::size_t i) { next[i] = row_of(play, first + i); });
  return next;
}

/// Plays the rows that are missing and puts each into the journal.
/// @param path  of the journal, for messages
Result<Played> play_rest(Play& play, const SuiteRequest& request, const Journal& journal,
                         const std::string& path, long_work::ProgressLine& progress,
                         SuiteRun& run) {
  const auto count = static_cast<std::size_t>(play.bench.source.count);
  const auto before = static_cast<int>(run.rows.size());
  const SuiteThinking& thinking = *play.bench.thinking;
  const std::size_t at_once =
      static_cast<std::size_t>(request.threads) * (thinking.has_model() ? 1 : batch_per_thread);
  while (run.rows.size() < count) {
    if (long_work::interrupted()) {
      return Played::interrupted;
    }
    const std::size_t first = run.rows.size();
    std::vector<SuiteRow> next =
        next_rows(play, first, std::min(at_once, count - first), request.threads);
    if (thinking.has_model() && long_work::interrupted()) {  // questions may have been withdrawn
      return Played::interrupted;
    }
    if (const auto failure = thinking.failure()) {
      return Error{failure->code,
                   fmt::format("{} (in encounters {} to {}; the same command goes on there)",
                               failure->message, first, first + next.size() - 1)};
    }
    for (SuiteRow& row : next) {
      if (!journal.add(eval::line_of(row))) {
        return Error{Error::Code::unwritable, path + ": cannot be added to"};
      }
      run.rows.push_back(std::move(row));
    }
    progress.show(static_cast<int>(run.rows.size()), before, " encounters");
  }
  return Played::all;
}

std::string command_of(const SuiteRequest& request, const std::vector<std::string>& methods,
                       const std::string& command) {
  return fmt::format("saca {} {} --methods {} --count {} --split {} --car {} --seed {}{}{}",
                     command, request.name, joined(methods), request.count, request.split,
                     request.car, request.seed, request.exact ? " --exact" : "",
                     thinking_text(request.thinking) + thresholds_arguments(request.thresholds) +
                         (request.danger.empty() ? "" : " --danger " + request.danger) +
                         (request.no_twins ? " --no-twins" : "") +
                         (request.data.empty() ? "" : " --data FOLDER"));
}

nlohmann::json meta_of(const SuiteRequest& request, const std::vector<std::string>& methods,
                       const SuiteCaller& caller, const SuiteBench& bench) {
  nlohmann::json meta{{"meta.command", command_of(request, methods, caller.command)},
                      {"meta.seed", std::to_string(request.seed)},
                      {"meta.n", std::to_string(bench.source.count)},
                      {"meta.split", request.split},
                      {"meta.car", request.car},
                      {"meta.version", caller.version},
                      {"meta.built_from", caller.built_from}};
  if (const auto& memory = bench.thinking->memory_text()) {
    meta["meta.memory"] = *memory;
  }
  if (const auto model = bench.thinking->model_text()) {
    meta["meta.model"] = *model;
  }
  if (const auto model = untuned_text(*bench.thinking)) {
    meta["meta.untuned"] = *model;
  }
  return meta;
}

}  // namespace

eval::SuiteOptions how_of(const SuiteRequest& request, const std::vector<std::string>& methods) {
  return {
      .methods = methods, .seed = request.seed, .exact = request.exact || request.name == "100car"};
}

Result<std::optional<SuiteRun>> play_suite(SuiteBench bench, const SuiteRequest& request,
                                           const std::vector<std::string>& methods,
                                           const SuiteCaller& caller) {
  const std::shared_ptr<Play> play = play_of(std::move(bench), request, methods);
  const EncounterSource& source = play->bench.source;
  const std::string path = request.journal.empty() ? request.output + ".journal" : request.journal;
  if (auto problem = long_work::make_folder_of(path)) {
    return *problem;
  }
  const auto journal = Journal::open(path, fmt::format("saca {} {} of {}", caller.built_from,
                                                       caller.command, work_of(*play, request)));
  if (!journal.has_value()) {
    return journal.error();
  }
  SuiteRun run{.methods = methods,
               .rows = {},
               .meta = {},
               .notes = source.notes,
               .encounter_at = source.at,
               .tried_in = {}};
  run.tried_in = [play](const SuiteEncounter& encounter) {
    return eval::tried_in(encounter, play->how, *play->bench.setup, *play->bench.intent);
  };
  const auto count = static_cast<std::size_t>(source.count);
  if (auto problem = take_up_rows(journal.value(), path, count, run)) {
    return *problem;
  }
  const auto before = static_cast<int>(run.rows.size());
  SteadyClock clock;
  long_work::watch_for_interrupt();
  long_work::ProgressLine progress(caller.command, source.count, clock, caller.display);
  const Clock::Time start = clock.now();
  const auto played = play_rest(*play, request, journal.value(), path, progress, run);
  if (!played.has_value()) {
    return played.error();
  }
  if (played.value() == Played::interrupted) {
    return std::optional<SuiteRun>();
  }
  run.worked = source.count - before;
  run.seconds = to_seconds(clock.now() - start);
  run.meta = meta_of(request, methods, caller, play->bench);
  return std::optional(std::move(run));
}

Result<EncounterReplay> replay_of(const EncounterSource& source, const SuiteRequest& request,
                                  std::uint64_t number) {
  const auto encounter = source.at(number);
  if (!encounter.has_value()) {
    return encounter.error();
  }
  const eval::SuiteOptions how = how_of(request, {});
  const ThinkingOptions& thinking = request.thinking;
  const fs::path file =
      fs::path("runs") / fmt::format("{}-{}-{}.toml", fs::path(request.name).filename().string(),
                                     request.split, number);
  return EncounterReplay{
      .file = file.string(),
      .text = scenario::write_scenario(eval::as_played(encounter.value().scenario, how)),
      .command = fmt::format(
          "saca run {} --pace lockstep --llm {}{}{}", file.string(), thinking.model,
          (thinking.model == "off" ? "" : " --danger off") +
              (thinking.memory.empty() ? " --no-memory"
                                       : " --no-learning --memory " + thinking.memory),
          how.exact ? std::string()
                    : fmt::format(" --seed {}", eval::encounter_seed(request.seed, number)))};
}

}  // namespace saca::suites
