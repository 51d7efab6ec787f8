#pragma once

#include "saca/outcome/atlas_ego.h"
#include "saca/outcome/contact_forecast.h"
#include "saca/outcome/edge.h"

namespace saca::outcome {

/// The ego on a way out of the atlas and one edge of the road: when it is crossed; `gap` is the
/// clearance to it. Looked at where the atlas has samples.
/// @param of_interest  larger clearances are not told apart [m]
[[nodiscard]] ContactForecast edge_contact_forecast(const AtlasEgo& ego, Side side,
                                                    double of_interest) noexcept;

}  // namespace saca::outcome
