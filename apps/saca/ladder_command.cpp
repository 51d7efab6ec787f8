#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/saca/commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/printing.h"
#include "apps/saca/suite_decisions.h"
#include "apps/saca/suite_pages.h"
#include "saca/base/core/file.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using eval::Estimate;
using nlohmann::json;

/// A rung, and what is lost between it and the one above.
struct Rung {
  const char* method;
  const char* above;  ///< nullptr: the top
  const char* step;   ///< what is lost or won against `above`, in words
};

constexpr std::array<Rung, 12> usual_rungs{{
    {"oracle", nullptr, "Best in hindsight."},
    {"true_rolled_out", "oracle", "not knowing the grip, nor how the car differs from its data"},
    {"true_atlas", "true_rolled_out",
     "the atlas in place of full dynamics: first contacts only, and "
     "nobody reacts to what is done"},
    {"beliefs_rolled_out", "true_rolled_out", "believing in place of knowing what the others do"},
    {"beliefs_atlas", "beliefs_rolled_out", "the atlas in place of full dynamics"},
    {"going_on_atlas", "beliefs_atlas", "taking all others to go on as they do"},
    {"newest_forecast", "going_on_atlas",
     "choosing from the newest forecast, not from the scene at T1"},
    {"first_forecast", "newest_forecast", "choosing from the first forecast, some seconds earlier"},
    {"aeb", "first_forecast", "always braking"},
    {"beliefs_and_grip", "beliefs_rolled_out", "told the true grip and car"},
    {"beliefs_and_followers", "beliefs_rolled_out", "told how followers react"},
    {"beliefs_and_hidden", "beliefs_rolled_out", "seeing everybody without noise or latency"},
}};

/// Where there is a memory or a model; without either SACA always brakes.
constexpr Rung saca_rung{"saca", "aeb", "what memory and model hold, in place of always braking"};

/// Where there is a memory.
constexpr std::array<Rung, 2> experience_rungs{{
    {"beliefs_drawn", "beliefs_rolled_out", "over draws of all that is not known of the others"},
    {"beliefs_and_experience", "beliefs_drawn", "corrected by what happened in like cases"},
}};

/// Where there are weights of V_h.
constexpr std::array<Rung, 3> danger_rungs{{
    {"least_danger", "going_on_atlas", "how much room is left in place of harm"},
    {"least_joint_danger", "least_danger", "V_h beside all in place of the highest single one"},
    {"beliefs_and_danger", "beliefs_atlas", "what harms alike goes by V_h, not by mildness"},
}};

std::vector<Rung> rungs_with(const ThinkingOptions& thinking, bool danger) {
  std::vector<Rung> rungs(usual_rungs.begin(), usual_rungs.end());
  if (danger) {
    rungs.insert(rungs.end(), danger_rungs.begin(), danger_rungs.end());
  }
  if (!thinking.memory.empty()) {
    rungs.insert(rungs.end(), experience_rungs.begin(), experience_rungs.end());
  }
  if (!thinking.memory.empty() || thinking.model != "off") {
    rungs.push_back(saca_rung);
  }
  return rungs;
}

struct LadderCommand {
  SuiteCommandOptions suite;
  bool as_json = false;
};

std::vector<std::string> names_of(const std::vector<Rung>& rungs) {
  std::vector<std::string> names;
  names.reserve(rungs.size());
  for (const Rung& rung : rungs) {
    names.emplace_back(rung.method);
  }
  return names;
}

/// Regret of a rung and what its step costs.
struct RungFigures {
  Rung rung;
  eval::MethodFigures figures;
  std::optional<Estimate> step;
};

std::vector<RungFigures> climb(const SuiteRun& run, const std::vector<Rung>& rungs,
                               std::uint64_t seed) {
  std::vector<const eval::SuiteRow*> all;
  for (const eval::SuiteRow& row : run.rows) {
    all.push_back(&row);
  }
  const auto at = [&](const char* name) { return index_of(run.methods, name).value(); };
  auto figures = eval::suite_figures(all, run.methods, at("aeb"), seed);
  std::vector<RungFigures> climbed;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    climbed.push_back({rungs[i], std::move(figures[i]), std::nullopt});
    if (rungs[i].above != nullptr) {
      climbed.back().step = eval::harm_above(run.rows, i, at(rungs[i].above), seed);
    }
  }
  return climbed;
}

std::string step_text(const RungFigures& one) {
  if (!one.step) {
    return one.rung.step;
  }
  const bool sure = one.step->low > 0.0 || one.step->high < 0.0;
  return fmt::format("{}: {:+.4f} ({:+.4f} to {:+.4f}){}", one.rung.step, one.step->value,
                     one.step->low, one.step->high, sure ? "" : ", which may be chance");
}

json json_of(const SuiteRun& run, const std::vector<RungFigures>& climbed,
             const std::string& name) {
  json out = run.meta;
  const std::string head = "ladder." + name + ".";
  for (const RungFigures& one : climbed) {
    const std::string place = head + one.rung.method;
    add_estimate(out, place, one.figures.regret);
    add_estimate(out, place + ".materially_worse_than_aeb", one.figures.worse_than_aeb);
    if (one.step) {
      add_estimate(out, place + ".step_from." + one.rung.above, *one.step);
    }
    if (one.figures.thinking) {
      add_decisions(out, place + ".", one.figures);
    }
  }
  return out;
}

