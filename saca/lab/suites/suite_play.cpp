#include "saca/lab/suites/suite_play.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "saca/base/core/clock.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/resumable_work.h"
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

/// What stood in the journal.
struct TakenUp {
  std::size_t rows = 0;
  Clock::Time at{0};  ///< when the last of them was read, or the first row was begun
};

long_work::ResumableWork<SuiteRow> work_on(Play& play, const SuiteRequest& request,
                                           const SuiteCaller& caller, Clock& clock,
                                           TakenUp& taken) {
  const SuiteThinking& thinking = *play.bench.thinking;
  const std::size_t at_once =
      static_cast<std::size_t>(request.threads) * (thinking.has_model() ? 1 : batch_per_thread);
  return {.journal = request.journal.empty() ? request.output + ".journal" : request.journal,
          .title = fmt::format("saca {} {} of {}", caller.built_from, caller.command,
                               work_of(play, request)),
          .progress = caller.command,
          .unit = "encounters",
          .count = static_cast<std::size_t>(play.bench.source.count),
          .display = caller.display,
          .threads = request.threads,
          .at_once = at_once,
          .row = [&play](std::size_t number) { return row_of(play, number); },
          .line_of = [](const SuiteRow& row) { return eval::line_of(row); },
          .row_from = [&clock, &taken, num_methods = play.how.methods.size()](
                          const std::string& line) -> Result<SuiteRow> {
            auto row = eval::suite_row_from(line, num_methods);
            if (row.has_value() && row.value().number != taken.rows) {
              return Error{Error::Code::malformed, "another encounter's"};
            }
            ++taken.rows;
            taken.at = clock.now();
            return row;
          },
          .spoilt_by_interrupt = thinking.has_model(),  // questions may have been withdrawn
          .failure = [&thinking, &taken, at_once,
                      count = static_cast<std::size_t>(play.bench.source.count),
                      played = std::size_t{0}]() mutable -> std::optional<Error> {
            const std::size_t first = taken.rows + played;
            auto failure = thinking.failure();
            if (failure) {
              failure->message +=
                  fmt::format(" (in encounters {} to {}; the same command goes on there)", first,
                              std::min(first + at_once, count) - 1);
            }
            played += at_once;
            return failure;
          }};
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
  long_work::watch_for_interrupt();
  SteadyClock clock;
  TakenUp taken{.at = clock.now()};
  auto rows = long_work::rows_of(work_on(*play, request, caller, clock, taken));
  if (!rows.has_value()) {
    return rows.error();
  }
  if (!rows.value()) {
    return std::optional<SuiteRun>();
  }
  SuiteRun run{.methods = methods,
               .rows = *std::move(rows).value(),
               .seconds = to_seconds(clock.now() - taken.at),
               .worked = source.count - static_cast<int>(taken.rows),
               .meta = {},
               .notes = source.notes,
               .encounter_at = source.at,
               .tried_in = {}};
  run.tried_in = [play](const SuiteEncounter& encounter) {
    return eval::tried_in(encounter, play->how, *play->bench.setup, *play->bench.intent);
  };
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
