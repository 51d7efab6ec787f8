#include "saca/lab/recordings/lane_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "saca/base/core/units.h"
#include "saca/lab/recordings/series.h"

namespace saca::recordings {
namespace {

constexpr double far_behind = 20.0;                                                        // [m]
constexpr std::array<double, 8> reaches{100.0, 80.0, 60.0, 50.0, 40.0, 30.0, 20.0, 15.0};  // [m]
constexpr double least_ahead = 15.0;                                                       // [m]
constexpr double good_fit = 0.3;                                                           // [m]
constexpr double poor_fit = 1.0;                                                           // [m]
constexpr double beside = 0.5;                 // outside a lanelet, but still on it [m]
constexpr double astray = from_degrees(60.0);  // from a lanelet's direction
constexpr std::size_t most_lanelets = 100;     // of a route, to each side
constexpr double tightest = 0.2;               // curvature [1/m]
constexpr double spacing = 1.0;                // of the fitted points [m]

/// The point at a share of the way from `a` to `b`.
Vec2 point_between(Vec2 a, Vec2 b, double share) {
  return a + share * (b - a);
}
double direction(Vec2 from, Vec2 to) {
  return std::atan2(to.y - from.y, to.x - from.x);
}
Vec2 middle(const Lanelet& lanelet, std::size_t k) {
  return 0.5 * (lanelet.left_W[k] + lanelet.right_W[k]);
}
double length_of(const Lanelet& lanelet) {
  double length = 0.0;
  for (std::size_t k = 1; k < lanelet.left_W.size(); ++k) {
    length += norm(middle(lanelet, k) - middle(lanelet, k - 1));
  }
  return length;
}

/// Nearest point of the segment from `a` to `b`, as a share of it.
double nearest_share(Vec2 a, Vec2 b, Vec2 p) {
  const Vec2 ab = b - a;
  const double square = dot(ab, ab);
  return square > 0.0 ? std::clamp(dot(p - a, ab) / square, 0.0, 1.0) : 0.0;
}

double distance_to(const std::vector<Vec2>& line_W, Vec2 p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < line_W.size(); ++k) {
    const double share = nearest_share(line_W[k - 1], line_W[k], p);
    nearest = std::min(nearest, norm(point_between(line_W[k - 1], line_W[k], share) - p));
  }
  return nearest;
}

/// A point seen from a lanelet's centre line.
struct Place {
  double distance = std::numeric_limits<double>::infinity();  ///< from the centre line [m]
  double along = 0.0;    ///< of the nearest point, from the lanelet's beginning [m]
  double heading = 0.0;  ///< of the centre line there [rad]
  double width = 0.0;    ///< of the lanelet there [m]
};

Place place_on(const Lanelet& lanelet, Vec2 p_W) {
  Place place;
  double before = 0.0;
  for (std::size_t k = 1; k < lanelet.left_W.size(); ++k) {
    const Vec2 a = middle(lanelet, k - 1);
    const Vec2 b = middle(lanelet, k);
    const double share = nearest_share(a, b, p_W);
    const double distance = norm(point_between(a, b, share) - p_W);
    if (distance < place.distance) {
      place = {distance, before + share * norm(b - a), direction(a, b),
               norm(point_between(lanelet.left_W[k - 1], lanelet.left_W[k], share) -
                    point_between(lanelet.right_W[k - 1], lanelet.right_W[k], share))};
    }
    before += norm(b - a);
  }
  return place;
}

bool is_on(const Place& place) {
  return place.distance <= 0.5 * place.width + beside;
}

std::size_t num_on(const Lanelet& lanelet, std::span<const Vec2> way_W) {
  return static_cast<std::size_t>(std::count_if(
      way_W.begin(), way_W.end(), [&](Vec2 p_W) { return is_on(place_on(lanelet, p_W)); }));
}

/// The lanelet in which somebody starts; nullptr when there is none.
const Lanelet* first_lanelet(const CommonRoad& file, const Pose& start_W,
                             std::span<const Vec2> way_W) {
  const Lanelet* best = nullptr;
  std::pair<std::size_t, double> best_score{0, 0.0};
  for (const Lanelet& lanelet : file.lanelets) {
    const Place place = place_on(lanelet, start_W.p);
    const double turned = std::abs(wrap_angle(start_W.yaw - place.heading));
    if (!is_on(place) || turned > astray) {
      continue;
    }
    // A metre off counts as much as a radian.
    const std::pair score{num_on(lanelet, way_W), -place.distance - turned};
    if (best == nullptr || score > best_score) {
      best = &lanelet;
      best_score = score;
    }
  }
  return best;
}

/// How much a lanelet turns from a heading to its far end.
double turn(const Lanelet& lanelet, double heading, bool forward) {
  const std::size_t last = lanelet.left_W.size() - 1;
  const double end = forward ? direction(middle(lanelet, last - 1), middle(lanelet, last))
                             : direction(middle(lanelet, 0), middle(lanelet, 1));
  return std::abs(wrap_angle(end - heading));
}

/// The one of several that holds more of the way, or the straightest.
const Lanelet* next_lanelet(const CommonRoad& file, const Lanelet& here,
                            std::span<const Vec2> way_W, bool forward) {
  const std::size_t last = here.left_W.size() - 1;
  const double heading = forward ? direction(middle(here, last - 1), middle(here, last))
                                 : direction(middle(here, 0), middle(here, 1));
  const Lanelet* best = nullptr;
  std::pair<std::size_t, double> best_score{0, 0.0};
  for (const std::int64_t id : forward ? here.successors : here.predecessors) {
    const Lanelet* const lanelet = find_lanelet(file, id);
    if (lanelet == nullptr) {
      continue;
    }
    const std::pair score{forward ? num_on(*lanelet, way_W) : 0, -turn(*lanelet, heading, forward)};
    if (best == nullptr || score > best_score) {
      best = lanelet;
      best_score = score;
    }
  }
  return best;
}

/// Lanelets in driving order, and where in them the start is.
struct Route {
  std::vector<const Lanelet*> lanelets;
  double start = 0.0;  ///< from the first lanelet's beginning [m]
};

/// Each lanelet is taken once: maps may run in circles.
Route route_from(const CommonRoad& file, const Lanelet& first, Vec2 start_W,
                 std::span<const Vec2> way_W) {
  Route route{{&first}, place_on(first, start_W).along};
  const auto is_end = [&route](const Lanelet* lanelet) {
    return lanelet == nullptr ||
           std::find(route.lanelets.begin(), route.lanelets.end(), lanelet) != route.lanelets.end();
  };
  double ahead = length_of(first) - route.start;
  while (ahead < reaches.front() && route.lanelets.size() < most_lanelets) {
    const Lanelet* const next = next_lanelet(file, *route.lanelets.back(), way_W, true);
    if (is_end(next)) {
      break;
    }
    route.lanelets.push_back(next);
    ahead += length_of(*next);
  }
  while (route.start < far_behind && route.lanelets.size() < 2 * most_lanelets) {
    const Lanelet* const before = next_lanelet(file, *route.lanelets.front(), {}, false);
    if (is_end(before)) {
      break;
    }
    route.lanelets.insert(route.lanelets.begin(), before);
    route.start += length_of(*before);
  }
  return route;
}

/// A point of the route's centre line.
struct Station {
  Vec2 p_W;
  double s = 0.0;  ///< from the start [m]
  const Lanelet* lanelet = nullptr;
};

std::vector<Station> stations_of(const Route& route) {
  std::vector<Station> stations;
  double before = 0.0;  // way to the segment's beginning
  double next = 0.0;    // way to the next station
  for (const Lanelet* const lanelet : route.lanelets) {
    for (std::size_t k = 1; k < lanelet->left_W.size(); ++k) {
      const Vec2 a = middle(*lanelet, k - 1);
      const Vec2 b = middle(*lanelet, k);
      const double length = norm(b - a);
      for (; next <= before + length && length > 0.0; next += spacing) {
        const double s = next - route.start;
        if (s >= -far_behind && s <= reaches.front()) {
          stations.push_back({point_between(a, b, (next - before) / length), s, lanelet});
        }
      }
      before += length;
    }
  }
  return stations;
}

/// Gauss-Newton on the distances of the stations from the arc.
world::Road fitted_arc(std::span<const Station> stations, Vec2 start_W) {
  const std::size_t last = stations.size() - 1;
  const double first_heading = direction(stations[0].p_W, stations[1].p_W);
  const double turned =
      wrap_angle(direction(stations[last - 1].p_W, stations[last].p_W) - first_heading);
  world::Road road;
  road.curvature = turned / (stations[last].s - stations[0].s);
  road.X_WL = {stations[0].p_W, first_heading};
  constexpr int most_rounds = 20;
  for (int round = 0; round < most_rounds; ++round) {
    Normal3 normal;
    for (const Station& station : stations) {
      const world::LanePose at = to_lane(road, {station.p_W, 0.0});
      normal.add({1.0, at.s, 0.5 * at.s * at.s}, at.d, 1.0);
    }
    const auto [offset, slope, bend] = normal.solution();
    road.X_WL = road.X_WL * Pose{{0.0, offset}, std::atan(slope)};
    road.curvature = std::clamp(road.curvature + bend, -tightest, tightest);
  }
  road.X_WL = from_lane(road, {to_lane(road, {start_W, 0.0}).s, 0.0, 0.0});
  return road;
}

double median(std::vector<double> values) {
  const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), half, values.end());
  return *half;
}

