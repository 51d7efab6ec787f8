#include "saca/lab/regulation/regulation_page.h"

#include <fmt/core.h>

#include <algorithm>

#include "saca/base/core/units.h"
#include "saca/lab/eval/methods.h"
#include "saca/lab/regulation/constant_in_words.h"

namespace saca::regulation {
namespace {

using eval::LimitKind;

/// What a cell came to, in words: not by colour alone.
std::string words_for(const RegulationRun& run, std::size_t cell, const RegulationResult& result) {
  const eval::CellResult& judged = result.judged;
  if (!judged.passed()) {
    return "FAILS: " + failure_of(judged);
  }
  if (judged.impact_speed > 0.0) {
    return fmt::format("passes: {:.1f} m/s", judged.impact_speed);
  }
  if (run.row_of(cell).limit == LimitKind::deceleration) {
    return fmt::format("passes: {:.2f} g", judged.peak_deceleration / from_g(1.0));
  }
  return result.plan && manoeuvre::side(result.plan->policy) != 0
             ? fmt::format("passes: {}", manoeuvre::name(result.plan->policy))
             : "passes";
}

/// 0: passed; a failure is seen at once, and the deeper the faster the impact.
double shade_of(const RegulationRun& run, std::size_t cell, const RegulationResult& result) {
  constexpr double failed = 0.45;
  if (result.judged.passed()) {
    return 0.0;
  }
  const double share = result.judged.impact_speed / run.cells[cell].speed;
  return std::clamp(failed + (1.0 - failed) * share, failed, 1.0);
}

std::string allowed(const eval::RegulationRow& row) {
  switch (row.limit) {
    case LimitKind::no_contact:
      return "Nobody may be touched.";
    case LimitKind::impact_speed:
      return "In brackets the largest impact speed that is allowed, in km/h.";
    case LimitKind::deceleration:
      return fmt::format("The car may decelerate by less than {:.2f} g.",
                         row.peak_deceleration / from_g(1.0));
    case LimitKind::no_intervention:
      return "Nobody may act: there is no risk.";
  }
  return "";
}

std::string column_of(const eval::RegulationCell& cell) {
  return cell.impact_speed
             ? fmt::format("{} ({:.0f})", eval::label_of(cell), to_kmh(*cell.impact_speed))
             : eval::label_of(cell);
}

report::PageTable table_of(const RegulationRun& run, std::size_t row) {
  const eval::RegulationRow& of = run.regulation.rows[row];
  report::PageTable table{
      .heading = of.title,
      .lines = {fmt::format("{}: {}. {}", run.regulation.name, of.paragraph, allowed(of))},
      .columns = {},
      .rows = {}};
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < run.cells.size(); ++i) {
    if (run.cells[i].row == row) {
      cells.push_back(i);
      table.columns.push_back(column_of(run.cells[i]));
    }
  }
  for (std::size_t m = 0; m < run.methods.size(); ++m) {
    for (std::size_t k = 0; k < run.cars.size(); ++k) {
      report::PageTable::Row line{
          .name = fmt::format("{}, {}", eval::find_method(run.methods[m])->title, run.cars[k]),
          .explanation = "",
          .cells = {},
          .shades = {},
          .faded = eval::find_method(run.methods[m])->knows_truth};
      for (const std::size_t i : cells) {
        line.cells.push_back(words_for(run, i, run.at(k, i, m)));
        line.shades.emplace_back(shade_of(run, i, run.at(k, i, m)));
      }
      table.rows.push_back(std::move(line));
    }
  }
  return table;
}

std::string share_of(const PassCount& sum) {
  return fmt::format("{} of {}", sum.passed, sum.all);
}

report::PageTable summary_of(const RegulationRun& run) {
  report::PageTable table{.heading = "How many tests each passes",
                          .lines = {"The text asks for all of them."},
                          .columns = run.cars,
                          .rows = {}};
  table.columns.emplace_back("all");
  for (std::size_t m = 0; m < run.methods.size(); ++m) {
    const eval::MethodInfo& info = *eval::find_method(run.methods[m]);
    report::PageTable::Row line{.name = std::string(info.title),
                                .explanation = std::string(info.what),
                                .cells = {},
                                .shades = {},
                                .faded = info.knows_truth};
    for (std::size_t k = 0; k <= run.cars.size(); ++k) {
      const PassCount sum = passed_by(
          run, {.method = m, .car = k < run.cars.size() ? std::optional(k) : std::nullopt});
      line.cells.push_back(share_of(sum));
      line.shades.emplace_back(static_cast<double>(sum.failed()) / sum.all);
    }
    table.rows.push_back(std::move(line));
  }
  return table;
}

}  // namespace

report::SuitePage page_of(const RegulationRun& run) {
  report::SuitePage page;
  const eval::TestSurface& surface = run.regulation.surfaces[run.regulation.surface];
  page.title = run.regulation.title;
  page.lines = constant_in_words(run);
  page.lines.push_back(fmt::format(
      "{} tests with each of {} cars. Perception is exact and nothing is left to chance, so that "
      "this is the best that can be hoped for on a proving ground; SACA has neither language model "
      "nor memory here. Test surface: friction coefficient {} ({}).",
      run.cells.size(), run.cars.size(), surface.grip, surface.source));
  page.lines.push_back(
      fmt::format("Who gets by without braking by {:.1f} m/s2 at least has not done what the text "
                  "asks ({}); who brakes and steers too has, and the cell names the policy.",
                  run.regulation.least_braking, run.regulation.least_braking_source));
  page.tables.push_back(summary_of(run));
  for (std::size_t r = 0; r < run.regulation.rows.size(); ++r) {
    page.tables.push_back(table_of(run, r));
  }
  for (const std::string& note : run.regulation.notes) {
    page.footnotes.push_back(note);
  }
  for (const auto& [key, value] : run.meta.items()) {
    page.footnotes.push_back(key.substr(key.find('.') + 1) + ": " + value.get<std::string>());
  }
  for (std::size_t k = 0; k < run.cars.size(); ++k) {
    for (std::size_t i = 0; i < run.cells.size(); ++i) {
      for (std::size_t m = 0; m < run.methods.size(); ++m) {
        if (const std::string& fault = run.at(k, i, m).fault; !fault.empty()) {
          page.footnotes.push_back(fmt::format("{}, {}, {}, {}: {}", run.methods[m], run.cars[k],
                                               run.row_of(i).name, eval::label_of(run.cells[i]),
                                               fault));
        }
      }
    }
  }
  return page;
}

}  // namespace saca::regulation
