#include "apps/saca/options.h"
#include "saca/base/core/clock.h"
#include "saca/lab/banks/bank_changes.h"
#include "saca/lab/banks/bank_check.h"
#include "saca/lab/banks/bank_contents.h"
#include "saca/lab/banks/bank_files.h"
#include "saca/lab/banks/bank_statistics.h"
#include "saca/lab/banks/case_neighbours.h"
#include "saca/lab/banks/case_page.h"
#include "saca/lab/banks/case_picture.h"
#include "saca/lab/banks/recall_calibration.h"
#include "saca/lab/banks/recall_chart.h"
#include "saca/lab/banks/scale_calibration.h"
#include "saca/lab/banks/suite_cases.h"
#include "saca/lab/eval/decision_point.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/progress.h"
#include "saca/thinking/memory/case_json.h"
#include "saca/thinking/memory/store.h"

namespace saca::app {
namespace {

/// Of all that is done with one bank.
struct BankOptions {
  std::string file = "runs/memory.sqlite";
  std::int64_t id = 0;
  std::string cases;  ///< JSON Lines
  std::string svg;
  std::string html;
  std::size_t most = 0;
  bool keep_trust = false;
  std::string car = "compact_rwd_ev";
  std::size_t draws = 64;
  int threads = usual_threads();
  bool quarantined = false;  ///< is checked, too
  std::string scenario;      ///< of what an expert adds, as the next three
  std::string why;
  std::optional<manoeuvre::PolicyId> policy;
  std::optional<double> at;
  bool as_json = false;
};

void list_cases(const BankOptions& options) {
  const auto bank = need(banks::read_bank(options.file));
  tell(options.as_json, banks::list_json(bank.cases),
       banks::list_text(bank.cases, bank.store.name()));
}

void show_case(const BankOptions& options) {
  need_distinct({{"--svg", options.svg}, {"--html", options.html}}, {{"--memory", options.file}});
  memory::Store memory = need(memory::Store::open_existing(options.file));
  const auto found = need(memory.find(options.id));
  if (!found) {
    refuse(bad_input,
           fmt::format("{}: want an id of `saca memory list`, got {}", memory.name(), options.id));
  }
  if (!options.svg.empty() || !options.html.empty()) {
    const auto all = need(memory.all());
    const auto near = banks::nearest_cases(*found, all);
    if (!options.svg.empty()) {
      write(options.svg, banks::case_picture(*found, near));
    }
    if (!options.html.empty()) {
      write(options.html, banks::case_page(*found, near,
                                           fmt::format("saca memory show {} --memory {} --html {}",
                                                       found->id, memory.name(), options.html)));
    }
  }
  app::print("{}\n", memory::to_json(*found).dump(1));  // it comes back to the last bit
}

void export_bank(const BankOptions& options) {
  need_distinct({{"the file of cases", options.cases}}, {{"--memory", options.file}});
  const auto bank = need(banks::read_bank(options.file));
  write(options.cases, memory::cases_text(bank.cases));
  app::print("{}: {} cases\n", options.cases, bank.cases.size());
}

void import_into_bank(const BankOptions& options) {
  auto cases = need(banks::read_cases(options.cases));
  memory::Store memory = need(banks::open_to_add(options.file));
  const auto import = need(banks::import_cases(
      memory, std::move(cases),
      options.keep_trust ? banks::ImportedTrust::kept : banks::ImportedTrust::withdrawn));
  tell(options.as_json,
       nlohmann::json{{"schema", "saca.memory_import/1"},
                      {"file", import.bank},
                      {"taken", import.taken},
                      {"left_out", import.left_out}},
       text_of(import));
}

void thin_bank(const BankOptions& options) {
  banks::ReadBank bank = need(banks::read_bank(options.file));
  const auto thinning = need(banks::thin(bank, options.most));
  tell(options.as_json,
       nlohmann::json{{"schema", "saca.memory_thinning/1"},
                      {"file", thinning.bank},
                      {"forgotten", thinning.forgotten},
                      {"left", thinning.left}},
       text_of(thinning));
}

void verify_bank(const BankOptions& options) {
  const auto contents = need(banks::contents_of(need(banks::read_bank(options.file))));
  tell(options.as_json, json_of(contents), text_of(contents));
}

void tell_statistics(const BankOptions& options) {
  const auto statistics = need(banks::bank_statistics(options.file, SteadyClock()));
  tell(options.as_json, json_of(statistics), text_of(statistics));
}

void check_bank(const BankOptions& options) {
  banks::ReadBank bank = need(banks::read_bank(options.file));
  const auto planes = need(vehicle_study::open_planes(here(), options.car));
  long_work::watch_for_interrupt();
  const auto check =
      need(banks::check(bank, banks::case_tools(*planes, options.draws),
                        {.quarantined = options.quarantined ? banks::Quarantined::checked_too
                                                            : banks::Quarantined::left_alone,
                         .threads = options.threads,
                         .display = here().display}));
  tell(options.as_json, json_of(check, options.car), text_of(check));
  if (long_work::interrupted()) {
    refuse(was_interrupted, goes_on);
  }
}

void add_case(const BankOptions& options) {
  if (!is_utf8(options.why)) {
    refuse(bad_input, "--why: want UTF-8, got " + one_line(options.why));
  }
  const auto inputs = read_scenario_inputs(options.scenario);
  const double time = decision_time(inputs, options.at);
  const memory::Case one = banks::expert_case(eval::scene_at(inputs.scenario, inputs.car, time),
                                              {*options.policy, options.why, inputs.scenario.name});
  memory::Store memory = need(banks::open_to_add(options.file));
  const memory::LearningResult learnt = need(memory.learn(one));
  using How = memory::LearningResult::How;
  nlohmann::json document{{"schema", "saca.memory_addition/1"},
                          {"file", memory.name()},
                          {"id", learnt.id},
                          {"added", learnt.how != How::merged},
                          {"contradicts", nullptr}};
  if (learnt.how == How::contradicted) {
    document["contradicts"] = learnt.other;
  }
  tell(options.as_json, std::move(document), banks::text_of(learnt, memory.name()));
}

using SharedOptions = std::shared_ptr<BankOptions>;

/// A command that does something with one bank, which is an option.
CLI::App& add_of_bank(CLI::App& memory, const SharedOptions& shared, const char* name,
                      const char* about, void (*run)(const BankOptions&)) {
  CLI::App& one = add_command<BankOptions>(memory, name, about, run, shared).line;
  add(one, "--memory", shared->file, "The memory bank");
  return one;
}

void add_adding(CLI::App& memory, const SharedOptions& shared) {
  CLI::App& command = add_of_bank(
      memory, shared, "add", "Adds what somebody knows: this scenario wants that policy", add_case);
  add_scenario(command, shared->scenario);
  add_policy(command, shared->policy, "What is best there: a number, 0 to 7, or a name")
      ->required();
  add(command, "--why", shared->why, "The reason, in a line");
  add_at(command, shared->at);
  add_json(command, shared->as_json);
}

/// The commands of one bank; where it is may stand before them, too.
void add_bank_commands(CLI::App& memory) {
  const auto shared = std::make_shared<BankOptions>();
  const auto add_one = [&](const char* name, const char* about,
                           void (*run)(const BankOptions&)) -> CLI::App& {
    return add_of_bank(memory, shared, name, about, run);
  };
  add(memory, "--memory", shared->file, "The memory bank");
  add_json(add_one("list", "All cases", list_cases), shared->as_json);
  CLI::App& show = add_one("show", "One case, with its scene, as JSON", show_case);
  add_needed(show, "id", shared->id, "");
  add(show, "--svg", shared->svg, "It and those most like it as a picture, besides");
  add(show, "--html", shared->html, "Likewise as a page, with all that is known of it");
  CLI::App& import = add_one("import", "Takes over cases from JSON Lines", import_into_bank);
  add_needed(import, "cases", shared->cases, "What `export` or `build` wrote");
  import.add_flag("--keep-trust", shared->keep_trust,
                  "As they were trusted there: for one's own. Else each is used only where a "
                  "rollout confirms it");
  add_json(import, shared->as_json);
  add_needed(add_one("export", "Writes all cases as JSON Lines", export_bank), "cases",
             shared->cases, "The file");
  CLI::App& thin =
      add_one("thin", "Forgets cases for which others stand, the most redundant first", thin_bank);
  add_needed(thin, "--most", shared->most, "How many are to be left");
  add_json(thin, shared->as_json);
  add_json(add_one("verify", "Reads all of the bank, and counts what is in it", verify_bank),
           shared->as_json);
  add_json(
      add_one("stats",
              "What encounters the bank knows and which it lacks, and how long it takes to ask",
              tell_statistics),
      shared->as_json);
  CLI::App& check = add_one(
      "check", "Rolls out what is not trusted, with the car at hand: what holds is trusted then",
      check_bank);
  add_car(check, shared->car);
  add(check, "--draws", shared->draws, "That expected harm is the mean of", CLI::Range(1, 1'000));
  add_threads(check, shared->threads);
  check.add_flag("--quarantined", shared->quarantined,
                 "Also what is in quarantine: what holds over draws is served again");
  add_json(check, shared->as_json);
  add_adding(memory, shared);
}

struct BuildOptions : banks::SuiteCasesRequest {
  bool as_json = false;
};

ExitCode build_cases(const BuildOptions& options) {
  const suites::SuiteRequest& from = options.from;
  need_distinct({{"--output", from.output}}, {{"--journal", from.journal}});
  need_writable({from.output});
  long_work::watch_for_interrupt();
  const auto built = need_whole(banks::suite_cases(here(), options));
  complain_of(built.problems);
  write(from.output, memory::cases_text(built.cases));
  tell(options.as_json, json_of(built, command_text(options), SACA_VERSION),
       text_of(built, from.output));
  return built.problems.empty() ? success : some_failed;
}

void add_building(CLI::App& memory) {
  const auto [command, options] = add_command<BuildOptions>(
      memory, "build", "Makes cases of the encounters of a suite, as JSON Lines for `import`",
      build_cases);
  suites::SuiteRequest& from = options.from;
  from.split = "tuning";
  from.output = "runs/cases.jsonl";
  add_encounter_options(command, from);
  add(command, "--draws", options.draws, "That expected harm is the mean of", CLI::Range(1, 1'000));
  command.add_flag("--no-twins", options.no_twins,
                   "Without those without risk: a memory of accidents alone expects them");
  add(command, "--output,-o", from.output, "Where the cases go");
  add(command, "--journal", from.journal, "What was found so far (default: beside the output)");
  add_threads(command, from.threads);
  add_json(command, options.as_json);
}

struct CalibrateOptions {
  std::string cases;
  std::vector<std::string> checks;
  std::string svg;
  bool fit = false;
  int fit_scenes = 2'000;
  std::uint64_t seed = 1;
  int threads = usual_threads();
  bool as_json = false;
};

/// Fits what makes a difference, and holds it against other cases.
void fit_scales(const CalibrateOptions& options, const banks::CalibrationCases& cases) {
  long_work::watch_for_interrupt();
  SteadyClock clock;
  long_work::ProgressLine progress("scales", 0, clock, progress_display());
  const auto scales = need(banks::calibrate_scales(
      cases, {.scenes = options.fit_scenes, .threads = options.threads}, progress));
  tell(options.as_json, json_of(scales, SACA_VERSION), text_of(scales));
  if (!scales.fit.is_done) {
    refuse(was_interrupted, "interrupted: the scales are the best so far");
  }
}

void calibrate(const CalibrateOptions& options) {
  need_distinct({{"--svg", options.svg}}, {{"the cases", options.cases}});
  need_writable({options.svg});
  const auto cases = need(banks::read_calibration_cases(options.cases, options.checks));
  if (options.fit) {
    fit_scales(options, cases);
    return;
  }
  const auto recalls = banks::calibrate_recalls(cases, options.seed, options.threads);
  tell_meanwhile(options.as_json, text_of(recalls));
  if (!options.svg.empty()) {
    write(options.svg, banks::recall_chart(recalls));
  }
  tell(options.as_json, json_of(recalls, SACA_VERSION), "");
}

void add_calibrating(CLI::App& memory) {
  const auto [command, options] = add_command<CalibrateOptions>(
      memory, "calibrate",
      "How often what cases speak for is as good as the best, by its confidence", calibrate);
  add_needed(command, "cases", options.cases, "What `build` or `export` wrote");
  add(command, "--check", options.checks, "Other cases, that are held against them");
  add(command, "--svg", options.svg, "The curve as a picture, of --check where it is given");
  command.add_flag("--fit", options.fit,
                   "Fits the scales of what makes a difference between scenes instead");
  add(command, "--fit-scenes", options.fit_scenes, "How many are predicted in each try",
      CLI::Range(10, 1'000'000));
  add(command, "--seed", options.seed, "Of what is drawn");
  add_threads(command, options.threads);
  add_json(command, options.as_json);
}

}  // namespace

void add_memory(CLI::App& line) {
  CLI::App& memory = add_group(line, "memory", "What was learnt");
  add_bank_commands(memory);
  add_building(memory);
  add_calibrating(memory);
}

}  // namespace saca::app