/// The outer bound of the last lanelet on one side.
struct Edge {
  const std::vector<Vec2>* bound_W;
  bool oncoming = false;  ///< the next lane leads the other way
};

Edge edge_of(const CommonRoad& file, const Lanelet& lanelet, bool left) {
  Edge edge{left ? &lanelet.left_W : &lanelet.right_W};
  const Lanelet* here = &lanelet;
  bool along = true;  // `here` leads as the first one does
  for (std::size_t lanes = 0; lanes < most_lanelets; ++lanes) {
    const bool here_left = left == along;
    const std::optional<Neighbour>& neighbour = here_left ? here->left : here->right;
    const Lanelet* const next = neighbour ? find_lanelet(file, neighbour->lanelet) : nullptr;
    if (next == nullptr) {
      break;
    }
    along = along == neighbour->same_direction;
    edge.oncoming = edge.oncoming || (lanes == 0 && !along);
    edge.bound_W = left == along ? &next->left_W : &next->right_W;
    here = next;
  }
  return edge;
}

/// Lane width, edges and oncoming lanes: medians over the stations, and most of them.
void measure_sides(const CommonRoad& file, std::span<const Station> stations, LaneFit& fit) {
  std::vector<double> width;
  std::vector<double> left;
  std::vector<double> right;
  std::size_t num_left = 0;
  std::size_t num_right = 0;
  for (const Station& station : stations) {
    const Lanelet& lanelet = *station.lanelet;
    width.push_back(distance_to(lanelet.left_W, station.p_W) +
                    distance_to(lanelet.right_W, station.p_W));
    const Edge left_edge = edge_of(file, lanelet, true);
    const Edge right_edge = edge_of(file, lanelet, false);
    left.push_back(distance_to(*left_edge.bound_W, station.p_W));
    right.push_back(-distance_to(*right_edge.bound_W, station.p_W));
    num_left += left_edge.oncoming ? 1U : 0U;
    num_right += right_edge.oncoming ? 1U : 0U;
  }
  fit.road.lane_width = median(width);
  fit.road.left_edge = median(left);
  fit.road.right_edge = median(right);
  fit.road.oncoming_left = 2 * num_left > stations.size();
  fit.road.oncoming_right = 2 * num_right > stations.size();
}

