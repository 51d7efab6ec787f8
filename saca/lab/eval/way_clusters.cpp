#include "saca/lab/eval/way_clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "saca/base/core/contract.h"

namespace saca::eval {
namespace {

/// How far apart two ways end: a metre to the side counts as much as three along.
double squared_distance(const SampledWay& a, const SampledWay& b) {
  double sum = 0.0;
  for (const std::size_t k : {forecast_times.size() - 2, forecast_times.size() - 1}) {
    const Vec2 off = a[k] - b[k];
    sum += off.x * off.x / 9.0 + off.y * off.y;
  }
  return sum;
}

/// Clusters of ways by Lloyd's algorithm, begun with the way nearest to the mean and then always
/// the one farthest from all others. Which cluster each way is in.
std::vector<std::size_t> clustered(const std::vector<SampledWay>& ways,
                                   const std::vector<double>& weights, std::size_t num_clusters) {
  constexpr int rounds = 10;
  const auto mean_of = [&](const auto& counts) {
    SampledWay mean{};
    double sum = 0.0;
    for (std::size_t i = 0; i < ways.size(); ++i) {
      if (counts(i)) {
        sum += weights[i];
        for (std::size_t k = 0; k < mean.size(); ++k) {
          mean[k] = mean[k] + weights[i] * ways[i][k];
        }
      }
    }
    for (Vec2& each : mean) {
      each = (1.0 / std::max(sum, std::numeric_limits<double>::min())) * each;
    }
    return std::pair(mean, sum);
  };
  std::vector<SampledWay> centres{mean_of([](std::size_t) { return true; }).first};
  std::vector<double> nearest(ways.size(), std::numeric_limits<double>::infinity());
  while (centres.size() < num_clusters) {
    std::size_t farthest = 0;
    for (std::size_t i = 0; i < ways.size(); ++i) {
      nearest[i] = std::min(nearest[i], squared_distance(ways[i], centres.back()));
      farthest = nearest[i] * weights[i] > nearest[farthest] * weights[farthest] ? i : farthest;
    }
    centres.push_back(ways[farthest]);
  }
  std::vector<std::size_t> cluster(ways.size(), 0);
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < ways.size(); ++i) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t c = 0; c < centres.size(); ++c) {
        const double far = squared_distance(ways[i], centres[c]);
        if (far < least) {
          least = far;
          cluster[i] = c;
        }
      }
    }
    for (std::size_t c = 0; c < centres.size(); ++c) {
      const auto [mean, sum] = mean_of([&](std::size_t i) { return cluster[i] == c; });
      centres[c] = sum > 0.0 ? mean : centres[c];
    }
  }
  return cluster;
}

}  // namespace

LikelyPlaces clustered_places(const std::vector<SampledWay>& ways,
                              const std::vector<double>& weights, const world::Road& road,
                              double direction) {
  expects(!ways.empty() && ways.size() == weights.size(), "a weight for each way");
  constexpr double least_spread = 0.1;  // [m]
  const std::vector<std::size_t> cluster = clustered(ways, weights, num_way_clusters);
  LikelyPlaces places;
  for (std::size_t c = 0; c < num_way_clusters; ++c) {
    double sum = 0.0;
    SampledWay first{};
    SampledWay second{};
    for (std::size_t i = 0; i < ways.size(); ++i) {
      if (cluster[i] != c) {
        continue;
      }
      sum += weights[i];
      for (std::size_t k = 0; k < first.size(); ++k) {
        const Vec2 p = ways[i][k];
        first[k] = first[k] + weights[i] * p;
        second[k] = second[k] + weights[i] * Vec2{p.x * p.x, p.y * p.y};
      }
    }
    if (sum <= 0.0) {
      continue;
    }
    for (std::size_t k = 0; k < first.size(); ++k) {
      const Vec2 mean = (1.0 / sum) * first[k];
      const Vec2 variance = {second[k].x / sum - mean.x * mean.x,
                             second[k].y / sum - mean.y * mean.y};
      const Pose X_WL = world::from_lane(road, {.s = direction * mean.x, .d = direction * mean.y});
      places[k].push_back(
          {.probability = sum,
           .p_W = X_WL.p,
           .course = X_WL.yaw + (direction < 0.0 ? std::numbers::pi : 0.0),
           .spread = {std::hypot(std::sqrt(std::max(0.0, variance.x)), least_spread),
                      std::hypot(std::sqrt(std::max(0.0, variance.y)), least_spread)}});
    }
  }
  return places;
}

}  // namespace saca::eval
