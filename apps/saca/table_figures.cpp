#include "apps/saca/table_figures.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "apps/saca/suite_pages.h"

namespace saca::app {
namespace {

using eval::Estimate;
using eval::MethodFigures;
using eval::PaperTable;
using eval::SuiteRow;
using nlohmann::json;

std::vector<MethodFigures> figures_of(const std::vector<const SuiteRow*>& rows,
                                      const std::vector<std::string>& methods, std::uint64_t seed) {
  return eval::suite_figures(rows, methods, index_of(methods, "aeb"), seed);
}

/// The paper's filter: was the model asked, and did each of its replies come to its end before the
/// trigger that it was about?
bool is_in_time(const eval::MethodRun& run) {
  return run.thinking && run.thinking->asked > 0 && run.thinking->ended == run.thinking->asked;
}

std::string false_triggers(const MethodFigures& one) {
  return with_interval(one.false_trigger_loss.value_or(Estimate{}), 2);
}

}  // namespace

std::string number_of(const PaperTable& table) {
  return std::string(table.name.substr(std::string_view("table_").size()));
}

TableFigures table_figures(const PaperTable& table, const SuiteRun& run, std::size_t few,
                           std::uint64_t seed) {
  TableFigures figures{.table = &table, .few = {}, .all = {}, .in_time = {}, .page = {}};
  std::vector<const SuiteRow*> rows;
  for (const SuiteRow& row : run.rows) {
    rows.push_back(&row);
  }
  figures.all = figures_of(rows, run.methods, seed);
  figures.in_time.resize(run.methods.size());
  for (std::size_t m = 0; m < run.methods.size(); ++m) {
    std::vector<const SuiteRow*> answered;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(answered), [&](const SuiteRow* row) {
      return row->fault.empty() && is_in_time(row->risk.runs[m]);
    });
    if (!answered.empty()) {
      figures.in_time[m] = figures_of(answered, run.methods, seed)[m];
    }
  }
  rows.resize(std::min(few, rows.size()));
  figures.few = figures_of(rows, run.methods, seed);
  return figures;
}

report::PageTable page_table(const TableFigures& figures) {
  const auto draws = [](const std::vector<MethodFigures>& of) {
    return fmt::format("n = {}", of.front().collision_loss.n);
  };
  report::PageTable page{
      .heading = std::string(figures.table->title),
      .lines = {std::string(figures.table->conditions) +
                ". Published rows are from another simulator and of 10 trials."},
      .columns = {"Collision Loss, " + draws(figures.few), draws(figures.all),
                  "where all replies came in time", "False-Trigger Loss, " + draws(figures.few),
                  draws(figures.all), "harm above AEB's"},
      .rows = {},
      .chart = report::DotChart{.heading = "Collision Loss",
                                .lines = {"Mean and 95 % interval over all draws. Grey: yardsticks "
                                          "that know the truth."},
                                .axis_name = "Collision Loss",
                                .axis_unit = "-",
                                .rows = {}}};
  for (const eval::PublishedRow& row : figures.table->published) {
    page.rows.push_back({.name = fmt::format("published: {}", row.title),
                         .explanation = {},
                         .cells = {fmt::format("{:.2f}", row.collision_loss), "-", "-",
                                   fmt::format("{:.2f}", row.false_trigger_loss), "-", "-"},
                         .shades = {}});
  }
  for (std::size_t m = 0; m < figures.all.size(); ++m) {
    const MethodFigures& one = figures.all[m];
    const eval::MethodInfo& info = *eval::find_method(one.method);
    const auto& in_time = figures.in_time[m];
    page.rows.push_back(
        {.name = std::string(info.title),
         .explanation = std::string(info.what),
         .link = figures.page,
         .cells = {with_interval(figures.few[m].collision_loss, 2),
                   with_interval(one.collision_loss, 2),
                   in_time ? fmt::format("{}, n = {}", with_interval(in_time->collision_loss, 2),
                                         in_time->collision_loss.n)
                           : "-",
                   false_triggers(figures.few[m]), false_triggers(one),
                   with_interval(one.over_aeb, 4)},
         .shades = {},
         .faded = info.knows_truth});
    page.chart->rows.push_back({.name = std::string(info.title),
                                .looks = info.knows_truth ? "fill-grey" : "fill-blue",
                                .note = fmt::format("{:.2f}", one.collision_loss.value),
                                .value = one.collision_loss.value,
                                .low = one.collision_loss.low,
                                .high = one.collision_loss.high});
  }
  return page;
}

