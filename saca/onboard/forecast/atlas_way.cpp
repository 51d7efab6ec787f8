#include "saca/onboard/forecast/atlas_way.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/onboard/forecast/atlas_ego.h"

namespace saca::forecast {

void atlas_way(const atlas::Atlas& atlas, const manoeuvre::Plan& plan, const world::Scene& scene,
               const WayForm& form, world::Track& X_WB) {
  expects(form.step > 0.0 && form.longest >= 0.0, "step > 0, longest >= 0");
  constexpr double after_recovery = 2.0;  // [s], as collision_sequence looks on
  const atlas::AtlasPath path = atlas.path(plan, scene);
  const AtlasEgo ego(path, scene);
  const double end = std::min(path.end + (path.rests ? 0.0 : after_recovery), form.longest);
  const auto num_steps = static_cast<int>(std::ceil(end / form.step - 1e-9));
  X_WB.start = scene.time;
  X_WB.step = form.step;
  X_WB.X_WA.clear();
  for (int k = 0; k <= num_steps; ++k) {
    X_WB.X_WA.push_back(ego.at(k * form.step).X_WB);
  }
}

}  // namespace saca::forecast
