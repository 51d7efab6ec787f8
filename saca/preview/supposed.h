#pragma once

#include "saca/core/static_vector.h"
#include "saca/intent/cue_law.h"
#include "saca/intent/observer.h"
#include "saca/world/scene.h"

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
/// side where the cue is; it is in the middle of the lane when the ego's front is there, if the ego
/// goes on as it does. It is known to a second of its way, 2 m at most: it may come sooner or
/// later. Each supposition has the probability of the law; where they sum to more than
/// `most_likely`, all are that much less likely. Cues that the ego has passed or reaches only after
/// `longest_ahead` suppose nothing, nor does one near which somebody of its kind moves and is seen
/// (within `seen_near`: that is who it stands for), nor one that a full scene has no room for.
/// @param beliefs  one per actor
/// @throws ContractViolation  if beliefs and actors differ in number
[[nodiscard]] Suppositions suppositions(const world::Scene& scene, const intent::Beliefs& beliefs,
                                        const intent::CueLaw& law);

/// All suppositions together count at most so much [-].
constexpr double most_likely = 0.5;
/// How far ahead cues are looked at [s].
constexpr double longest_ahead = 4.0;
/// Who moves so near to a cue is no longer supposed but seen [m]: assumption.
constexpr double seen_near = 12.0;

}  // namespace saca::preview
