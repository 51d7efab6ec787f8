#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/intention_scoring/displacement.h"
#include "saca/lab/intention_scoring/evaluation.h"
#include "saca/lab/intention_scoring/sequence_file.h"
#include "saca/lab/intention_study/method_comparison.h"

namespace saca::intention_study {

/// What our models are held against, besides what needs no file.
struct Rivals {
  std::string plain_models;  ///< folder of models trained without the CRF, not calibrated; or empty
  std::string other_models;  ///< folder of models of another training, as they are; or empty
  std::vector<std::string> forecasts;  ///< files of other models' forecasts (saca.forecasts/1)
};

/// Several ways to predict on the same sequences.
struct Comparison {
  std::string title;
  std::vector<MethodFigures> methods;  ///< ours first, at least one
};

/// What of intentions is recognised.
struct Evaluation {
  std::vector<Comparison> comparisons;  ///< first of all that was recorded
  intention_scoring::Displacements
      displacements;  ///< where our forecasts say that recorded vehicles will be
};

/// Scores models on what they have not seen: recorded vehicles beside all baselines; simulated ones
/// by the model that has left out "nothing"; each site by the model that has never seen it, beside
/// those that have.
/// @param seed     of the groups that are drawn for intervals
/// @param threads  >= 1; the result is the same for any number
/// @return  what `intention_scoring::predicted_unseen` says of a model that is missing; what cannot
/// be read
///          of the rivals
[[nodiscard]] Result<Evaluation> evaluate(const intention_scoring::SequenceSet& set,
                                          const intention_scoring::ModelsByLeftOut& models,
                                          const Rivals& rivals, std::uint64_t seed, int threads);

/// What was said of recorded vehicles by our own models, for now, as a picture.
[[nodiscard]] std::string confusion_svg(const Evaluation& evaluation);

}  // namespace saca::intention_study
