#include "saca/lab/eval/model_score.h"

#include <algorithm>
#include <array>

#include "saca/base/core/contract.h"
#include "saca/lab/eval/calibration.h"

namespace saca::eval {
namespace {

constexpr std::array<ScoredChoice, 8> choices{
    {{"facts_at_once", "the model, at once", "saca_paper_at_once"},
     {"facts_reasoned", "the model, after reasoning", "saca_paper"},
     {"facts_checked", "the same, checked as SACA does", "saca_at_t1"},
     {"no_facts_at_once", "without our facts, at once", "saca_paper_no_facts_at_once"},
     {"no_facts_reasoned", "without our facts, after reasoning", "saca_paper_no_facts"},
     {"best_by_forecast", "the best forecast", "newest_forecast"},
     {"always_aeb", "always AEB", "aeb"},
     {"best_in_hindsight", "the best in hindsight", "oracle"}}};

std::size_t place_of(std::string_view method) {
  const auto* const found = std::find_if(choices.begin(), choices.end(),
                                         [&](const auto& one) { return one.method == method; });
  expects(found != choices.end(), "a method that is scored");
  return static_cast<std::size_t>(found - choices.begin());
}

std::optional<Calibration> calibration_of(std::span<const SuiteRow> rows) {
  const std::size_t reasoned = place_of("saca_paper");
  std::vector<JudgedAnswer> judged;
  for (const SuiteRow& row : rows) {
    if (!counts_in_figures(row) || row.risk.tried.empty()) {
      continue;
    }
    const auto& thinking = row.risk.runs[reasoned].thinking;
    if (thinking && thinking->answer) {
      judged.push_back({*thinking->answer, right_policies(row.risk)});
    }
  }
  return calibrated(judged);
}

}  // namespace

std::span<const ScoredChoice> scored_choices() {
  return choices;
}

std::vector<std::string> scored_methods() {
  std::vector<std::string> methods(choices.size());
  std::transform(choices.begin(), choices.end(), methods.begin(),
                 [](const ScoredChoice& one) { return one.method; });
  return methods;
}

ModelScore model_score(std::span<const SuiteRow> rows, std::uint64_t seed) {
  std::vector<const SuiteRow*> all;
  for (const SuiteRow& row : rows) {
    all.push_back(&row);
  }
  ModelScore score{.choices = suite_figures(all, scored_methods(), place_of("aeb"), seed),
                   .calibration = calibration_of(rows)};
  expects(!score.choices.empty(), "an encounter that could be played");
  return score;
}

}  // namespace saca::eval
