#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "apps/saca/atlas_making.h"
#include "apps/saca/commands.h"
#include "apps/saca/danger_making.h"
#include "apps/saca/inputs.h"
#include "apps/saca/invocation.h"
#include "apps/saca/model.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "apps/saca/thinking_options.h"
#include "apps/saca/version.h"
#include "apps/saca/within.h"
#include "saca/lab/banks/bank_files.h"
#include "saca/lab/encounter/encounter.h"
#include "saca/lab/encounter/learnt_case.h"
#include "saca/lab/encounter/provenance.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/runs/bank.h"
#include "saca/lab/runs/forced_plan.h"
#include "saca/lab/runs/look_back.h"
#include "saca/lab/runs/run_files.h"
#include "saca/lab/runs/story.h"
#include "saca/onboard/atlas/atlas_file.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;

struct RunOptions {
  std::string scenario;
  std::string pace = "real";
  std::string trigger = "value";
  ThinkingOptions thinking{.model = "local"};
  std::string record_replies;
  runs::ForcedPolicy forced;
  std::optional<std::uint64_t> seed;
  std::string atlas;
  std::string danger;
  bool no_memory = false;
  bool empty_memory = false;
  bool no_learning = false;
  bool review = false;
  std::string output = "runs";
  std::string report;
  std::string trace;
  std::string tape;
  bool as_json = false;
};

reflex::Thresholds thresholds_of(const RunOptions& options) {
  reflex::Thresholds thresholds;
  if (options.trigger == "t1") {
    thresholds.waiting_cost.reset();
  }
  return thresholds;
}

/// nullopt: none is wanted.
Result<std::optional<atlas::Atlas>> open_atlas(const RunOptions& options,
                                               const ScenarioInputs& inputs) {
  if (options.atlas == "off") {
    return std::optional<atlas::Atlas>();
  }
  if (options.atlas.empty()) {
    return std::optional(usual_atlas(inputs));
  }
  const auto atlas = atlas::read_atlas(options.atlas, inputs.car);
  return atlas.has_value() ? Result<std::optional<atlas::Atlas>>(std::optional(atlas.value()))
                           : atlas.error();
}

/// nullopt: V_h is told by a few evasions.
Result<std::optional<danger::DangerModel>> open_danger(const RunOptions& options,
                                                       const ScenarioInputs& inputs) {
  return options.danger == "off" ? Result(std::optional<danger::DangerModel>())
                                 : usual_danger(inputs, options.danger == "tables");
}

/// nullptr: none is wanted.
Result<std::shared_ptr<memory::Store>> open_memory(const RunOptions& options,
                                                   const ScenarioInputs& inputs) {
  if (options.thinking.memory.empty() || options.no_memory) {
    return std::shared_ptr<memory::Store>();
  }
  return runs::open_bank(
      {.place = options.thinking.memory,
       .use = options.no_learning    ? runs::BankUse::ask
              : options.empty_memory ? runs::BankUse::learn_from_empty
                                     : runs::BankUse::learn,
       .car = encounter::made_with({&inputs.car, &inputs.harm}, inputs.intent, inputs.scenario.car),
       .shipped = [&inputs] { return banks::shipped_cases(inputs.places.root); }});
}

/// Of a record that this command makes now.
Result<encounter::Provenance> provenance_of(const ScenarioInputs& inputs,
                                            const std::string& scenario) {
  const auto digest = scenario_digest(inputs.places, scenario);
  if (!digest.has_value()) {
    return digest.error();
  }
  return encounter::Provenance{.program = "saca " SACA_VERSION,
                               .commit = built_from(),
                               .date = now_in_utc(),
                               .command = invocation(),
                               .file = scenario,
                               .digest = digest.value()};
}

/// CLI11's convention: what is wrong with the name of a trace, or nothing.
std::string wrong_trace_name(const std::string& name) {
  const std::string extension = fs::path(name).extension();
  return extension == ".jsonl" || extension == ".csv"
             ? std::string()
             : "want a file that ends in .jsonl or .csv, got `" + name + "`";
}

