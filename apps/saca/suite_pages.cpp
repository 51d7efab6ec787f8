#include "apps/saca/suite_pages.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "apps/saca/json_output.h"
#include "apps/saca/suite_decisions.h"
#include "saca/base/core/file.h"
#include "saca/lab/eval/suite_file.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/policy_study/policy_sheet.h"

namespace saca::app {
namespace {

using eval::Estimate;
using eval::MethodFigures;
using eval::MethodRun;
using eval::SuiteRow;

constexpr std::size_t gallery_size = 12;

std::string title_of(const std::string& method) {
  return std::string(eval::find_method(method)->title);
}

/// How often the first method does less, the same, or more harm than another.
std::string counted(const SuiteRun& run, std::size_t method, std::size_t other) {
  int better = 0;
  int worse = 0;
  int all = 0;
  for (const SuiteRow& row : run.rows) {
    if (row.fault.empty()) {
      const double more = row.risk.runs[method].harm - row.risk.runs[other].harm;
      better += more < -eval::material ? 1 : 0;
      worse += more > eval::material ? 1 : 0;
      ++all;
    }
  }
  return fmt::format(
      "In {} of {} encounters it does materially less harm (by more than {}), in {} materially "
      "more, "
      "in the rest about the same.",
      better, all, eval::material, worse);
}

std::vector<std::string> sentences(const SuiteRun& run, const SuiteResult& result) {
  const MethodFigures& first = result.all.front();
  std::vector<std::string> lines;
  const auto at = index_of(run.methods, "aeb");
  if (at && first.method != "aeb") {
    const MethodFigures& aeb = result.all[*at];
    const double more = first.over_aeb.value;
    const bool sure = first.over_aeb.low > 0.0 || first.over_aeb.high < 0.0;
    lines.push_back(fmt::format(
        "{} does {:.4f} harm per encounter, emergency braking at T1 {:.4f}: {} (difference {} per "
        "encounter, paired, 95 % interval).",
        title_of(first.method), first.harm.value, aeb.harm.value,
        first.over_aeb.low == first.over_aeb.high ? "the same"
        : !sure                                   ? "the difference may be chance"
        : more < 0                                ? "it is better"
                                                  : "it is worse",
        with_interval(first.over_aeb, 4)));
    lines.push_back(counted(run, 0, *at));
    std::string where_better;
    std::string where_worse;
    for (const auto& [family, figures] : result.families) {
      const Estimate& over = figures.front().over_aeb;
      std::string& where = over.high < 0.0 ? where_better : where_worse;
      if (over.high < 0.0 || over.low > 0.0) {
        where += (where.empty() ? "" : ", ") + fmt::format("{} ({:+.4f})", family, over.value);
      }
    }
    lines.push_back(fmt::format("Better than braking in: {}. Worse in: {}.",
                                where_better.empty() ? "no family" : where_better,
                                where_worse.empty() ? "no family" : where_worse));
  }
  lines.push_back(fmt::format(
      "Regret, the harm above that of the best of all plans begun at T1, is {:.4f} for {}. 0.005 "
      "harm is half a per cent of a severely injured person.",
      first.regret.value, title_of(first.method)));
  const MethodFigures* best = nullptr;  // of those that a road allows
  for (const MethodFigures& one : result.all) {
    if (!eval::find_method(one.method)->knows_truth &&
        (best == nullptr || one.regret.value < best->regret.value)) {
      best = &one;
    }
  }
  if (best != nullptr) {
    lines.push_back(fmt::format("Of all methods that a road allows, {} has the least: {:.4f}.",
                                title_of(best->method), best->regret.value));
  }
  if (first.expected) {
    lines.push_back(expectations_text(first));
  }
  return lines;
}

report::DotChart chart_of(const SuiteResult& result) {
  report::DotChart chart{
      .heading = "Harm per encounter",
      .lines = {"Expected severely injured and killed people, weighted; mean and "
                "95 % interval. Grey: yardsticks that know the truth."},
      .axis_name = "harm",
      .axis_unit = "-",
      .rows = {}};
  for (const MethodFigures& one : result.all) {
    const bool yardstick = eval::find_method(one.method)->knows_truth;
    chart.rows.push_back({.name = title_of(one.method),
                          .looks = yardstick ? "fill-grey" : "fill-blue",
                          .note = fmt::format("{:.4f}", one.harm.value),
                          .value = one.harm.value,
                          .low = std::max(0.0, one.harm.low),
                          .high = one.harm.high});
  }
  return chart;
}

report::PageTable all_figures(const SuiteResult& result) {
  report::PageTable table{
      .heading = "All figures",
      .lines =
          {"Means with 95 % intervals (bootstrap over encounters). Regret is the harm above that "
           "of "
           "the best of all plans begun at T1; as published, above that of the best of the eight "
           "policies, whose braking has one strength. Twins are the same "
           "encounters without risk. In the files beside this page, shares have intervals too."},
      .columns = {"harm", "regret, all plans", "regret, as published", "harm above AEB's",
                  "Collision Loss", "contact, %", "as good as the best, %",
                  "materially worse than AEB, %", "needless, %", "False-Trigger Loss (twins)"},
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
                   one.false_trigger_loss ? fmt::format("{:.3f}", one.false_trigger_loss->value)
                                          : "-"},
         .shades = {},
         .faded = info.knows_truth});
  }
  return table;
}

