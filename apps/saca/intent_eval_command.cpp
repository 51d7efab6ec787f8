#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/intent_commands.h"
#include "apps/saca/intent_figures.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/base/core/file.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/report/intention_chart.h"
#include "saca/lab/training/calibration.h"
#include "saca/lab/training/displacement.h"
#include "saca/lab/training/evaluation.h"
#include "saca/lab/training/forecast_file.h"
#include "saca/lab/training/intention_baselines.h"
#include "saca/lab/training/predict.h"
#include "saca/lab/training/sequence_file.h"

namespace saca::app {
namespace {

using nlohmann::json;
using training::Forecasts;
using training::ModelsByLeftOut;
using training::Sequence;

struct EvalOptions {
  std::string sequences;
  std::string models;
  std::string plain_models;
  std::string other_models;
  std::vector<std::string> forecasts;
  std::string svg;
  unsigned long seed = 1;
  bool as_json = false;
};

/// Sequences that are scored together.
struct ScoredSet {
  std::vector<Sequence> sequences;
  std::vector<std::string> splits;
};

ScoredSet chosen(const training::SequenceSet& set, bool simulated, const std::string& site = "") {
  ScoredSet found;
  for (std::size_t i = 0; i < set.sequences.size(); ++i) {
    const Sequence& sequence = set.sequences[i];
    const bool is_test = simulated ? set.splits[i] == "test" : !sequence.simulated;
    if (sequence.simulated == simulated && is_test && (site.empty() || sequence.site == site)) {
      found.sequences.push_back(sequence);
      found.splits.push_back(set.splits[i]);
    }
  }
  return found;
}

/// Everything that is compared on the same sequences; ours comes first.
class Comparison {
 public:
  Comparison(std::string title, const ScoredSet& scored, std::span<const std::size_t> classes,
             std::uint64_t seed)
      : title_(std::move(title)), scored_(scored), classes_(classes), seed_(seed) {}

  void add(const std::string& method, std::vector<Forecasts> forecasts) {
    Row row{.method = method,
            .figures = training::figures_of(scored_.sequences, forecasts, classes_, seed_),
            .macro_f1_difference = {},
            .log_loss_difference = {}};
    if (rows_.empty()) {
      ours_ = std::move(forecasts);
    } else {
      for (std::size_t head = 0; head < training::num_heads; ++head) {
        row.macro_f1_difference[head] = training::macro_f1_difference(
            scored_.sequences, ours_, forecasts, head, classes_, seed_);
        row.log_loss_difference[head] =
            training::log_loss_difference(scored_.sequences, ours_, forecasts, head, seed_);
      }
    }
    rows_.push_back(std::move(row));
  }

  void tell() const {
    tell_table(title_, rows_);
    tell_confusion(rows_.front());
    tell_acts(rows_.front());
    for (const Row& row : rows_) {
      tell_difference(row);
    }
  }
  /// Where our own forecasts say that vehicles will be.
  [[nodiscard]] training::Displacements displacements(const intent::MotionLaw& law) const {
    training::Displacements sum;
    for (std::size_t i = 0; i < ours_.size(); ++i) {
      sum += training::displacements(scored_.sequences[i], ours_[i], law);
    }
    return sum;
  }
  /// Of our own forecasts of now.
  [[nodiscard]] std::string confusion_svg() const {
    return report::confusion_svg({.title = "Recorded vehicles, now",
                                  .lines = {"By models that have not seen them."},
                                  .counts = rows_.front().figures.tallies[0].confusion.counts});
  }
  [[nodiscard]] json as_json() const {
    json methods = json::array();
    for (const Row& row : rows_) {
      methods.push_back(row_json(row));
    }
    return {{"title", title_}, {"methods", methods}};
  }

