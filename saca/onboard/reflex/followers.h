#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "saca/base/core/static_vector.h"
#include "saca/base/world/scene.h"
#include "saca/base/world/track.h"
#include "saca/onboard/collision/outcome.h"
#include "saca/onboard/drivers/driver.h"

namespace saca::reflex {

/// How long followers are watched beyond the ego's own motion [s]: any reaction and a firm stop.
constexpr double watched_after = 3.0;

/// Those who follow in the ego's path (world::is_follower): indices of the scene's actors, the
/// nearest to the ego first.
using Followers = StaticVector<std::size_t, world::max_actors>;
[[nodiscard]] Followers followers_of(const world::Scene& scene);

/// Who drives a follower: a usual driver, content with the gap that there is now.
/// @param seen  whom it looks at
/// @param step  of its driving [s], > 0
[[nodiscard]] drivers::DriverLaw content_follower(const world::Scene& scene,
                                                  const world::Actor& actor,
                                                  std::span<const drivers::Present> seen,
                                                  double step);

/// How the followers move when the ego moves so: they are usual drivers, content with the gap that
/// they have, and react to the ego and to one another. What is ahead of the ego, they do not look
/// at: it takes time, and could but make them slower.
///
/// @param X_WB    the ego from scene.time on
/// @param until   of the followers' tracks [s]
/// @param step    likewise [s]
/// @param tracks  one per actor of the scene; those of the followers are written over. Allocates
///                nothing where they have room for (until - scene.time) / step + 2 poses
/// @throws ContractViolation  if tracks and actors differ in number
void let_react(const world::Scene& scene, const Followers& followers, const world::Track& X_WB,
               double until, double step, std::span<world::Track> tracks);

/// The scene with what is not known of the followers' places: what was perceived of them, for as
/// long as they react. Who keeps a gap sees how large it is, so that neither a speed that was
/// perceived wrongly nor a manner of driving carries it away.
[[nodiscard]] world::Scene with_kept_gaps(world::Scene scene, const Followers& followers);

/// How the others move in a forecast that begins in `scene`: the followers react likewise, but to
/// everybody; everyone else keeps to its track.
///
/// @param tracks  one per actor of the scene
/// @throws ContractViolation  if tracks and actors differ in number
[[nodiscard]] collision::Others with_reacting_followers(const world::Scene& scene,
                                                        std::vector<world::Track> tracks);

}  // namespace saca::reflex
