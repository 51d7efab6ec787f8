#include "saca/lab/eval/likely_places.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "saca/base/core/contract.h"

namespace saca::eval {
namespace {

constexpr double least_sd = 0.1;  // [m]: no place is known better, and no density is endless

std::vector<std::size_t> likeliest_first(std::span<const LikelyPlace> places) {
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return places[a].probability > places[b].probability;
  });
  return order;
}

}  // namespace

LikelyPlaces going_straight(const world::Actor& actor) {
  constexpr double unknown_acceleration = 1.0;  // [m/s^2]
  LikelyPlaces places;
  for (std::size_t i = 0; i < forecast_times.size(); ++i) {
    const double after = forecast_times[i];
    const double sd = std::hypot(actor.position_sd, actor.velocity_sd * after,
                                 0.5 * unknown_acceleration * after * after);
    places[i] = {{.p_W = actor.X_WA.p + after * actor.v_W,
                  .course = std::atan2(actor.v_W.y, actor.v_W.x),
                  .spread = {sd, sd}}};
  }
  return places;
}

PlaceScore score(std::span<const LikelyPlace> places, Vec2 truth) {
  expects(!places.empty(), "at least one place");
  const boost::math::normal standard;
  PlaceScore told{.miss = std::numeric_limits<double>::infinity()};
  double density = 0.0;
  for (const LikelyPlace& one : places) {
    const Vec2 off = rotated(truth - one.p_W, -one.course);
    const double along_sd = std::max(least_sd, one.spread.along_sd);
    const double across_sd = std::max(least_sd, one.spread.across_sd);
    const Vec2 z{off.x / along_sd, off.y / across_sd};
    density += one.probability * std::exp(-0.5 * dot(z, z)) /
               (2.0 * std::numbers::pi * along_sd * across_sd);
    told.pit_along += one.probability * cdf(standard, z.x);
    told.pit_across += one.probability * cdf(standard, z.y);
  }
  told.nll = -std::log(std::max(density, std::numeric_limits<double>::min()));
  constexpr std::size_t most = 6;
  const auto order = likeliest_first(places);
  for (std::size_t k = 0; k < std::min(most, order.size()); ++k) {
    told.miss = std::min(told.miss, norm(places[order[k]].p_W - truth));
  }
  return told;
}

double least_mean_miss(const LikelyPlaces& places,
                       const std::array<Vec2, forecast_times.size()>& truth, std::size_t most) {
  const auto order = likeliest_first(places.front());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < std::min(most, order.size()); ++k) {
    double sum = 0.0;
    for (std::size_t i = 0; i < forecast_times.size(); ++i) {
      sum += norm(places[i][order[k]].p_W - truth[i]);
    }
    least = std::min(least, sum / static_cast<double>(forecast_times.size()));
  }
  return least;
}

}  // namespace saca::eval
