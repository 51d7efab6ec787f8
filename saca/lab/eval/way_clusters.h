#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "saca/base/core/vec2.h"
#include "saca/base/world/road.h"
#include "saca/lab/eval/likely_places.h"

namespace saca::eval {

/// One way on that was drawn: where it leads at each of forecast_times, along the road and to the
/// left in the direction of travel [m].
using SampledWay = std::array<Vec2, forecast_times.size()>;

/// How many clusters there are at most: as many as count in the least miss of a forecast.
constexpr std::size_t num_way_clusters = 6;

/// Many weighted ways as a few likely places: normal laws with mean and variances of clusters.
///
/// Lloyd's algorithm (k-means) on the places of the last two times, a metre to the side counting as
/// much as three along; it begins with the mean, and then always with the way that is farthest
/// from all centres, weighted. Ten rounds; nothing is drawn.
/// @param weights    one per way, >= 0; they sum to 1, and so do the probabilities
/// @param direction  of travel: 1 along the road, -1 against it
[[nodiscard]] LikelyPlaces clustered_places(const std::vector<SampledWay>& ways,
                                            const std::vector<double>& weights,
                                            const world::Road& road, double direction);

}  // namespace saca::eval