/// All that a run is made with.
struct Means {
  ScenarioInputs inputs;
  encounter::Provenance provenance;
  runtime::ThinkingCosts costs;
  std::optional<atlas::Atlas> atlas;
  std::optional<danger::DangerModel> danger;
  std::shared_ptr<memory::Store> memory;
  model_access::ChosenModel model;
  std::optional<manoeuvre::Plan> forced;
};

runs::RunFiles files_of(const RunOptions& options, const std::string& scenario) {
  const fs::path folder = fs::path(options.output) / scenario;
  return {.record = folder / "record.json",
          .report = options.report.empty() ? folder / "report.html" : fs::path(options.report),
          .trace = options.trace,
          .tape = options.tape};
}

/// Before anything is played.
std::optional<Error> why_unwritable(const RunOptions& options, const std::string& scenario) {
  const runs::RunFiles files = files_of(options, scenario);
  return long_work::why_outputs_unwritable(
      {files.record, options.report, options.trace, options.tape, options.record_replies});
}

runtime::Pace pace_of(const RunOptions& options) {
  return options.pace == "real" ? runtime::Pace::real : runtime::Pace::lockstep;
}

/// @param clock  outlives them
Result<std::unique_ptr<Means>> open_means(const RunOptions& options, Clock& clock) {
  auto inputs = read_scenario_inputs(options.scenario);
  if (!inputs.has_value()) {
    return inputs.error();
  }
  if (const auto problem = why_unwritable(options, inputs.value().scenario.name)) {
    return *problem;
  }
  auto provenance = provenance_of(inputs.value(), options.scenario);
  if (!provenance.has_value()) {
    return provenance.error();
  }
  const auto costs = read_costs(inputs.value().places);
  if (!costs.has_value()) {
    return costs.error();
  }
  auto atlas = open_atlas(options, inputs.value());
  if (!atlas.has_value()) {
    return Error{atlas.error().code, atlas.error().message + " (--atlas off does without)"};
  }
  auto danger = open_danger(options, inputs.value());
  if (!danger.has_value()) {
    return danger.error();
  }
  auto memory = open_memory(options, inputs.value());
  if (!memory.has_value()) {
    return memory.error();
  }
  auto model = open_chosen_model(inputs.value().places, options.thinking.model,
                                 options.record_replies, pace_of(options), clock);
  if (!model.has_value()) {
    return model.error();
  }
  const auto forced = runs::forced_plan(options.forced);
  if (!forced.has_value()) {
    return forced.error();
  }
  return std::make_unique<Means>(Means{std::move(inputs).value(), std::move(provenance).value(),
                                       costs.value(), std::move(atlas).value(),
                                       std::move(danger).value(), std::move(memory).value(),
                                       std::move(model).value(), forced.value()});
}

encounter::Setup setup_of(const Means& means, const RunOptions& options, Clock& clock) {
  return {.scenario = &means.inputs.scenario,
          .car = &means.inputs.car,
          .harm = &means.inputs.harm,
          .intent = &means.inputs.intent,
          .atlas = means.atlas ? &*means.atlas : nullptr,
          .danger = means.danger ? &*means.danger : nullptr,
          .cues = &means.inputs.cues,
          .thresholds = thresholds_of(options),
          .pace = pace_of(options),
          .costs = means.costs,
          .model = means.model.get(),
          .memory = means.memory.get(),
          .learns = !options.no_learning,
          .forced = means.forced,
          .seed = options.seed,
          .tapes = !options.tape.empty(),
          .clock = &clock};
}

/// Has the model look back until it is interrupted.
void look_back_until_interrupted(const encounter::Setup& setup, encounter::Record& record,
                                 runs::Story& story) {
  const long_work::InterruptStop interrupt;
  if (const auto problem = runs::look_back(setup, record, story, interrupt.token())) {
    complain("no review: " + problem->message);
  }
}