 private:
  std::string title_;
  const ScoredSet& scored_;
  std::span<const std::size_t> classes_;
  std::uint64_t seed_;
  std::vector<Forecasts> ours_;
  std::vector<Row> rows_;
};

/// The same without what the vehicles tell of their controls: no pedals, no steering.
ScoredSet nothing_shared(ScoredSet scored) {
  for (Sequence& sequence : scored.sequences) {
    for (intent::Observation& seen : sequence.observations) {
      seen.steering = seen.throttle = seen.brake = intent::not_known;
    }
  }
  return scored;
}

/// Models whose chain is taken away: each frame by its emissions alone.
ModelsByLeftOut without_chains(ModelsByLeftOut models) {
  for (auto& [left_out, model] : models) {
    model.chains = {};
  }
  return models;
}

std::optional<Error> add_unseen(Comparison& comparison, const std::string& method,
                                const ModelsByLeftOut& models, const ScoredSet& scored) {
  auto forecasts =
      training::predicted_unseen(models, scored.sequences, scored.splits, usual_threads());
  if (!forecasts.has_value()) {
    return forecasts.error();
  }
  comparison.add(method, std::move(forecasts).value());
  return std::nullopt;
}

/// What was recorded, each by models that have not seen it, beside all baselines.
std::optional<Error> compare_recorded(const EvalOptions& options, const ModelsByLeftOut& models,
                                      const ScoredSet& scored, Comparison& comparison) {
  if (auto problem = add_unseen(comparison, "LSTM-CRF", models, scored)) {
    return problem;
  }
  const ScoredSet closed = nothing_shared(scored);
  auto of_closed =
      training::predicted_unseen(models, closed.sequences, closed.splits, usual_threads());
  if (!of_closed.has_value()) {
    return of_closed.error();
  }
  comparison.add("LSTM-CRF, nothing shared", std::move(of_closed).value());
  if (!options.other_models.empty()) {
    const auto others = training::read_models(options.other_models);
    if (!others.has_value()) {
      return others.error();
    }
    if (auto problem =
            add_unseen(comparison, "LSTM-CRF of another training", others.value(), scored)) {
      return problem;
    }
  }
  if (!options.plain_models.empty()) {
    const auto plain = training::read_models(options.plain_models);
    if (!plain.has_value()) {
      return plain.error();
    }
    const auto forecasts = training::predicted_unseen(
        without_chains(plain.value()), scored.sequences, scored.splits, usual_threads());
    if (!forecasts.has_value()) {
      return forecasts.error();
    }
    comparison.add("LSTM without CRF",
                   training::cross_calibrated(scored.sequences, scored.splits, forecasts.value()));
  }
  const auto by = [&](auto&& predict) {
    std::vector<Forecasts> all;
    all.reserve(scored.sequences.size());
    for (const Sequence& sequence : scored.sequences) {
      all.push_back(predict(sequence));
    }
    return all;
  };
  comparison.add("CRF by hand",
                 by([](const Sequence& each) { return training::crf_by_hand(each); }));
  comparison.add("causal rule",
                 by([](const Sequence& each) { return training::causal_rule(each); }));
  comparison.add("constant motion", by(training::constant_motion));
  for (const std::string& file : options.forecasts) {
    const auto set = training::read_forecasts(file);
    if (!set.has_value()) {
      return set.error();
    }
    const auto forecasts = training::forecasts_of(set.value(), scored.sequences, file);
    if (!forecasts.has_value()) {
      return forecasts.error();
    }
    comparison.add(set.value().model, forecasts.value());
    comparison.add(set.value().model + ", calibrated as ours",
                   training::cross_calibrated(scored.sequences, scored.splits, forecasts.value()));
  }
  return std::nullopt;
}

/// Sites that some model has never seen: by that model, and by those of the cross-validation.
std::vector<Comparison> compare_transfer(const ModelsByLeftOut& models,
                                         const training::SequenceSet& set,
                                         std::vector<std::unique_ptr<ScoredSet>>& kept,
                                         std::uint64_t seed) {
  std::vector<Comparison> all;
  for (const auto& [left_out, model] : models) {
    auto scored = std::make_unique<ScoredSet>(chosen(set, false, left_out));
    if (scored->sequences.empty()) {
      continue;
    }
    Comparison comparison("Transfer: " + left_out, *scored, training::recorded_classes, seed);
    if (!add_unseen(comparison, "its site seen", models, *scored)) {
      comparison.add("its site never seen",
                     training::predicted(model, scored->sequences, usual_threads()));
      all.push_back(std::move(comparison));
      kept.push_back(std::move(scored));
    }
  }
  return all;
}

int evaluate(EvalOptions options) {
  if (options.models.empty()) {
    const auto places = find_places();
    if (!places.has_value()) {
      return refused(places.error());
    }
    options.models = (places.value().root / "models" / "intent").string();
  }
  const auto set = training::read_sequences(options.sequences);
  if (!set.has_value()) {
    return refused(set.error());
  }
  if (const auto problem = long_work::why_outputs_unwritable({options.svg})) {
    return refused(*problem);
  }
  const auto models = training::read_models(options.models);
  if (!models.has_value()) {
    return refused(models.error());
  }
  const ScoredSet recorded = chosen(set.value(), false);
  std::vector<Comparison> comparisons;
  comparisons.emplace_back("Recorded vehicles, by models that have not seen them (M, LC, RC, FB)",
                           recorded, training::recorded_classes, options.seed);
  if (const auto problem =
          compare_recorded(options, models.value(), recorded, comparisons.front())) {
    return refused(*problem);
  }
  if (!options.svg.empty()) {
    if (const auto problem =
            long_work::write_output(options.svg, comparisons.front().confusion_svg())) {
      return refused(*problem);
    }
  }
  const training::Displacements moved = comparisons.front().displacements(intent::MotionLaw());
  const ScoredSet simulated = chosen(set.value(), true);
  const auto whole = models.value().find("nothing");
  if (whole != models.value().end() && !simulated.sequences.empty()) {
    comparisons.emplace_back("Simulated vehicles (LB, RB)", simulated, training::simulated_classes,
                             options.seed);
    comparisons.back().add(
        "LSTM-CRF", training::predicted(whole->second, simulated.sequences, usual_threads()));
  }
  std::vector<std::unique_ptr<ScoredSet>> kept;
  for (Comparison& each : compare_transfer(models.value(), set.value(), kept, options.seed)) {
    comparisons.push_back(std::move(each));
  }
  json document = {{"schema", "saca.intent_eval/1"}, {"comparisons", json::array()}};
  for (const Comparison& each : comparisons) {
    options.as_json ? document["comparisons"].push_back(each.as_json()) : each.tell();
  }
  if (options.as_json) {
    document["displacements"] = displacements_json(moved);
    app::print_json(document);
  } else {
    tell_displacements(moved);
  }
  return success;
}

}  // namespace

void add_intent_eval(CLI::App& intent, int& exit_code) {
  CLI::App* const command = intent.add_subcommand(
      "eval", "Score models of intentions on what they have not seen, beside baselines");
  const auto options = std::make_shared<EvalOptions>();
  command->add_option("sequences", options->sequences, "HDF5 file of `saca intent examples`")
      ->required();
  command->add_option("--models", options->models,
                      "Folder of weights, one per part left out; default: the shipped ones");
  command->add_option("--plain-models", options->plain_models,
                      "Likewise, trained without the CRF and not calibrated, for comparison");
  command->add_option("--other-models", options->other_models,
                      "Folder of weights of another training, as they are, for comparison");
  command->add_option("--forecasts", options->forecasts,
                      "Forecasts of other models (saca.forecasts/1), for comparison");
  command->add_option("--svg", options->svg, "A picture of the confusion of recorded vehicles");
  command->add_option("--seed", options->seed, "Of the groups drawn for intervals")
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = evaluate(*options); });
}

}  // namespace saca::app
