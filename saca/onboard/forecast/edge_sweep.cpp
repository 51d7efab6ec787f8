#include "saca/onboard/forecast/edge_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "saca/base/world/footprint.h"
#include "saca/onboard/collision/false_position.h"
#include "saca/onboard/forecast/narrow_phase.h"

namespace saca::forecast {
namespace {

using atlas::atlas_samples;
using world::Footprint;
using world::Shape;

double sign_of(collision::Side side) noexcept {
  return side == collision::Side::left ? 1.0 : -1.0;
}
double edge_of(const world::Road& road, collision::Side side) noexcept {
  return side == collision::Side::left ? road.left_edge : -road.right_edge;
}

// How far the ego reaches beyond its offset to one side.
double reach_aside(const Footprint& body, double cosine, double sine, double sign) noexcept {
  const Vec2 half = half_axes(body);
  const Vec2 across{half.x * sine, half.y * cosine};
  const double most = body.shape == Shape::ellipse ? std::sqrt(dot(across, across))
                                                   : std::abs(across.x) + std::abs(across.y);
  return most + sign * body.centre_x * sine;
}

// The clearance between the ego and an edge.
double edge_clearance_at(const AtlasEgo& ego, collision::Side side, double time) noexcept {
  const world::Road& road = ego.scene().road;
  if (road.curvature != 0.0) {
    return collision::edge_clearance(road, side, ego.scene().ego_footprint, ego.at(time).X_WB);
  }
  const world::LanePose pose = ego.in_lane(time);
  return edge_of(road, side) - sign_of(side) * pose.d -
         reach_aside(ego.scene().ego_footprint, std::cos(pose.heading), std::sin(pose.heading),
                     sign_of(side));
}

// The clearance at the samples of its path: exact to a millimetre where the road is straight, in a
// bend to what an arc bulges over the length of the body.
using AtlasRow = std::array<float, atlas_samples>;
AtlasRow sample_clearances(const AtlasEgo& ego, collision::Side side) noexcept {
  const atlas::AtlasPath& path = ego.path();
  const Footprint& body = ego.scene().ego_footprint;
  const auto sign = static_cast<float>(sign_of(side));
  const Vec2 half = half_axes(body);
  const auto half_x = static_cast<float>(half.x);
  const auto half_y = static_cast<float>(half.y);
  const auto ahead = sign * static_cast<float>(body.centre_x);
  const auto edge =
      static_cast<float>(edge_of(ego.scene().road, side) - sign_of(side) * path.start_d);
  const bool round = body.shape == Shape::ellipse;
  AtlasRow clearances;
  for (std::size_t i = 0; i < atlas_samples; ++i) {
    const float sine = ego.directions().sine[i];
    const float x = half_x * sine;
    const float y = half_y * ego.directions().cosine[i];
    const float most = round ? std::sqrt(x * x + y * y) : std::abs(x) + std::abs(y);
    clearances[i] = edge - sign * path.channel[1][i] - most - ahead * sine;
  }
  return clearances;
}

// By how much the clearance may be less than it is at the samples: an arc's bulge, and what lies
// between two.
double sample_margin(const AtlasEgo& ego) noexcept {
  const double reach = ego.samples().reach + std::abs(ego.scene().ego_footprint.centre_x);
  return 0.05 + std::abs(ego.path().curvature) * reach * reach;
}

// What the grip's standard deviation adds towards one side, at the samples of the path's
// sensitivity to friction.
struct SideSensitivity {
  std::array<float, atlas::sensitivity_samples> mean{};
  std::array<float, atlas::sensitivity_samples> variance{};
  double most = 0.0;        // [m]
  double per_second = 0.0;  // samples
  bool any = false;
};
SideSensitivity side_sensitivity(const AtlasEgo& ego, collision::Side side) noexcept {
  const atlas::AtlasPath& path = ego.path();
  SideSensitivity sensitivity;
  sensitivity.any = ego.scene().grip_sd > 0.0 && path.sensitivity_span > 0.0;
  if (!sensitivity.any) {
    return sensitivity;
  }
  const auto of_less = static_cast<float>(sign_of(side) * ego.grip_shares().less);
  const auto of_more = static_cast<float>(sign_of(side) * ego.grip_shares().more);
  float most = 0.0F;
  for (std::size_t i = 0; i < atlas::sensitivity_samples; ++i) {
    const float less = of_less * path.sensitivity[1][i];
    const float more = of_more * path.sensitivity[4][i];
    sensitivity.mean[i] = 0.3989423F * (less + more);  // as of_halves
    sensitivity.variance[i] = std::max(
        0.0F, 0.5F * (less * less + more * more) - sensitivity.mean[i] * sensitivity.mean[i]);
    most = std::max(most, std::max(std::abs(less), std::abs(more)));
  }
  sensitivity.most = static_cast<double>(most);
  sensitivity.per_second = (atlas::sensitivity_samples - 1) / path.sensitivity_span;
  return sensitivity;
}

// How many standard deviations of the clearance are left at a time.
double edge_score(const SideSensitivity& sensitivity, double time, double gap) noexcept {
  constexpr double least_sd_aside = 1e-5;  // [m]
  double mean = 0.0;
  double variance = 0.0;
  if (sensitivity.any) {
    const double place =
        std::min(time * sensitivity.per_second, atlas::sensitivity_samples - 1.001);
    const auto i = static_cast<std::size_t>(place);
    const double share = place - static_cast<double>(i);
    const auto between = [&](const auto& row) {
      const auto low = static_cast<double>(row[i]);
      return low + share * (static_cast<double>(row[i + 1]) - low);
    };
    mean = between(sensitivity.mean);
    variance = between(sensitivity.variance);
  }
  return (gap - mean) / std::sqrt(std::max(variance, least_sd_aside * least_sd_aside));
}

}  // namespace

ContactForecast edge_contact_forecast(const AtlasEgo& ego, collision::Side side,
                                      double of_interest) noexcept {
  ContactForecast found{.clearance = of_interest};
  const atlas::AtlasPath& path = ego.path();
  const AtlasRow clearances = sample_clearances(ego, side);
  const SideSensitivity sensitivity = side_sensitivity(ego, side);
  const auto matters =
      static_cast<float>(sample_margin(ego) + std::max(of_interest, sure_sd * sensitivity.most));
  if (*std::min_element(clearances.begin(), clearances.end()) > matters) {
    return found;
  }
  const bool bends = ego.scene().road.curvature != 0.0;
  const double step = path.span / static_cast<double>(atlas_samples - 1);
  double best = std::numeric_limits<double>::infinity();
  const auto look = [&](double before, double time, double gap) {
    if (gap <= 0.0 && !found.contact) {
      found.contact = time > 0.0
                          ? collision::last_positive(
                                {before, edge_clearance_at(ego, side, before), time, gap}, 1e-5,
                                1e-5, [&](double at) { return edge_clearance_at(ego, side, at); })
                          : time;
    }
    if (gap < found.clearance) {
      found.clearance = std::max(0.0, gap);
      found.nearest_at = time;
    }
    const double score = edge_score(sensitivity, time, gap);
    if (score < best) {
      best = score;
      found.touch = time;
    }
  };
  std::size_t i = 0;
  for (; i < atlas_samples && static_cast<double>(i) * step < path.end; ++i) {
    const double time = static_cast<double>(i) * step;
    const bool open = sensitivity.any || !found.contact;
    if (open && clearances[i] <= matters) {
      look(time - step, time,
           bends ? edge_clearance_at(ego, side, time) : static_cast<double>(clearances[i]));
    }
  }
  look(static_cast<double>(std::max<std::size_t>(i, 1) - 1) * step, path.end,
       edge_clearance_at(ego, side, path.end));
  found.probability = sensitivity.any ? 0.5 * std::erfc(best * std::sqrt(0.5))
                      : found.contact ? 1.0
                                      : 0.0;
  return found;
}

}  // namespace saca::forecast
