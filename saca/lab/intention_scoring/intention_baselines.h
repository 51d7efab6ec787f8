#pragma once

#include <cstddef>
#include <span>

#include "saca/lab/intention_scoring/labels.h"
#include "saca/lab/intention_scoring/score.h"
#include "saca/lab/intention_scoring/sequence.h"
#include "saca/thinking/intent/crf.h"
#include "saca/thinking/intent/observation.h"

namespace saca::intention_scoring {

// Ways to predict that a model has to surpass. None looks at later frames.

/// Nobody does anything: M, for certain, now and later.
[[nodiscard]] Forecasts constant_motion(const Sequence& sequence);

/// The rule of the labels, applied while the motion comes in. It foresees nothing: what it says of
/// now it says of later, too.
struct CausalRule {
  LabelRule thresholds{};
  std::size_t smoothed = 3;  ///< over so many last frames that are known means are taken, >= 1
  double sure = 0.9;         ///< what the class that it names is given; the others share the rest
};

/// A motion to the side, or braking, begins when the mean of the last lateral speeds or
/// accelerations passes the label's threshold, and ends as the label's does. How far it will lead,
/// or whether it is undone, cannot be known yet.
/// @throws ContractViolation  if `smoothed` is 0 or `sure` no probability above 1/6
[[nodiscard]] Forecasts causal_rule(const Sequence& sequence, const CausalRule& rule = {});

/// Log emissions made by hand: how far the means of the last 0.3 s are beyond the label's
/// thresholds, as logits. Braking and either side are taken as independent.
/// @param history  up to now, at least one; only the last three count
[[nodiscard]] intent::Scores emissions_by_hand(std::span<const intent::Observation> history);

/// A chain over them: each class stays what it is with the probability `stays` from frame to frame,
/// all others that `intent::may_follow` allows share the rest.
struct HandMadeChain {
  double stays = 0.97;     ///< in (0, 1): acts last 3 s, an assumption
  double maintains = 0.9;  ///< share of M at the start, in (0, 1)
};

/// Forward pass of a conditional random field with these emissions and this chain: for now, and
/// carried on by the chain for 0.5 and 1 s.
[[nodiscard]] Forecasts crf_by_hand(const Sequence& sequence, const HandMadeChain& chain = {});

}  // namespace saca::intention_scoring
