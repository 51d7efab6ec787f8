#include "apps/saca/options.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "saca/base/core/suggestion.h"
#include "saca/lab/eval/decision_point.h"

namespace saca::app {

CLI::Option* add_json(CLI::App& command, bool& as_json, const std::string& about) {
  return command.add_flag("--json", as_json, about);
}

void add_car(CLI::App& command, std::string& car) {
  add(command, "--car", car, "A car's file, or the name of a shipped one");
}

void add_scenario(CLI::App& command, std::string& scenario) {
  add_needed(command, "scenario", scenario, "A scenario file, or the name of a shipped one");
}

void add_split(CLI::App& command, std::string& split, std::string& test_log) {
  add(command, "--split", split, "Whose seed is used", one_of({"tuning", "calibration", "test"}));
  add(command, "--test-log", test_log, "Where a use of the test split is noted; needed for it");
}

void add_threads(CLI::App& command, int& threads, const std::string& what) {
  add(command, "--threads", threads, what, CLI::Range(1, 256));
}

CLI::Option* add_policy(CLI::App& command, std::optional<manoeuvre::PolicyId>& policy,
                        const std::string& what) {
  std::vector<std::string> names;
  names.reserve(manoeuvre::num_policies);
  for (const manoeuvre::PolicyId one : manoeuvre::all_policies) {
    names.emplace_back(name(one));
  }
  const auto take = [&policy, names](const std::string& text) {
    policy = manoeuvre::policy_named(text);
    if (!policy) {
      throw CLI::ValidationError(
          "--policy", fmt::format("want a policy's number, 0 to 7, or its name, got '{}'; {}", text,
                                  suggestion(text, names)));
    }
  };
  return command.add_option_function<std::string>("--policy", take, what)
      ->type_name(fmt::format("POLICY:{{{}}}", fmt::join(names, ",")));
}

void add_target_speed(CLI::App& command, std::optional<double>& speed) {
  add(command, "--target-speed", speed, "Of policies 3 and 4 [m/s] (default: half the speed)",
      within(0.0, 100.0, "m/s"));
}

void add_strength(CLI::App& command, std::optional<double>& strength, const std::string& share) {
  add(command, "--strength", strength,
      "Of policy 0: share of the grip that the brakes are asked for" + share + " (default: all)",
      within(manoeuvre::least_strength, 1.0, "-"));
}

void add_at(CLI::App& command, std::optional<double>& at) {
  add(command, "--at-s", at, "When they begin (default: at the trigger)", within(0.0, 600.0, "s"));
}

double decision_time(const installation::ScenarioInputs& inputs, const std::optional<double>& at) {
  const scenario::Scenario& scenario = inputs.scenario;
  if (at) {
    if (*at > scenario.duration) {
      refuse(bad_input,
             fmt::format("--at-s {}: {} ends at {} s", *at, scenario.name, scenario.duration));
    }
    return *at;
  }
  const auto trigger = eval::trigger_time(scenario, inputs.car);
  if (!trigger) {
    refuse(nothing_to_decide, scenario.name +
                                  ": nothing comes within T1 of a conflict, so nothing is to be "
                                  "decided; say when with --at-s");
  }
  return *trigger;
}

namespace {

/// --count, --split, --test-log and --car: which encounters are drawn, and for which car.
template <class Draw>
void add_draw_options(CLI::App& command, Draw& draw) {
  add(command, "--count", draw.count, "How many encounters", CLI::Range(1, 10'000'000));
  add_split(command, draw.split, draw.test_log);
  add_car(command, draw.car);
}

/// --t1-s and --waiting-cost: when it is acted, for studies of what these numbers are worth.
void add_thresholds_options(CLI::App& command, reflex::Thresholds& thresholds) {
  constexpr reflex::Thresholds shipped;
  command
      .add_option("--t1-s", thresholds.trigger,
                  "T1: everybody who acts at the trigger acts when a conflict is so near [s]")
      ->default_val(shipped.trigger)
      ->check(within(0.1, shipped.preview, "s"));
  command
      .add_option_function<double>(
          "--waiting-cost", [&thresholds](double cost) { thresholds.waiting_cost = cost; },
          fmt::format("Of SACA: before T1, it acts as soon as waiting is expected to cost more "
                      "harm than this (default: {})",
                      *shipped.waiting_cost))
      ->check(within(0.0, 1.0));
}

/// A folder's name as the shell completes it, without the slash at its end.
CLI::Option* without_slash(CLI::Option* option) {
  return option->transform([](std::string name) {
    while (name.size() > 1 && name.back() == '/') {
      name.pop_back();
    }
    return name;
  });
}

/// The end of the words on `--llm`.
constexpr const char* other_models =
    "replay:FILE: recorded replies; MODEL@URL: a server with /v1/chat/completions, key in "
    "SACA_LLM_KEY";

}  // namespace

void add_survey_options(CLI::App& command, installation::SurveyRequest& request) {
  add(command, "--suite", request.suite, "Which mixture of families");
  add_draw_options(command, request.draw);
  add(command, "--journal", request.journal,
      "What was found so far (default: runs/survey-SUITE-SPLIT.journal)");
  add_threads(command, request.threads);
}

void add_encounter_options(CLI::App& command, suites::SuiteRequest& from) {
  without_slash(add_needed(command, "name", from.name,
                           "A suite (natural, balanced), a family, a folder of scenarios, or "
                           "100car"));
  add(command, "--data", from.data, "Of 100car the folder of the study's release");
  add_draw_options(command, from);
  add(command, "--seed", from.seed, "Of all that is drawn: same seed, same figures");
  command.add_flag("--exact", from.exact,
                   "Nothing is left to chance, and perception is as the scenarios have it");
}

void add_thinking_options(CLI::App& command, std::string& memory, std::string& model) {
  add(command, "--llm", model,
      "local: the language model of `make model`; local:FILE: other weights, GGUF; off: none; " +
          std::string(other_models));
  add(command, "--memory", memory, "The memory bank");
}

void add_untuned_option(CLI::App& command, std::string& model) {
  add(command, "--untuned", model,
      "As --llm: a model without fine-tuning, for the methods ..._untuned");
}

void add_needed_model(CLI::App& command, std::string& model) {
  add(command, "--llm", model,
      "local: the language model of `make model`; local:FILE: other weights, GGUF; " +
          std::string(other_models));
}

void add_suite_options(CLI::App& command, suites::SuiteRequest& request) {
  without_slash(
      add_needed(command, "name", request.name,
                 "A suite (natural, balanced), a family, a table of the paper (table_2, "
                 "table_2_late, table_3), a folder of scenarios, 100car, traffic, or a regulation "
                 "(fmvss127, r152)"));
  add(command, "--data", request.data,
      "Of 100car the folder of the study's release; of traffic (SACA in shadow) folders with "
      "CommonRoad files or that release");
  add_draw_options(command, request);
  add_thinking_options(command, request.thinking.memory, request.thinking.model);
  add_thresholds_options(command, request.thresholds);
  add(command, "--danger", request.danger,
      "Weights of V_h and Q_h (models/danger), for methods that choose by them");
  add(command, "--seed", request.seed, "Of all that is drawn: same seed, same rows");
  command.add_flag("--exact", request.exact,
                   "Nothing is left to chance, and perception is as the scenarios have it");
  add(command, "--output", request.output,
      "Rows as HDF5; beside them .json and .html (default: runs/...)");
  add_threads(command, request.threads);
}

void need_png_or_html(const std::string& output) {
  const fs::path extension = fs::path(output).extension();
  if (extension != ".png" && extension != ".html") {
    refuse(wrong_command_line,
           fmt::format("--output: want a name that ends in .png or .html, got '{}'", output));
  }
}

void refuse_endings(const std::string& output, const std::vector<std::string>& endings) {
  const std::string extension = fs::path(output).extension();
  if (std::find(endings.begin(), endings.end(), extension) != endings.end()) {
    refuse(wrong_command_line,
           fmt::format("--output: want a name that does not end in {}, which is written beside it, "
                       "got '{}'",
                       extension, output));
  }
}

}  // namespace saca::app
