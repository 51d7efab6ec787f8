#pragma once

#include <vector>

#include "saca/outcome/outcome.h"
#include "saca/world/scene.h"
#include "saca/world/track.h"

namespace saca::preview {

/// How the others move in a forecast that begins in `scene`: those who follow in the ego's path
/// (world::is_follower) are usual drivers, content with the gap that they have, and react to what
/// is ahead of them, the ego first; everyone else keeps to its track.
///
/// @param tracks  one per actor of the scene
/// @throws ContractViolation  if tracks and actors differ in number
[[nodiscard]] outcome::Others with_reacting_followers(const world::Scene& scene,
                                                      std::vector<world::Track> tracks);

}  // namespace saca::preview