report::PageTable replies_table(const std::vector<TimedModel>& timed) {
  report::PageTable page{
      .heading = "Table IV: replies",
      .lines =
          {"What SACA asks first in some draws of each table, up to three forecasts at once, put "
           "to the model by itself at real pace. A reply is done when it ends by itself or has "
           "as many tokens as it may; the local model may write 112. In time: within T2 - T1."},
      .columns = {"forecasts", "done", "ended", "tokens", "seconds", "least", "in time"},
      .rows = {},
      .chart = {}};
  for (const eval::PublishedReplies& paper : eval::published_replies()) {
    if (std::none_of(timed.begin(), timed.end(),
                     [&](const TimedModel& one) { return one.table == paper.table; })) {
      continue;
    }
    page.rows.push_back(
        {.name = fmt::format("published: {}", eval::find_paper_table(paper.table)->title),
         .explanation = {},
         .cells = {"-", "-", "-", fmt::format("{:.0f}", paper.tokens),
                   fmt::format("{:.1f}", paper.seconds), fmt::format("{:.1f}", paper.least_seconds),
                   "-"},
         .shades = {}});
  }
  for (const TimedModel& one : timed) {
    const eval::ReplyTimes& times = one.times;
    page.rows.push_back(
        {.name = fmt::format("{}, {}", eval::find_paper_table(one.table)->title, one.title),
         .explanation = {},
         .cells = {std::to_string(times.asked), std::to_string(times.done),
                   std::to_string(times.ended), with_interval(times.tokens, 0),
                   with_interval(times.seconds, 1),
                   times.least_seconds ? fmt::format("{:.1f}", *times.least_seconds) : "-",
                   std::to_string(times.in_time)},
         .shades = {}});
  }
  return page;
}

void add_figures(json& out, const TableFigures& figures) {
  const auto add_all = [&](const MethodFigures& one, const std::string& draws) {
    const auto put = [&](const std::string& what, const Estimate& estimate) {
      add_estimate(
          out, fmt::format("tables.{}.{}.{}{}", number_of(*figures.table), one.method, what, draws),
          estimate);
    };
    put("collision_loss", one.collision_loss);
    put("harm", one.harm);
    put("harm_over_aeb", one.over_aeb);
    if (one.false_trigger_loss) {
      put("false_trigger_loss", *one.false_trigger_loss);
    }
  };
  for (std::size_t m = 0; m < figures.all.size(); ++m) {
    add_all(figures.few[m], ".ten_draws");
    add_all(figures.all[m], "");
    if (const auto& in_time = figures.in_time[m]) {
      add_estimate(out,
                   fmt::format("tables.{}.{}.collision_loss.in_time", number_of(*figures.table),
                               in_time->method),
                   in_time->collision_loss);
    }
  }
}

void add_figures(json& out, const TimedModel& one) {
  const std::string place =
      fmt::format("tables.4.{}.{}.", number_of(*eval::find_paper_table(one.table)), one.key);
  out[place + "asked"] = one.times.asked;
  out[place + "done"] = one.times.done;
  out[place + "ended"] = one.times.ended;
  out[place + "in_time"] = one.times.in_time;
  add_estimate(out, place + "tokens", one.times.tokens);
  add_estimate(out, place + "seconds", one.times.seconds);
  if (one.times.least_seconds) {
    out[place + "least_seconds"] = *one.times.least_seconds;
  }
}

}  // namespace saca::app
