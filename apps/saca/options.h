#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "apps/saca/command.h"
#include "saca/lab/installation/drawn_suite.h"
#include "saca/lab/shell/option_checks.h"
#include "saca/lab/suites/suite_request.h"
#include "saca/onboard/manoeuvre/plan.h"

// The options that commands have: how one is added, and those that several commands share.

namespace saca::app {

using shell::one_of;
using shell::within;

/// What an option holds one or several of.
template <class T>
struct ValueOf {
  using Type = T;
};
template <class T>
struct ValueOf<std::optional<T>> {
  using Type = T;
};
template <class T>
struct ValueOf<std::vector<T>> {
  using Type = T;
};

/// Adds an option whose value is held against its type, too: whole numbers come as they were typed,
/// or are refused.
template <class T>
CLI::Option* add_checked(CLI::App& command, const std::string& name, T& value,
                         const std::string& about, const CLI::Validator& check) {
  CLI::Option* const option = command.add_option(name, value, about)->check(check);
  using Value = typename ValueOf<T>::Type;
  if constexpr (std::is_integral_v<Value>) {
    option->check(shell::whole_number<Value>());
  }
  return option;
}

/// Adds an option, or what stands at a place of its own; help shows what it is unless it is given,
/// but where that is empty.
template <class T>
CLI::Option* add(CLI::App& command, const std::string& name, T& value, const std::string& about,
                 const CLI::Validator& check = CLI::Validator()) {
  CLI::Option* const option = add_checked(command, name, value, about, check);
  if constexpr (std::is_arithmetic_v<T>) {
    option->capture_default_str();
  } else if constexpr (std::is_same_v<T, std::string> ||
                       std::is_same_v<T, std::vector<std::string>> ||
                       std::is_same_v<T, std::vector<double>>) {
    if (!value.empty()) {
      option->capture_default_str();
    }
  }
  return option;
}

/// Likewise one that must be given.
template <class T>
CLI::Option* add_needed(CLI::App& command, const std::string& name, T& value,
                        const std::string& about, const CLI::Validator& check = CLI::Validator()) {
  return add_checked(command, name, value, about, check)->required();
}

/// --json
CLI::Option* add_json(CLI::App& command, bool& as_json, const std::string& about = "For programs");

/// --car
void add_car(CLI::App& command, std::string& car);

/// What `saca run` takes: a scenario's file or name.
void add_scenario(CLI::App& command, std::string& scenario);

/// --split and --test-log
void add_split(CLI::App& command, std::string& split, std::string& test_log);

/// --threads
void add_threads(CLI::App& command, int& threads,
                 const std::string& what = "They do not change the result");

/// --policy: a number or a short name of the paper, in any case.
CLI::Option* add_policy(CLI::App& command, std::optional<manoeuvre::PolicyId>& policy,
                        const std::string& what);
/// --target-speed [m/s], that goes with it.
void add_target_speed(CLI::App& command, std::optional<double>& speed);
/// --strength [-], likewise.
void add_strength(CLI::App& command, std::optional<double>& strength, const std::string& share);

/// --at-s: when the policies begin.
void add_at(CLI::App& command, std::optional<double>& at);
/// As asked for, else at the trigger [s]; where there is none, the command ends.
[[nodiscard]] double decision_time(const installation::ScenarioInputs& inputs,
                                   const std::optional<double>& at);

/// --suite, --count, --split, --test-log, --car, --journal and --threads.
void add_survey_options(CLI::App& command, installation::SurveyRequest& request);

/// Which encounters, and what is drawn in them.
void add_encounter_options(CLI::App& command, suites::SuiteRequest& from);

/// --memory and --llm: what SACA thinks with, with what these are as their defaults.
void add_thinking_options(CLI::App& command, std::string& memory, std::string& model);
/// --untuned
void add_untuned_option(CLI::App& command, std::string& model);
/// --llm of a command that is nothing without a model.
void add_needed_model(CLI::App& command, std::string& model);

/// What a suite or a ladder is asked for by.
void add_suite_options(CLI::App& command, suites::SuiteRequest& request);

/// Refuses an --output that ends in neither .png nor .html.
void need_png_or_html(const std::string& output);

/// Refuses names of --output that end as what is written beside it does.
void refuse_endings(const std::string& output, const std::vector<std::string>& endings);

}  // namespace saca::app
