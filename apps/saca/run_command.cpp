#include <unistd.h>

#include <csignal>

#include "apps/saca/options.h"
#include "saca/lab/installation/shipped_files.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/runs/look_back.h"
#include "saca/lab/runs/run_means.h"
#include "saca/lab/runs/story.h"
#include "saca/lab/shell/invocation.h"

namespace saca::app {
namespace {

struct RunOptions {
  runs::RunRequest run;
  bool no_memory = false;
  bool review = false;
  bool as_json = false;
};

/// CLI11's convention: what is wrong with the name of a trace, or nothing.
std::string wrong_trace_name(const std::string& name) {
  const std::string extension = fs::path(name).extension();
  return extension == ".jsonl" || extension == ".csv"
             ? std::string()
             : "want a file that ends in .jsonl or .csv, got `" + name + "`";
}

/// That a review can be made, and that nothing which the run leaves would be written over something
/// that it needs or leaves as well.
void need_possible(const RunOptions& options) {
  const runs::RunRequest& request = options.run;
  if (options.review && request.model == "off") {
    refuse(wrong_command_line, "--review: want a language model that looks back, got --llm off");
  }
  constexpr std::string_view replay = "replay:";
  const bool is_replay = request.model.starts_with(replay);
  const std::string scenario = read_scenario_inputs(request.scenario).scenario.name;
  const runs::RunFiles files = runs::files_of(request, scenario);
  need_distinct({{"the record", files.record},
                 {request.report.empty() ? "the report" : "--report", files.report},
                 {"--trace", files.trace},
                 {"--tape", files.tape},
                 {"--record-replies", request.record_replies}},
                {{"the scenario", need(installation::find_scenario(here(), request.scenario))},
                 {"--memory", options.no_memory ? "" : request.memory},
                 {"--llm", is_replay ? request.model.substr(replay.size()) : ""},
                 {"--atlas", request.atlas}});
}

void run(const RunOptions& options) {
  need_possible(options);
  runs::RunRequest request = options.run;
  request.command = shell::invocation();
  request.date = shell::now_in_utc();
  if (options.no_memory) {
    request.memory.clear();
  }
  SteadyClock clock;
  const auto means = need(runs::open_means(here(), request, clock));
  const encounter::Setup setup = runs::setup_of(*means, request, clock);
  std::signal(SIGPIPE, [](int) {});  // nobody need listen for the encounter to be played
  const bool silent = options.as_json || settings().quiet;
  runs::Story story(silent ? std::nullopt : std::optional(STDOUT_FILENO),
                    shell::wants_colours(STDOUT_FILENO));
  story.headline(*setup.scenario, setup);
  encounter::Record record = need(encounter::run(setup, story));
  std::string text = encounter::record_json(setup, record, &means->provenance);
  story.ending(*setup.scenario, record, runs::in_short(text));
  // What was played is written down even if nobody wants to wait for the review.
  long_work::watch_for_interrupt();
  if (options.review && setup.model == nullptr) {
    complain("no review: there is no language model that could look back");
  } else if (options.review) {
    if (const auto problem = runs::look_back_until_interrupted(setup, record, story)) {
      complain("no review: " + problem->message);
    }
    text = encounter::record_json(setup, record, &means->provenance);
  }
  const runs::RunFiles files = runs::files_of(request, setup.scenario->name);
  auto problem = runs::write_run(
      files, {.setup = setup, .record = record, .record_text = text, .program = SACA_VERSION});
  if (!problem) {
    problem = means->model.save_replies();
  }
  if (options.as_json) {
    app::print("{}\n", text);
  } else if (!problem) {
    story.on_report(fs::absolute(files.report).string());
  }
  if (!problem) {
    problem = record.not_stored ? record.not_stored : story.problem();
  }
  if (problem) {
    refuse(cannot_write, problem->message);
  }
}

/// What SACA thinks with, and what is done whatever it thought.
void add_means(CLI::App& command, RunOptions& options) {
  runs::RunRequest& request = options.run;
  add_thinking_options(command, request.memory, request.model);
  add(command, "--record-replies", request.record_replies,
      "Write the model's replies to a file for --llm replay:FILE");
  add_policy(command, request.forced.policy,
             "Carry out this policy (0-7, or its name) at the trigger, whatever was thought");
  add_target_speed(command, request.forced.target_speed);
  add_strength(command, request.forced.strength, "");
  add(command, "--seed", request.seed,
      "Draw what is left to chance (default: as the scenario is written)");
  add(command, "--atlas", request.atlas,
      "A file of `saca atlas build` for this car, or off: every forecast is rolled out (default: "
      "it is built when needed)");
  add(command, "--danger", request.danger,
      "tables: risks by solved tables, made when needed, seconds each; off: by a few evasions "
      "(default: by what was learnt of the car, if anything)",
      one_of({"tables", "off"}));
  command.add_flag("--no-memory", options.no_memory, "As without --memory")->group("");
  command.add_flag("--empty-memory", request.empty_memory,
                   "A memory that is not there yet begins without the shipped cases");
  command.add_flag("--review", options.review,
                   "Have the language model look back when all is over, and try again where its "
                   "reasons did not hold: half a minute or more");
  command.add_flag("--no-learning", request.no_learning,
                   "Ask the memory, but do not add to it what happens");
}

/// Where what comes of a run goes.
void add_files(CLI::App& command, runs::RunRequest& request) {
  add(command, "--output", request.output, "Folder for records and reports");
  add(command, "--report", request.report, "Where the HTML report goes");
  add(command, "--trace", request.trace,
      "Where the motions go, frame by frame: FILE.jsonl or FILE.csv")
      ->check(wrong_trace_name);
  add(command, "--tape", request.tape,
      "Where everything goes that was decided by, step by step, for `saca replay`");
}

}  // namespace

void add_run(CLI::App& line) {
  const auto [command, options] =
      add_command<RunOptions>(line, "run", "Play one emergency and report on it", run);
  add_scenario(command, options.run.scenario);
  add(command, "--pace", options.run.pace,
      "real: the world goes on while SACA thinks; lockstep: fast and repeatable",
      one_of({"real", "lockstep"}));
  add(command, "--trigger", options.run.trigger,
      "value: SACA acts at T1, or before where waiting is expected to cost harm; t1: never before",
      one_of({"value", "t1"}));
  add_means(command, options);
  add_files(command, options.run);
  add_json(command, options.as_json, "Print the record, for programs");
}

}  // namespace saca::app