report::SuitePage page_of(const SuiteRun& run, const std::vector<RungFigures>& climbed,
                          const std::string& name) {
  report::SuitePage page;
  page.title = fmt::format("Where regret comes from: {}, {} encounters", name, run.rows.size());
  page.lines = {
      "Each rung chooses one of the plans at T1 and knows less than the one it is held "
      "against; regret is the harm above that of the best plan begun at T1."};
  report::DotChart chart{.heading = "Regret of each rung",
                         .lines = {"Mean and 95 % interval; what is below 0 is drawn at 0."},
                         .axis_name = "regret",
                         .axis_unit = "-",
                         .rows = {}};
  report::PageTable table{
      .heading = "What each step costs",
      .lines =
          {"Paired differences of harm in the same encounters; a step that saves is negative."},
      .columns = {"regret", "step", "against", "materially worse than AEB, %", "in words"},
      .rows = {}};
  for (const RungFigures& one : climbed) {
    const eval::MethodInfo& info = *eval::find_method(one.rung.method);
    const Estimate& regret = one.figures.regret;
    chart.rows.push_back({.name = std::string(info.title),
                          .looks = info.knows_truth ? "fill-grey" : "fill-blue",
                          .note = fmt::format("{:.4f}", regret.value),
                          .value = std::max(0.0, regret.value),
                          .low = std::clamp(regret.low, 0.0, std::max(0.0, regret.value)),
                          .high = std::max({0.0, regret.value, regret.high})});
    table.rows.push_back(
        {.name = std::string(info.title),
         .explanation = std::string(info.what),
         .cells = {with_interval(regret, 4), one.step ? with_interval(*one.step, 4) : "-",
                   one.rung.above == nullptr
                       ? "-"
                       : std::string(eval::find_method(one.rung.above)->title),
                   fmt::format("{:.1f}", 100.0 * one.figures.worse_than_aeb.value), one.rung.step},
         .shades = {},
         .faded = info.knows_truth});
  }
  page.chart = std::move(chart);
  page.tables.push_back(std::move(table));
  for (const RungFigures& one : climbed) {
    if (one.figures.thinking) {
      page.tables.push_back(decisions_table(one.figures));
    }
  }
  page.footnotes = footnotes_of(run.meta);
  return page;
}

int run(LadderCommand options) {
  SuiteCommandOptions& suite = options.suite;
  const std::string name = fs::path(suite.name).filename().string();
  if (suite.output.empty()) {
    suite.output = fmt::format("runs/ladder-{}-{}.json", name, suite.split);
  }
  if (const auto problem = long_work::why_outputs_unwritable({suite.output})) {
    return refused(*problem);
  }
  suite.no_twins = true;
  const std::vector<Rung> rungs = rungs_with(suite.thinking, !suite.danger.empty());
  const auto ran = run_suite(suite, "ladder", names_of(rungs));
  if (!ran.has_value()) {
    return refused(ran.error());
  }
  if (!ran.value()) {
    complain("interrupted; the same command goes on where this one stopped");
    return was_interrupted;
  }
  const auto climbed = climb(*ran.value(), rungs, suite.seed);
  if (climbed.empty()) {
    complain(suite.name + ": no encounter could be played; the journal holds why");
    return some_failed;
  }
  const json figures = json_of(*ran.value(), climbed, name);
  const std::string text = json_text(figures) + "\n";
  auto problem = long_work::write_output(suite.output, text);
  if (!problem) {
    problem = long_work::write_output(fs::path(suite.output).replace_extension(".html"),
                                      report::suite_page(page_of(*ran.value(), climbed, name)));
  }
  if (problem) {
    return refused(*problem);
  }
  if (options.as_json) {
    app::print("{}", text);
  } else {
    app::print("{}: {} encounters; regret, and what each step adds to it, with 95 % intervals\n\n",
               suite.name, climbed.front().figures.regret.n);
    for (const RungFigures& one : climbed) {
      app::print("{:22} {:28} {}\n", one.rung.method, with_interval(one.figures.regret, 4),
                 step_text(one));
    }
    app::print("\npage: {}\n", fs::path(suite.output).replace_extension(".html").string());
  }
  const bool faults = std::any_of(
      ran.value()->rows.begin(), ran.value()->rows.end(), [](const eval::SuiteRow& row) {
        return !row.fault.empty() ||
               std::any_of(row.risk.runs.begin(), row.risk.runs.end(),
                           [](const eval::MethodRun& one) { return !one.fault.empty(); });
      });
  return faults ? some_failed : success;
}

}  // namespace

void add_ladder(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand(
      "ladder",
      "Where regret comes from: what each thing that is not known costs; can be interrupted");
  const auto options = std::make_shared<LadderCommand>();
  add_suite_options(*command, options->suite);
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace saca::app