int run(const RunOptions& options) {
  SteadyClock clock;
  const auto opened = open_means(options, clock);
  if (!opened.has_value()) {
    return refused(opened.error());
  }
  const Means& means = *opened.value();
  const encounter::Setup setup = setup_of(means, options, clock);
  std::signal(SIGPIPE, [](int) {});  // nobody need listen for the encounter to be played
  const bool silent = options.as_json || settings().quiet;
  runs::Story story(silent ? std::nullopt : std::optional(STDOUT_FILENO),
                    wants_colours(STDOUT_FILENO));
  story.headline(means.inputs.scenario, setup);
  auto played = encounter::run(setup, story);
  if (!played.has_value()) {
    return refused(played.error());
  }
  encounter::Record record = std::move(played).value();
  std::string text = encounter::record_json(setup, record, &means.provenance);
  story.ending(means.inputs.scenario, record, runs::in_short(text));
  // What was played is written down even if nobody wants to wait for the review.
  long_work::watch_for_interrupt();
  if (options.review) {
    look_back_until_interrupted(setup, record, story);
    text = encounter::record_json(setup, record, &means.provenance);
  }
  const runs::RunFiles files = files_of(options, means.inputs.scenario.name);
  auto problem = runs::write_run(
      files, {.setup = setup, .record = record, .record_text = text, .program = SACA_VERSION});
  if (!problem) {
    problem = means.model.save_replies();
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
    complain(problem->message);
    return cannot_write;
  }
  return success;
}

/// The options that say where what comes of a run goes.
void add_files(CLI::App& command, RunOptions& options) {
  command.add_option("--output", options.output, "Folder for records and reports")
      ->capture_default_str();
  command.add_option("--report", options.report, "Where the HTML report goes");
  command
      .add_option("--trace", options.trace,
                  "Where the motions go, frame by frame: FILE.jsonl or FILE.csv")
      ->check(wrong_trace_name);
  command.add_option("--tape", options.tape,
                     "Where everything goes that was decided by, step by step, for `saca replay`");
}

}  // namespace

void add_run(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand("run", "Play one emergency and report on it");
  const auto options = std::make_shared<RunOptions>();
  command
      ->add_option("scenario", options->scenario, "A scenario file, or the name of a shipped one")
      ->required();
  command
      ->add_option("--pace", options->pace,
                   "real: the world goes on while SACA thinks; lockstep: fast and repeatable")
      ->check(one_of({"real", "lockstep"}))
      ->capture_default_str();
  command
      ->add_option("--trigger", options->trigger,
                   "value: SACA acts at T1, or before where waiting is expected to cost harm; t1: "
                   "never before")
      ->check(one_of({"value", "t1"}))
      ->capture_default_str();
  add_thinking_options(*command, options->thinking);
  command->add_option("--record-replies", options->record_replies,
                      "Write the model's replies to a file for --llm replay:FILE");
  add_policy(*command, options->forced.policy,
             "Carry out this policy (0-7, or its name) at the trigger, whatever was thought");
  add_target_speed(*command, options->forced.target_speed);
  command
      ->add_option("--strength", options->forced.strength,
                   "Of policy 0: share of the grip that the brakes are asked for (default: all)")
      ->check(within(manoeuvre::least_strength, 1.0, "-"));
  command->add_option("--seed", options->seed,
                      "Draw what is left to chance (default: as the scenario is written)");
  command->add_option("--atlas", options->atlas,
                      "A file of `saca atlas build` for this car, or off: every forecast is rolled "
                      "out (default: it is built when needed)");
  command
      ->add_option("--danger", options->danger,
                   "tables: risks by solved tables, made when needed, seconds each; off: by a few "
                   "evasions (default: by what was learnt of the car, if anything)")
      ->check(one_of({"tables", "off"}));
  command->add_flag("--no-memory", options->no_memory, "As without --memory")->group("");
  command->add_flag("--empty-memory", options->empty_memory,
                    "A memory that is not there yet begins without the shipped cases");
  command->add_flag(
      "--review", options->review,
      "Have the language model look back when all is over, and try again where its reasons did "
      "not hold: half a minute or more");
  command->add_flag("--no-learning", options->no_learning,
                    "Ask the memory, but do not add to it what happens");
  add_files(*command, *options);
  command->add_flag("--json", options->as_json, "Print the record, for programs");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace saca::app