report::PageTable families_of(const SuiteResult& result) {
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

/// Recorded drivers beside the methods, in the encounters in which there was one.
std::optional<report::PageTable> drivers_of(const SuiteRun& run) {
  std::vector<const SuiteRow*> recorded;
  for (const SuiteRow& row : run.rows) {
    if (row.fault.empty() && row.driver) {
      recorded.push_back(&row);
    }
  }
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

const preview::RolledOut* tried_of(const eval::TriedScene& scene, const manoeuvre::Plan& plan) {
  for (const preview::RolledOut& one : scene.tried) {
    const manoeuvre::Plan& tried = one.facts.plan;
    if (tried.policy == plan.policy && strength_of(tried) == strength_of(plan) &&
        std::abs(tried.target_speed.value_or(0.0) - plan.target_speed.value_or(0.0)) < 0.5) {
      return &one;
    }
  }
  return nullptr;
}

/// One line why it was lost.
std::string why_of(const SuiteRow& row, const MethodRun& run) {
  const std::string met = run.met
                              ? fmt::format("meets {} at {:.1f} m/s", *run.met, run.impact_speed)
                              : "meets nobody at first";
  return fmt::format("{} {}, harm {:.3f}; {} would have done {:.3f}. {}",
                     run.plan ? plan_text(*run.plan) : "Nothing is done and it", met, run.harm,
                     row.risk.best ? plan_text(*row.risk.best) : "doing nothing",
                     row.risk.best_harm, run.reason);
}

std::optional<report::GalleryCard> card_of(const SuiteRun& run, const SuiteRow& row,
                                           const SuiteCommandOptions& options) {
  const auto encounter = run.encounter_at(row.number);
  if (!encounter.has_value() || !row.risk.best) {
    return std::nullopt;
  }
  const auto scene = run.tried_in(encounter.value());
  if (!scene) {
    return std::nullopt;
  }
  const MethodRun& first = row.risk.runs.front();
  const manoeuvre::Plan nothing{manoeuvre::PolicyId::no_intervention, std::nullopt};
  const auto* const done = tried_of(*scene, first.plan.value_or(nothing));
  const auto* const best = tried_of(*scene, *row.risk.best);
  if (done == nullptr || best == nullptr) {
    return std::nullopt;
  }
  report::GalleryCard card{
      .title = fmt::format("{} {}: regret {:.3f}", row.family, row.number,
                           first.harm - row.risk.best_harm),
      .lines = {why_of(row, first)},
      .done = policy_study::view_of(scene->scene, *done),
      .best = policy_study::view_of(scene->scene, *best),
      .command = fmt::format("saca suite {} --split {} --seed {}{}{} --replay {}", options.name,
                             options.split, options.seed, options.exact ? " --exact" : "",
                             thinking_text(options.thinking) +
                                 (options.car == "compact_rwd_ev" ? "" : " --car " + options.car) +
                                 (options.data.empty() ? "" : " --data " + options.data.front()),
                             row.number)};
  card.done.badge = "done";
  card.best.badge = "best";
  return card;
}

std::vector<report::GalleryCard> gallery_of(const SuiteRun& run,
                                            const SuiteCommandOptions& options) {
  std::vector<const SuiteRow*> worst;
  for (const SuiteRow& row : run.rows) {
    if (row.fault.empty() && row.risk.runs.front().harm > row.risk.best_harm + eval::material) {
      worst.push_back(&row);
    }
  }
  const auto regret = [](const SuiteRow* row) {
    return row->risk.runs.front().harm - row->risk.best_harm;
  };
  std::stable_sort(worst.begin(), worst.end(),
                   [&](const SuiteRow* a, const SuiteRow* b) { return regret(a) > regret(b); });
  std::vector<report::GalleryCard> cards;
  for (const SuiteRow* const row : worst) {
    if (cards.size() == gallery_size) {
      break;
    }
    if (auto card = card_of(run, *row, options)) {
      cards.push_back(std::move(*card));
    }
  }
  return cards;
}

}  // namespace

report::SuitePage page_of(const SuiteRun& run, const SuiteResult& result,
                          const SuiteCommandOptions& options) {
  report::SuitePage page;
  page.title = fmt::format("{}: {} encounters, {} methods", options.name, run.rows.size(),
                           run.methods.size());
  if (result.all.empty()) {
    page.lines = {"No encounter could be played."};
    return page;
  }
  page.lines = sentences(run, result);
  page.lines.insert(page.lines.end(), run.notes.begin(), run.notes.end());
  page.chart = chart_of(result);
  page.tables = {all_figures(result), families_of(result)};
  for (const MethodFigures& one : result.all) {
    if (one.thinking || &one == &result.all.front()) {
      page.tables.push_back(decisions_table(one));
    }
  }
  if (auto drivers = drivers_of(run)) {
    page.tables.insert(page.tables.begin(), std::move(*drivers));
  }
  page.gallery_heading = "The encounters in which " + title_of(result.all.front().method) +
                         " lost most: what it did, and what would have been best";
  page.gallery = gallery_of(run, options);
  page.footnotes = footnotes_of(run.meta);
  for (const SuiteRow& row : run.rows) {
    if (!row.fault.empty() && page.footnotes.size() < 30) {
      page.footnotes.push_back(
          fmt::format("encounter {} could not be played: {}", row.number, row.fault));
    }
  }
  return page;
}

std::optional<Error> write_rows_and_page(const SuiteRun& run, const SuiteResult& result,
                                         const SuiteCommandOptions& options) {
  if (auto problem = eval::write_suite(options.output, run.rows, run.methods, run.meta.dump())) {
    return problem;
  }
  return long_work::write_output(std::filesystem::path(options.output).replace_extension(".html"),
                                 report::suite_page(page_of(run, result, options)));
}

}  // namespace saca::app