void measure_fit(std::span<const Station> stations, LaneFit& fit) {
  double sum = 0.0;
  fit.largest = 0.0;
  for (const Station& station : stations) {
    const double d = std::abs(to_lane(fit.road, {station.p_W, 0.0}).d);
    sum += d * d;
    fit.largest = std::max(fit.largest, d);
  }
  fit.rms = std::sqrt(sum / static_cast<double>(stations.size()));
}

Error no_lane(const std::string& wanted_and_got) {
  return {Error::Code::out_of_range, wanted_and_got};
}

/// The longest stretch on which the arc is good, or the shortest; not measured to the sides yet.
std::span<const Station> fit_stretch(std::span<const Station> all, Vec2 start_W, LaneFit& fit) {
  std::span<const Station> used;
  for (const double reach : reaches) {
    const auto first = std::find_if(all.begin(), all.end(), [reach](const Station& station) {
      return station.s >= -std::min(far_behind, 0.5 * reach);
    });
    const auto end = std::find_if(first, all.end(),
                                  [reach](const Station& station) { return station.s > reach; });
    used = {first, end};
    fit.road = fitted_arc(used, start_W);
    measure_fit(used, fit);
    if (fit.largest <= good_fit) {
      break;
    }
  }
  fit.behind = std::max(0.0, -used.front().s);
  fit.ahead = used.back().s;
  for (const Station& station : used) {
    if (fit.lanelets.empty() || fit.lanelets.back() != station.lanelet->id) {
      fit.lanelets.push_back(station.lanelet->id);
    }
  }
  return used;
}

/// Whether a scenario may have such a road.
bool is_usual(const world::Road& road) {
  constexpr double farthest_edge = 100.0;  // [m]
  return road.lane_width >= 2.0 && road.lane_width <= 8.0 && road.left_edge >= 0.5 &&
         road.left_edge <= farthest_edge && road.right_edge <= -0.5 &&
         road.right_edge >= -farthest_edge;
}

}  // namespace

Result<LaneFit> fit_lane(const CommonRoad& file, const Pose& start_W, std::span<const Vec2> way_W) {
  const Lanelet* const first = first_lanelet(file, start_W, way_W);
  if (first == nullptr) {
    return no_lane("want a start in a lanelet that leads the same way, got one in none");
  }
  const std::vector<Station> all = stations_of(route_from(file, *first, start_W.p, way_W));
  if (all.size() < 2 || all.back().s < least_ahead) {
    return no_lane("want 15 m of mapped lane ahead of the start, got less");
  }
  LaneFit fit;
  const std::span<const Station> used = fit_stretch(all, start_W.p, fit);
  if (!(fit.largest <= poor_fit) || std::abs(fit.road.curvature) >= tightest) {
    return no_lane("want a lane that an arc follows within 1 m for 15 m, got one that lies " +
                   std::to_string(fit.largest) + " m off");
  }
  measure_sides(file, used, fit);
  if (!is_usual(fit.road)) {
    return no_lane("want a lane 2 to 8 m wide and edges within 100 m, got a width of " +
                   std::to_string(fit.road.lane_width) + " m, edges at " +
                   std::to_string(fit.road.left_edge) + " and " +
                   std::to_string(fit.road.right_edge) + " m");
  }
  return fit;
}

}  // namespace saca::recordings
