#include "saca/lab/suites/ladder_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "saca/lab/eval/estimate_text.h"
#include "saca/lab/eval/methods.h"
#include "saca/lab/suites/decisions.h"
#include "saca/lab/suites/method_list.h"
#include "saca/lab/suites/suite_result.h"
#include "saca/lab/suites/suite_tables.h"

namespace saca::suites {
namespace {

using eval::Estimate;
using nlohmann::json;

std::string step_text(const RungFigures& one) {
  if (!one.step) {
    return one.rung.step;
  }
  return fmt::format("{}: {:+.4f} ({:+.4f} to {:+.4f}){}", one.rung.step, one.step->value,
                     one.step->low, one.step->high,
                     eval::is_sure(*one.step) ? "" : ", which may be chance");
}

report::DotChart regret_chart(const std::vector<RungFigures>& climbed) {
  report::DotChart chart{.heading = "Regret of each rung",
                         .lines = {"Mean and 95 % interval; what is below 0 is drawn at 0."},
                         .axis_name = "regret",
                         .axis_unit = "-",
                         .rows = {}};
  for (const RungFigures& one : climbed) {
    const Estimate& regret = one.figures.regret;
    report::DotRow row = method_dot(one.rung.method, regret, 4);
    row.value = std::max(0.0, regret.value);
    row.low = std::clamp(regret.low, 0.0, *row.value);
    row.high = std::max(*row.value, regret.high);
    chart.rows.push_back(std::move(row));
  }
  return chart;
}

report::PageTable steps_table(const std::vector<RungFigures>& climbed) {
  report::PageTable table{
      .heading = "What each step costs",
      .lines =
          {"Paired differences of harm in the same encounters; a step that saves is negative."},
      .columns = {"regret", "step", "against", "materially worse than AEB, %", "in words"},
      .rows = {}};
  for (const RungFigures& one : climbed) {
    const eval::MethodInfo& info = *eval::find_method(one.rung.method);
    table.rows.push_back(
        {.name = std::string(info.title),
         .explanation = std::string(info.what),
         .cells = {with_interval(one.figures.regret, 4),
                   one.step ? with_interval(*one.step, 4) : "-",
                   one.rung.above == nullptr ? "-" : title_of(one.rung.above),
                   fmt::format("{:.1f}", 100.0 * one.figures.worse_than_aeb.value), one.rung.step},
         .shades = {},
         .faded = info.knows_truth});
  }
  return table;
}

}  // namespace

json ladder_json(const SuiteRun& run, const std::vector<RungFigures>& climbed,
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
  out[head + "faults"] =
      std::count_if(run.rows.begin(), run.rows.end(),
                    [](const eval::SuiteRow& row) { return !counts_in_figures(row); });
  return out;
}

std::string ladder_text(const SuiteRun& run, const std::vector<RungFigures>& climbed,
                        const std::string& suite) {
  std::string text = fmt::format(
      "{}: {} encounters; regret, and what each step adds to it, with 95 % intervals\n\n", suite,
      climbed.front().figures.regret.n);
  for (const RungFigures& one : climbed) {
    text += fmt::format("{:22} {:28} {}\n", one.rung.method, with_interval(one.figures.regret, 4),
                        step_text(one));
  }
  if (const std::string failures = failures_text(run); !failures.empty()) {
    text += "\n" + failures + "\n";
  }
  return text;
}

report::SuitePage ladder_page(const SuiteRun& run, const std::vector<RungFigures>& climbed,
                              const std::string& name) {
  report::SuitePage page;
  page.title = fmt::format("Where regret comes from: {}, {} encounters", name, run.rows.size());
  page.lines = {
      "Each rung chooses one of the plans at T1 and knows less than the one it is held "
      "against; regret is the harm above that of the best plan begun at T1."};
  page.chart = regret_chart(climbed);
  page.tables.push_back(steps_table(climbed));
  for (const RungFigures& one : climbed) {
    if (one.figures.thinking) {
      page.tables.push_back(decisions_table(one.figures));
    }
  }
  page.footnotes = footnotes_of(run.meta);
  if (const std::string failures = failures_text(run); !failures.empty()) {
    page.footnotes.push_back(failures);
  }
  return page;
}

}  // namespace saca::suites
