#include "saca/lab/intention_study/evaluation.h"

#include <optional>
#include <utility>

#include "saca/lab/intention_scoring/calibration.h"
#include "saca/lab/intention_scoring/forecast_file.h"
#include "saca/lab/intention_scoring/intention_baselines.h"
#include "saca/lab/intention_scoring/predict.h"
#include "saca/lab/report/intention_chart.h"

namespace saca::intention_study {
namespace {

using intention_scoring::Forecasts;
using intention_scoring::ModelsByLeftOut;
using intention_scoring::Sequence;

/// Models whose chain is taken away: each frame by its emissions alone.
ModelsByLeftOut without_chains(ModelsByLeftOut models) {
  for (auto& [left_out, model] : models) {
    model.chains = {};
  }
  return models;
}

std::optional<Error> add_unseen(MethodComparison& comparison, const std::string& method,
                                const ModelsByLeftOut& models, const ScoredSet& scored,
                                int threads) {
  auto forecasts =
      intention_scoring::predicted_unseen(models, scored.sequences, scored.splits, threads);
  if (!forecasts.has_value()) {
    return forecasts.error();
  }
  comparison.add(method, std::move(forecasts).value());
  return std::nullopt;
}

std::optional<Error> add_closed(MethodComparison& comparison, const ModelsByLeftOut& models,
                                const ScoredSet& scored, int threads) {
  const ScoredSet closed = nothing_shared(scored);
  return add_unseen(comparison, "LSTM-CRF, nothing shared", models, closed, threads);
}

std::optional<Error> add_other_models(MethodComparison& comparison, const std::string& folder,
                                      const ScoredSet& scored, int threads) {
  const auto others = intention_scoring::read_models(folder);
  return others.has_value() ? add_unseen(comparison, "LSTM-CRF of another training", others.value(),
                                         scored, threads)
                            : others.error();
}

std::optional<Error> add_plain_models(MethodComparison& comparison, const std::string& folder,
                                      const ScoredSet& scored, int threads) {
  const auto plain = intention_scoring::read_models(folder);
  if (!plain.has_value()) {
    return plain.error();
  }
  const auto forecasts = intention_scoring::predicted_unseen(
      without_chains(plain.value()), scored.sequences, scored.splits, threads);
  if (!forecasts.has_value()) {
    return forecasts.error();
  }
  comparison.add("LSTM without CRF", intention_scoring::cross_calibrated(
                                         scored.sequences, scored.splits, forecasts.value()));
  return std::nullopt;
}

/// What needs neither a model nor a file.
void add_baselines(MethodComparison& comparison, const ScoredSet& scored) {
  const auto by = [&](auto&& predict) {
    std::vector<Forecasts> all;
    all.reserve(scored.sequences.size());
    for (const Sequence& sequence : scored.sequences) {
      all.push_back(predict(sequence));
    }
    return all;
  };
  comparison.add("CRF by hand",
                 by([](const Sequence& each) { return intention_scoring::crf_by_hand(each); }));
  comparison.add("causal rule",
                 by([](const Sequence& each) { return intention_scoring::causal_rule(each); }));
  comparison.add("constant motion", by(intention_scoring::constant_motion));
}

std::optional<Error> add_forecasts(MethodComparison& comparison, const std::string& file,
                                   const ScoredSet& scored) {
  const auto set = intention_scoring::read_forecasts(file);
  if (!set.has_value()) {
    return set.error();
  }
  const auto forecasts = intention_scoring::forecasts_of(set.value(), scored.sequences, file);
  if (!forecasts.has_value()) {
    return forecasts.error();
  }
  comparison.add(set.value().model, forecasts.value());
  comparison.add(
      set.value().model + ", calibrated as ours",
      intention_scoring::cross_calibrated(scored.sequences, scored.splits, forecasts.value()));
  return std::nullopt;
}

/// What was recorded, each by models that have not seen it, beside all baselines.
std::optional<Error> compare_recorded(MethodComparison& comparison, const ModelsByLeftOut& models,
                                      const Rivals& rivals, const ScoredSet& scored, int threads) {
  auto problem = add_unseen(comparison, "LSTM-CRF", models, scored, threads);
  if (!problem) {
    problem = add_closed(comparison, models, scored, threads);
  }
  if (!problem && !rivals.other_models.empty()) {
    problem = add_other_models(comparison, rivals.other_models, scored, threads);
  }
  if (!problem && !rivals.plain_models.empty()) {
    problem = add_plain_models(comparison, rivals.plain_models, scored, threads);
  }
  if (problem) {
    return problem;
  }
  add_baselines(comparison, scored);
  for (const std::string& file : rivals.forecasts) {
    if (auto failed = add_forecasts(comparison, file, scored)) {
      return failed;
    }
  }
  return std::nullopt;
}

Comparison finished(const MethodComparison& comparison) {
  return {.title = comparison.title(), .methods = comparison.methods()};
}

/// A site that some model has never seen: by that model, and by those of the cross-validation.
/// @return  nullopt: nothing was recorded there, or there is no cross-validation
std::optional<Comparison> transfer(const ModelsByLeftOut& models, const std::string& site,
                                   const intention_scoring::SequenceSet& set, std::uint64_t seed,
                                   int threads) {
  const ScoredSet scored = recorded_of(set, site);
  if (scored.sequences.empty()) {
    return std::nullopt;
  }
  MethodComparison comparison("Transfer: " + site, scored, intention_scoring::recorded_classes,
                              seed);
  if (add_unseen(comparison, "its site seen", models, scored, threads)) {
    return std::nullopt;
  }
  comparison.add("its site never seen",
                 intention_scoring::predicted(models.at(site), scored.sequences, threads));
  return finished(comparison);
}

}  // namespace

Result<Evaluation> evaluate(const intention_scoring::SequenceSet& set,
                            const ModelsByLeftOut& models, const Rivals& rivals, std::uint64_t seed,
                            int threads) {
  Evaluation evaluation;
  const ScoredSet recorded = recorded_of(set);
  MethodComparison first("Recorded vehicles, by models that have not seen them (M, LC, RC, FB)",
                         recorded, intention_scoring::recorded_classes, seed);
  if (const auto problem = compare_recorded(first, models, rivals, recorded, threads)) {
    return *problem;
  }
  evaluation.comparisons.push_back(finished(first));
  evaluation.displacements = first.displacements(intent::MotionLaw());
  const ScoredSet simulated = simulated_of(set);
  const auto whole = models.find("nothing");
  if (whole != models.end() && !simulated.sequences.empty()) {
    MethodComparison comparison("Simulated vehicles (LB, RB)", simulated,
                                intention_scoring::simulated_classes, seed);
    comparison.add("LSTM-CRF",
                   intention_scoring::predicted(whole->second, simulated.sequences, threads));
    evaluation.comparisons.push_back(finished(comparison));
  }
  for (const auto& [left_out, model] : models) {
    if (auto comparison = transfer(models, left_out, set, seed, threads)) {
      evaluation.comparisons.push_back(std::move(*comparison));
    }
  }
  return evaluation;
}

std::string confusion_svg(const Evaluation& evaluation) {
  const MethodFigures& ours = evaluation.comparisons.front().methods.front();
  return report::confusion_svg({.title = "Recorded vehicles, now",
                                .lines = {"By models that have not seen them."},
                                .counts = ours.figures.tallies[0].confusion.counts});
}

}  // namespace saca::intention_study
