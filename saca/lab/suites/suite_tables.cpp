#include "saca/lab/suites/suite_tables.h"

#include <fmt/core.h>

#include <algorithm>

#include "saca/lab/eval/estimate_text.h"
#include "saca/lab/eval/methods.h"
#include "saca/lab/suites/method_list.h"

namespace saca::suites {
namespace {

using eval::MethodFigures;
using eval::SuiteRow;

/// The encounters in which there was a recorded driver.
std::vector<const SuiteRow*> recorded_rows(const SuiteRun& run) {
  std::vector<const SuiteRow*> recorded;
  for (const SuiteRow& row : run.rows) {
    if (counts_in_figures(row) && row.driver) {
      recorded.push_back(&row);
    }
  }
  return recorded;
}

}  // namespace

report::DotRow method_dot(std::string_view method, const eval::Estimate& figure, int digits) {
  return {.name = title_of(method),
          .looks = eval::find_method(method)->knows_truth ? "fill-grey" : "fill-blue",
          .note = fmt::format("{:.{}f}", figure.value, digits),
          .value = figure.value,
          .low = figure.low,
          .high = figure.high};
}

report::DotChart harm_chart(const SuiteResult& result) {
  report::DotChart chart{
      .heading = "Harm per encounter",
      .lines = {"Expected severely injured and killed people, weighted; mean and "
                "95 % interval. Grey: yardsticks that know the truth."},
      .axis_name = "harm",
      .axis_unit = "-",
      .rows = {}};
  for (const MethodFigures& one : result.all) {
    chart.rows.push_back(method_dot(one.method, one.harm, 4));
    chart.rows.back().low = std::max(0.0, one.harm.low);
  }
  return chart;
}

report::PageTable figures_table(const SuiteResult& result) {
  report::PageTable table{
      .heading = "All figures",
      .lines =
          {"Means with 95 % intervals (bootstrap over encounters). Regret is the harm above that "
           "of the best of all plans begun at T1; as published, above that of the best of the "
           "eight policies, whose braking has one strength. Twins are the same encounters without "
           "risk: what they harm comes of acting without need. In the files beside this page, "
           "shares have intervals too."},
      .columns = {"harm", "regret, all plans", "regret, as published", "harm above AEB's",
                  "Collision Loss", "contact, %", "as good as the best, %",
                  "materially worse than AEB, %", "needless, %", "False-Trigger Loss (twins)",
                  "harm in twins"},
      .rows = {}};
  for (const MethodFigures& one : result.all) {
    const eval::MethodInfo& info = *eval::find_method(one.method);
    table.rows.push_back(
        {.name = std::string(info.title),
         .explanation = std::string(info.what),
         .cells = {with_interval(one.harm, 4), with_interval(one.regret, 4),
                   with_interval(one.published_regret, 4),
                   one.over_aeb.n == 0 ? "-" : with_interval(one.over_aeb, 4),
                   fmt::format("{:.2f}", one.collision_loss.value), percent_of(one.contact),
                   percent_of(one.right), percent_of(one.worse_than_aeb), percent_of(one.needless),
                   one.twins ? fmt::format("{:.3f}", one.twins->false_trigger_loss.value) : "-",
                   one.twins ? with_interval(one.twins->harm, 4) : "-"},
         .shades = {},
         .faded = info.knows_truth});
  }
  return table;
}

report::PageTable families_table(const SuiteResult& result) {
  report::PageTable table{
      .heading = "Regret by family",
      .lines = {"Harm above that of the best of all plans begun at T1; the darker, the more is "
                "lost."},
      .columns = {},
      .rows = {}};
  double most = 1e-9;
  for (const auto& [family, figures] : result.families) {
    if (figures.empty()) {
      continue;
    }
    table.columns.push_back(fmt::format("{} ({})", family, figures.front().harm.n));
    for (const MethodFigures& one : figures) {
      if (one.method != "nothing" && one.method != "random") {
        most = std::max(most, one.regret.value);
      }
    }
  }
  for (std::size_t m = 0; m < result.all.size(); ++m) {
    const eval::MethodInfo& info = *eval::find_method(result.all[m].method);
    report::PageTable::Row row{.name = std::string(info.title),
                               .explanation = {},
                               .cells = {},
                               .shades = {},
                               .faded = info.knows_truth};
    for (const auto& [family, figures] : result.families) {
      if (figures.empty()) {
        continue;
      }
      const double regret = figures[m].regret.value;
      row.cells.push_back(fmt::format("{:.4f}", regret));
      row.shades.emplace_back(std::clamp(regret / most, 0.0, 1.0));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::optional<report::PageTable> drivers_table(const SuiteRun& run) {
  const std::vector<const SuiteRow*> recorded = recorded_rows(run);
  if (recorded.empty()) {
    return std::nullopt;
  }
  const auto n = static_cast<double>(recorded.size());
  const DriverFigures driver = driver_figures(run);
  report::PageTable table{
      .heading = "The recorded drivers",
      .lines = {fmt::format(
          "{} encounters with a recorded driver, who met somebody in {}, braked in "
          "{} and moved aside in {}. A method agrees where it brakes, or not, and "
          "goes to the same side, among those where the driver met nobody.",
          recorded.size(), driver.met, driver.braked, driver.steered)},
      .columns = {"harm", "meets somebody", "agrees with drivers who met nobody, %"},
      .rows = {}};
  table.rows.push_back(
      {.name = "The driver",
       .explanation = {},
       .cells = {fmt::format("{:.4f}", driver.harm), std::to_string(driver.met), "-"},
       .shades = {}});
  for (std::size_t m = 0; m < run.methods.size(); ++m) {
    double harm = 0.0;
    int met = 0;
    for (const SuiteRow* const row : recorded) {
      harm += row->risk.runs[m].harm / n;
      met += row->risk.runs[m].met ? 1 : 0;
    }
    table.rows.push_back({.name = title_of(run.methods[m]),
                          .explanation = {},
                          .cells = {fmt::format("{:.4f}", harm), std::to_string(met),
                                    fmt::format("{:.1f}", 100.0 * driver.agreement[m])},
                          .shades = {},
                          .faded = eval::find_method(run.methods[m])->knows_truth});
  }
  return table;
}

}  // namespace saca::suites
