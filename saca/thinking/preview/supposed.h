#pragma once

#include "saca/base/core/static_vector.h"
#include "saca/base/world/scene.h"
#include "saca/thinking/intent/cue_law.h"
#include "saca/thinking/intent/observer.h"

namespace saca::preview {

/// How a scene may be besides how it is seen, by one of its cues.
struct Supposition {
  double probability = 0.0;  ///< in (0, most_likely]
  world::Scene scene;        ///< with whoever may come, or with the grip that may be there
  intent::Beliefs beliefs;   ///< one per actor of it
  bool is_slippery = false;  ///< less grip, and nobody more
};

using Suppositions = StaticVector<Supposition, world::max_cues>;

/// What may be there besides what is seen, by the cues of a scene: one after the other, never two
/// together. Nobody who is seen is changed.
///
/// Whoever may come is a usual body of its kind on a straight way across the ego's lane, from the
/// side where the cue is; when the ego's front is there, if the ego goes on as it does, it is
/// half-way between the cue and the middle of the lane, known as what is even between the two (0.5
/// to 2 m). Each supposition has the probability of the law; where they sum to more than
/// `most_likely`, all are that much less likely. Nobody is supposed by a cue that the ego has
/// passed or reaches only after `longest_ahead`; who would have come out by now, because then he
/// would be seen; where one of his kind is seen to come from there (within `least_reach` and what
/// he covers in `seen_before`); and where a scene has no room. It may be slippery from the cue on
/// for `slippery_for`.
/// @param beliefs  one per actor
/// @throws ContractViolation  if beliefs and actors differ in number
[[nodiscard]] Suppositions suppositions(const world::Scene& scene, const intent::Beliefs& beliefs,
                                        const intent::CueLaw& law);

/// All suppositions together count at most so much [-].
constexpr double most_likely = 0.5;
/// How far ahead cues are looked at [s].
constexpr double longest_ahead = 4.0;
// Assumptions:
constexpr double least_reach = 6.0;    ///< [m]
constexpr double seen_before = 1.5;    ///< [s]
constexpr double slippery_for = 60.0;  ///< [m]

}  // namespace saca::preview
