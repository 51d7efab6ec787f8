#pragma once

#include "saca/onboard/forecast/broad_phase.h"
#include "saca/onboard/forecast/contact_forecast.h"
#include "saca/onboard/forecast/narrow_phase.h"

namespace saca::forecast {

/// When contact is likeliest, and how likely then: at each instant the normal distribution at the
/// largest number of standard deviations of the gap along any axis; of all instants at the
/// smallest. Sets probability; where it is not negligible and the mean misses, also touch and
/// brought_W: the other's whole way is displaced by the mean of those errors that make them touch
/// at that instant, and the impact is where the displaced way first touches the ego, at the speed
/// that closes there. (At the mean they pass each other, so that no speed closes.)
/// @param near   filled for the window
/// @param found  its contact is known
void find_likeliest(const NarrowPhase& pair, const Window& window, const PairSamples& near,
                    ContactForecast& found) noexcept;

}  // namespace saca::forecast
