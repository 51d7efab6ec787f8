#pragma once

#include "saca/onboard/collision/edge.h"
#include "saca/onboard/forecast/atlas_ego.h"
#include "saca/onboard/forecast/contact_forecast.h"

namespace saca::forecast {

/// The ego on a way out of the atlas and one edge of the road: when it is crossed; `gap` is the
/// clearance to it. Looked at where the atlas has samples.
/// @param of_interest  larger clearances are not told apart [m]
[[nodiscard]] ContactForecast edge_contact_forecast(const AtlasEgo& ego, collision::Side side,
                                                    double of_interest) noexcept;

}  // namespace saca::forecast
