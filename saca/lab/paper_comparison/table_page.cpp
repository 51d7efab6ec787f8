#include "saca/lab/paper_comparison/table_page.h"

#include <fmt/core.h>

#include <algorithm>

#include "saca/lab/eval/estimate_text.h"
#include "saca/lab/eval/methods.h"
#include "saca/lab/suites/suite_tables.h"

namespace saca::paper_comparison {
namespace {

using eval::MethodFigures;
using eval::with_interval;

std::string false_triggers(const MethodFigures& one) {
  return with_interval(one.twins.value_or(eval::TwinFigures{}).false_trigger_loss, 2);
}

report::PageTable::Row published_row(const eval::PublishedRow& row) {
  return {.name = fmt::format("published: {}", row.title),
          .explanation = {},
          .cells = {fmt::format("{:.2f}", row.collision_loss), "-", "-",
                    fmt::format("{:.2f}", row.false_trigger_loss), "-", "-"},
          .shades = {}};
}

report::PageTable::Row our_row(const TableFigures& figures, std::size_t method) {
  const MethodFigures& one = figures.all[method];
  const eval::MethodInfo& info = *eval::find_method(one.method);
  const auto& in_time = figures.in_time[method];
  return {.name = std::string(info.title),
          .explanation = std::string(info.what),
          .link = figures.page,
          .cells = {with_interval(figures.few[method].collision_loss, 2),
                    with_interval(one.collision_loss, 2),
                    in_time ? fmt::format("{}, n = {}", with_interval(in_time->collision_loss, 2),
                                          in_time->collision_loss.n)
                            : "-",
                    false_triggers(figures.few[method]), false_triggers(one),
                    with_interval(one.over_aeb, 4)},
          .shades = {},
          .faded = info.knows_truth};
}

}  // namespace

report::PageTable page_table(const TableFigures& figures) {
  const auto draws = [](const std::vector<MethodFigures>& of) {
    return fmt::format("n = {}", of.front().collision_loss.n);
  };
  report::PageTable page{
      .heading = std::string(figures.table->title),
      .lines = {std::string(figures.table->conditions) +
                ". Published rows are of a real car, 10 trials each; the trucks and cars that it "
                "met were virtual, or barriers."},
      .columns = {"Collision Loss, " + draws(figures.few), draws(figures.all),
                  "where each reply ended by itself", "False-Trigger Loss, " + draws(figures.few),
                  draws(figures.all), "harm above AEB's"},
      .rows = {},
      .chart = report::DotChart{.heading = "Collision Loss",
                                .lines = {"Mean and 95 % interval over all draws. Grey: yardsticks "
                                          "that know the truth."},
                                .axis_name = "Collision Loss",
                                .axis_unit = "-",
                                .rows = {}}};
  for (const eval::PublishedRow& row : figures.table->published) {
    page.rows.push_back(published_row(row));
  }
  for (std::size_t m = 0; m < figures.all.size(); ++m) {
    const MethodFigures& one = figures.all[m];
    page.rows.push_back(our_row(figures, m));
    page.chart->rows.push_back(suites::method_dot(one.method, one.collision_loss, 2));
  }
  return page;
}

report::PageTable replies_table(const std::vector<TimedModel>& timed) {
  report::PageTable page{
      .heading = "Table IV: replies",
      .lines =
          {"What SACA asks first in some draws of each table, up to three forecasts at once, put "
           "to the model by itself at real pace. A reply is done when it ends by itself or has "
           "as many tokens as it may; the local model may write 112. In time: from T2, or from "
           "when who threatens is first seen within it, to T1 of the same draw."},
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
    const ReplyTimes& times = one.times;
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

}  // namespace saca::paper_comparison
