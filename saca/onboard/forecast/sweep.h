#pragma once

#include <span>

#include "saca/base/core/static_vector.h"
#include "saca/base/world/scene.h"
#include "saca/base/world/track.h"
#include "saca/onboard/forecast/atlas_ego.h"
#include "saca/onboard/forecast/broad_phase.h"
#include "saca/onboard/forecast/contact_forecast.h"

namespace saca::forecast {

/// One for each actor.
using ContactForecasts = StaticVector<ContactForecast, world::max_actors>;

/// The ego and all others: when do they meet, how near do they come, how likely is it?
///
/// @param tracks        one for each actor of the scene
/// @param samples         of the tracks, from where the ego is at the scene's time
/// @param spreads       likewise, about them, or none at all: as perceived
/// @param of_interest   larger clearances are not told apart [m]
/// @param until         what comes later does not matter [s since the scene's time]
/// @return              for each actor. Where the ego touches anybody, clearances are not looked
///                      for; else that of who comes nearest is told, of others no more than needed
///                      to know that they do not. What follows a sure contact is left out
///
/// Contact and clearance at the mean: steps that the gap along its own direction allows, but for at
/// least 10 ms: shorter touches may be missed. Probability: at the likeliest instant, normal errors
/// of the actor's place (which grow with its velocity's) and of the ego's under wrong grip against
/// the gap along whichever axis of either body makes contact least likely: they touch when they do
/// along all. It is the chance of one instant, not of all of them together.
[[nodiscard]] ContactForecasts meetings(const AtlasEgo& ego, std::span<const world::Track> tracks,
                                        std::span<const PoseSamples> samples,
                                        std::span<const world::SpreadOverTime> spreads,
                                        double of_interest, double until) noexcept;

}  // namespace saca::forecast
