#pragma once

#include "saca/base/world/scene.h"
#include "saca/base/world/track.h"
#include "saca/onboard/atlas/atlas.h"
#include "saca/onboard/manoeuvre/plan.h"

namespace saca::forecast {

/// How a way is written down.
struct WayForm {
  double step = 0.05;     ///< [s]
  double longest = 20.0;  ///< [s]; beyond a recovered lane a way goes on for 2 s
};
constexpr WayForm usual_way{};

/// The ego's way under a plan as the atlas has it, written over `X_WB` from scene.time on: what
/// others react to. Ask Atlas::outside first. Allocates nothing where there is room for
/// longest / step + 2 poses.
void atlas_way(const atlas::Atlas& atlas, const manoeuvre::Plan& plan, const world::Scene& scene,
               const WayForm& form, world::Track& X_WB);

}  // namespace saca::forecast
