#include "saca/lab/intention_study/method_comparison.h"

#include <utility>

namespace saca::intention_study {

using intention_scoring::Sequence;

ScoredSet recorded_of(const intention_scoring::SequenceSet& set, const std::string& site) {
  ScoredSet found;
  for (std::size_t i = 0; i < set.sequences.size(); ++i) {
    const Sequence& sequence = set.sequences[i];
    if (!sequence.simulated && (site.empty() || sequence.site == site)) {
      found.sequences.push_back(sequence);
      found.splits.push_back(set.splits[i]);
    }
  }
  return found;
}

ScoredSet simulated_of(const intention_scoring::SequenceSet& set) {
  ScoredSet found;
  for (std::size_t i = 0; i < set.sequences.size(); ++i) {
    if (set.sequences[i].simulated && set.splits[i] == "test") {
      found.sequences.push_back(set.sequences[i]);
      found.splits.push_back(set.splits[i]);
    }
  }
  return found;
}

ScoredSet nothing_shared(ScoredSet scored) {
  for (Sequence& sequence : scored.sequences) {
    for (intent::Observation& seen : sequence.observations) {
      seen.steering = seen.throttle = seen.brake = intent::not_known;
    }
  }
  return scored;
}

MethodComparison::MethodComparison(std::string title, const ScoredSet& scored,
                                   std::span<const std::size_t> classes, std::uint64_t seed)
    : title_(std::move(title)), scored_(scored), classes_(classes), seed_(seed) {}

void MethodComparison::add(const std::string& method,
                           std::vector<intention_scoring::Forecasts> forecasts) {
  MethodFigures row{
      .method = method,
      .figures = intention_scoring::figures_of(scored_.sequences, forecasts, classes_, seed_),
      .macro_f1_difference = {},
      .log_loss_difference = {}};
  if (methods_.empty()) {
    ours_ = std::move(forecasts);
  } else {
    for (std::size_t head = 0; head < intention_scoring::num_heads; ++head) {
      row.macro_f1_difference[head] = intention_scoring::macro_f1_difference(
          scored_.sequences, ours_, forecasts, head, classes_, seed_);
      row.log_loss_difference[head] =
          intention_scoring::log_loss_difference(scored_.sequences, ours_, forecasts, head, seed_);
    }
  }
  methods_.push_back(std::move(row));
}

intention_scoring::Displacements MethodComparison::displacements(
    const intent::MotionLaw& law) const {
  intention_scoring::Displacements sum;
  for (std::size_t i = 0; i < ours_.size(); ++i) {
    sum += intention_scoring::displacements(scored_.sequences[i], ours_[i], law);
  }
  return sum;
}

}  // namespace saca::intention_study
