#include "saca/lab/suites/suite_sentences.h"

#include <fmt/core.h>

#include "saca/lab/eval/estimate_text.h"
#include "saca/lab/eval/methods.h"
#include "saca/lab/suites/decisions.h"
#include "saca/lab/suites/method_list.h"

namespace saca::suites {
namespace {

using eval::Estimate;
using eval::MethodFigures;
using eval::SuiteRow;

/// How often the first method does less, the same, or more harm than another.
std::string counted(const SuiteRun& run, std::size_t method, std::size_t other) {
  int better = 0;
  int worse = 0;
  int all = 0;
  for (const SuiteRow& row : run.rows) {
    if (counts_in_figures(row)) {
      const double more = row.risk.runs[method].harm - row.risk.runs[other].harm;
      better += more < -eval::material ? 1 : 0;
      worse += more > eval::material ? 1 : 0;
      ++all;
    }
  }
  return fmt::format(
      "In {} of {} encounters it does materially less harm (by more than {}), in {} materially "
      "more, in the rest about the same.",
      better, all, eval::material, worse);
}

/// The first method held against emergency braking.
std::string against_braking(const MethodFigures& first, const MethodFigures& aeb) {
  const double more = first.over_aeb.value;
  const bool same = first.over_aeb.low == 0.0 && first.over_aeb.high == 0.0;
  return fmt::format(
      "{} does {:.4f} harm per encounter, emergency braking at T1 {:.4f}: {} (difference {} per "
      "encounter, paired, 95 % interval).",
      title_of(first.method), first.harm.value, aeb.harm.value,
      same                             ? "the same"
      : !eval::is_sure(first.over_aeb) ? "the difference may be chance"
      : more < 0                       ? "it is better"
                                       : "it is worse",
      with_interval(first.over_aeb, 4));
}

std::string where_it_is_better(const SuiteResult& result) {
  std::string where_better;
  std::string where_worse;
  for (const auto& [family, figures] : result.families) {
    if (figures.empty()) {
      continue;
    }
    const Estimate& over = figures.front().over_aeb;
    std::string& where = over.high < 0.0 ? where_better : where_worse;
    if (eval::is_sure(over)) {
      where += (where.empty() ? "" : ", ") + fmt::format("{} ({:+.4f})", family, over.value);
    }
  }
  return fmt::format("Better than braking in: {}. Worse in: {}.",
                     where_better.empty() ? "no family" : where_better,
                     where_worse.empty() ? "no family" : where_worse);
}

/// Who of those that a road allows loses least; nullptr: nobody of them was run.
const MethodFigures* least_regret(const SuiteResult& result) {
  const MethodFigures* best = nullptr;
  for (const MethodFigures& one : result.all) {
    if (!eval::find_method(one.method)->knows_truth &&
        (best == nullptr || one.regret.value < best->regret.value)) {
      best = &one;
    }
  }
  return best;
}

}  // namespace

std::vector<std::string> sentences_of(const SuiteRun& run, const SuiteResult& result) {
  const MethodFigures& first = result.all.front();
  std::vector<std::string> lines;
  const auto at = index_of(run.methods, "aeb");
  if (at && first.method != "aeb") {
    lines.push_back(against_braking(first, result.all[*at]));
    lines.push_back(counted(run, 0, *at));
    lines.push_back(where_it_is_better(result));
  }
  lines.push_back(fmt::format(
      "Regret, the harm above that of the best of all plans begun at T1, is {:.4f} for {}. 0.005 "
      "harm is half a per cent of a severely injured person.",
      first.regret.value, title_of(first.method)));
  if (const MethodFigures* const best = least_regret(result)) {
    lines.push_back(fmt::format("Of all methods that a road allows, {} has the least: {:.4f}.",
                                title_of(best->method), best->regret.value));
  }
  if (first.expected) {
    lines.push_back(expectations_text(first));
  }
  return lines;
}

}  // namespace saca::suites
