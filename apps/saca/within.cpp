#include "apps/saca/within.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <utility>

#include "saca/base/core/other_unit.h"
#include "saca/base/core/suggestion.h"

namespace saca::app {

CLI::Validator within(double low, double high, std::string_view unit) {
  const bool named = !unit.empty() && unit != "-";
  const std::string shown_unit = named ? fmt::format(" {}", unit) : "";
  const auto complaint = [=, unit = std::string(unit)](const std::string& text) {
    double value = 0.0;
    const auto [rest, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool number = problem == std::errc() && rest == text.data() + text.size();
    if (number && value >= low && value <= high) {
      return std::string();
    }
    return fmt::format("{}{}: want {:g} to {:g}{}{}", text, number ? shown_unit : "", low, high,
                       shown_unit,
                       number ? other_unit_hint(value, low, high, unit) : ", got no number");
  };
  return {complaint, fmt::format("FLOAT in [{:g} - {:g}]", low, high)};
}

CLI::Validator one_of(std::vector<std::string> words) {
  const std::string description = fmt::format("{{{}}}", fmt::join(words, ","));
  const auto complaint = [words = std::move(words)](const std::string& text) {
    return std::find(words.begin(), words.end(), text) != words.end()
               ? std::string()
               : fmt::format("'{}' is unknown; {}", text, suggestion(text, words));
  };
  return {complaint, description};
}

void add_threads(CLI::App& command, int& threads, const std::string& what) {
  command.add_option("--threads", threads, what)->check(CLI::Range(1, 256))->capture_default_str();
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
  command
      .add_option("--target-speed", speed, "Of policies 3 and 4 [m/s] (default: half the speed)")
      ->check(within(0.0, 100.0, "m/s"));
}

}  // namespace saca::app
