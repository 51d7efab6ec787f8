#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/surveying.h"
#include "saca/base/core/proportion.h"

namespace saca::app {
namespace {

using nlohmann::json;

struct BalanceCommand {
  SurveyOptions survey;
  bool as_json = false;
};

constexpr std::array<std::string_view, 5> lesson_words{
    "the trigger never fires", "nothing has to be done", "nothing helps",
    "several are as good, the mildest is taken", "one alone is best"};
constexpr std::array<std::string_view, 5> lesson_keys{
    "never_triggers", "nothing_needed", "nothing_helps", "several_as_good", "one_alone"};

std::string percent(int hits, int count) {
  const Proportion share = proportion(hits, count);
  return fmt::format("{:5.1f} % ({:.1f} to {:.1f})", 100.0 * share.share, 100.0 * share.low,
                     100.0 * share.high);
}

void print(const eval::Balance& balance) {
  app::print("{} encounters\n", balance.count);
  for (std::size_t i = 0; i < lesson_words.size(); ++i) {
    app::print("  {:42} {}\n", lesson_words[i], percent(balance.lessons[i], balance.count));
  }
  app::print("\npolicy    strictly best             median margin   best, ties to the milder\n");
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    const std::size_t i = manoeuvre::index(policy);
    app::print("{} {:6}  {:24}  {:13.4f}   {}\n", i, name(policy),
               percent(balance.alone[i], balance.count), balance.margin[i],
               percent(balance.best[i], balance.count));
  }
}

/// Figures under names for programs: balance.<suite>....
json figures_of(const eval::Balance& balance, const std::string& suite) {
  json figures;
  const std::string head = "balance." + suite + ".";
  const auto add = [&](const std::string& name, int hits) {
    const Proportion share = proportion(hits, balance.count);
    figures[head + name] = share.share;
    figures[head + name + ".lo"] = share.low;
    figures[head + name + ".hi"] = share.high;
  };
  for (std::size_t i = 0; i < lesson_keys.size(); ++i) {
    add(fmt::format("{}_share", lesson_keys[i]), balance.lessons[i]);
  }
  double least = 1.0;
  for (std::size_t i = 0; i < manoeuvre::num_policies; ++i) {
    add(fmt::format("strict_share.p{}", i), balance.alone[i]);
    add(fmt::format("best_share.p{}", i), balance.best[i]);
    figures[head + fmt::format("margin.p{}", i)] = balance.margin[i];
    if (manoeuvre::all_policies[i] != manoeuvre::PolicyId::no_intervention) {
      least = std::min(least, proportion(balance.alone[i], balance.count).share);
    }
  }
  figures[head + "least_strict_share"] = least;
  figures[head + "n"] = balance.count;
  return figures;
}

int run(const BalanceCommand& options) {
  const auto source = open_suite(options.survey, "balance");
  if (!source.has_value()) {
    return refused(source.error());
  }
  const auto found = survey(source.value(), options.survey);
  if (!found.has_value()) {
    return refused(found.error());
  }
  if (!found.value()) {
    complain("interrupted; the same command goes on where this one stopped");
    return was_interrupted;
  }
  const eval::Balance balance = eval::balance(*found.value());
  if (options.as_json) {
    json all = figures_of(balance, options.survey.suite);
    all["meta.command"] = command_line(options.survey, "balance");
    app::print_json(all);
  } else {
    print(balance);
  }
  return success;
}

}  // namespace

void add_balance(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand(
      "balance",
      "How often each policy is strictly best in a suite of encounters; can be interrupted");
  const auto options = std::make_shared<BalanceCommand>();
  add_survey_options(*command, options->survey);
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace saca::app
