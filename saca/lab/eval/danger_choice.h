#pragma once

#include <cstdint>
#include <vector>

#include "saca/base/world/scene.h"
#include "saca/lab/learned_danger/network.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/preview/expected_harm.h"
#include "saca/thinking/preview/forecast_facts.h"

/// Choosing by V_h, for the ladder: what it is worth where something must be chosen.
namespace saca::eval {

/// V_h beside several obstacles.
enum class Beside : std::uint8_t {
  each,  ///< the highest of all, each by itself
  all,   ///< of the three most dangerous together
};

/// The plan of the least Q_h (preview::plan_danger) among some, where all others go on as they do;
/// of equal ones the first.
/// @param plans  one or more, all of which can be driven
[[nodiscard]] manoeuvre::Plan of_least_danger(const world::Scene& scene,
                                              const std::vector<manoeuvre::Plan>& plans,
                                              const manoeuvre::Car& car,
                                              const learned_danger::Network& network,
                                              Beside beside);

/// Those that can be driven.
[[nodiscard]] std::vector<manoeuvre::Plan> drivable_plans(const manoeuvre::Car& car,
                                                          const world::Scene& scene);

/// Those whose expected harm forecasts cannot tell from the least (reflex::admits).
/// Emergency braking, where none can be driven.
[[nodiscard]] std::vector<manoeuvre::Plan> admissible_plans(
    const std::vector<preview::ExpectedHarm>& all);

}  // namespace saca::eval
