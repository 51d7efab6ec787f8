#include "saca/lab/recordings/lane_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "saca/base/core/units.h"

namespace saca::recordings {
namespace {

constexpr double station_spacing = 1.0;           // of the centre line [m]
constexpr double most_stations = 5000.0;          // of a lanelet: maps may be broken
constexpr double run_on = 15.0;                   // into the lanelets before and after [m]
constexpr double heading_reach = 3.0;             // to either side [m]
constexpr double curvature_reach = 10.0;          // likewise
constexpr double other_way = from_degrees(60.0);  // a body leads another way than the lane
constexpr double end_rounding = 0.5;              // lanelets of a lane may leave a slit [m]
constexpr std::size_t most_hops = 3;              // lanelets passed between two samples
constexpr std::size_t most_lanelets_ahead = 64;   // maps may run in circles

Vec2 centre_point(const Lanelet& lanelet, std::size_t k) {
  return 0.5 * (lanelet.left_W[k] + lanelet.right_W[k]);
}

/// A line with its width, as the map has it.
struct RawLine {
  std::vector<Vec2> points_W;
  std::vector<double> width;
};

/// Without points that stand on the one before: they have no direction.
RawLine raw_line(const Lanelet& lanelet) {
  constexpr double same = 1e-3;  // [m]
  RawLine raw;
  for (std::size_t k = 0; k < lanelet.left_W.size(); ++k) {
    const Vec2 p_W = centre_point(lanelet, k);
    if (raw.points_W.empty() || norm(p_W - raw.points_W.back()) > same) {
      raw.points_W.push_back(p_W);
      raw.width.push_back(norm(lanelet.left_W[k] - lanelet.right_W[k]));
    }
  }
  return raw;
}

double end_direction(const RawLine& raw, bool at_end) {
  const std::size_t last = raw.points_W.size() - 1;
  const Vec2 d =
      at_end ? raw.points_W[last] - raw.points_W[last - 1] : raw.points_W[1] - raw.points_W[0];
  return std::atan2(d.y, d.x);
}

/// The point at a way along a line, beyond its ends straight on.
class Walker {
 public:
  explicit Walker(const std::vector<Vec2>& points_W) : points_(points_W), ways_{0.0} {
    for (std::size_t k = 1; k < points_.size(); ++k) {
      ways_.push_back(ways_.back() + norm(points_[k] - points_[k - 1]));
    }
  }
  [[nodiscard]] double length() const { return ways_.back(); }
  [[nodiscard]] double way_to(std::size_t point) const { return ways_[point]; }
  /// Segment and share of it.
  [[nodiscard]] std::pair<std::size_t, double> segment_at(double way) const {
    const auto after = std::upper_bound(ways_.begin() + 1, ways_.end() - 1, way);
    const auto k = static_cast<std::size_t>(after - ways_.begin()) - 1;
    return {k, (way - ways_[k]) / (ways_[k + 1] - ways_[k])};
  }
  [[nodiscard]] Vec2 at(double way) const {
    const auto [k, share] = segment_at(way);
    return points_[k] + share * (points_[k + 1] - points_[k]);
  }

 private:
  const std::vector<Vec2>& points_;
  std::vector<double> ways_;
};

/// Of several lanelets the one that turns least against `direction`.
const RawLine* straightest(const std::vector<RawLine>& raw, const std::vector<std::size_t>& choice,
                           double direction, bool ahead) {
  const RawLine* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t k : choice) {
    if (raw[k].points_W.size() < 2) {
      continue;
    }
    const double turned = std::abs(wrap_angle(end_direction(raw[k], !ahead) - direction));
    if (turned < least) {
      least = turned;
      best = &raw[k];
    }
  }
  return best;
}

/// A line run on into the lanelets before and after.
struct LongLine {
  std::vector<Vec2> points_W;
  std::size_t first = 0;  ///< of the lanelet's own points
};

/// Stations of a line before or after that are run on into.
int stations_to_run(const Walker& walker) {
  return static_cast<int>(std::min(run_on, walker.length()) / station_spacing);
}

LongLine long_line(const std::vector<RawLine>& raw, std::size_t which, const LaneMap::Line& line) {
  const RawLine& here = raw[which];
  LongLine made;
  if (const RawLine* const last =
          straightest(raw, line.predecessors, end_direction(here, false), false)) {
    const Walker walker(last->points_W);
    for (int k = stations_to_run(walker); k > 0; --k) {
      made.points_W.push_back(walker.at(walker.length() - k * station_spacing));
    }
  }
  made.first = made.points_W.size();
  made.points_W.insert(made.points_W.end(), here.points_W.begin(), here.points_W.end());
  if (const RawLine* const next =
          straightest(raw, line.successors, end_direction(here, true), true)) {
    const Walker walker(next->points_W);
    for (int k = 1; k <= stations_to_run(walker); ++k) {
      made.points_W.push_back(walker.at(k * station_spacing));
    }
  }
  return made;
}

void fill_stations(const std::vector<RawLine>& raw, std::size_t which, LaneMap::Line& line) {
  const RawLine& here = raw[which];
  const LongLine run = long_line(raw, which, line);
  const Walker inner(here.points_W);
  const Walker whole(run.points_W);
  const double before = whole.way_to(run.first);
  const auto heading_at = [&](double way) {
    const Vec2 d = whole.at(std::min(way + heading_reach, whole.length())) -
                   whole.at(std::max(way - heading_reach, 0.0));
    return std::atan2(d.y, d.x);
  };
  const auto num = static_cast<std::size_t>(
      std::clamp(std::ceil(inner.length() / station_spacing), 1.0, most_stations));
  for (std::size_t k = 0; k <= num; ++k) {
    const double way = inner.length() * static_cast<double>(k) / static_cast<double>(num);
    const auto [segment, share] = inner.segment_at(way);
    line.points_W.push_back(inner.at(way));
    line.along.push_back(way);
    line.width.push_back(here.width[segment] +
                         share * (here.width[segment + 1] - here.width[segment]));
    const double heading = heading_at(before + way);
    line.heading.push_back(line.heading.empty()
                               ? heading
                               : line.heading.back() + wrap_angle(heading - line.heading.back()));
    const double first = std::max(before + way - curvature_reach, 0.0);
    const double last = std::min(before + way + curvature_reach, whole.length());
    line.curvature.push_back(wrap_angle(heading_at(last) - heading_at(first)) / (last - first));
  }
}

void fill_box(LaneMap::Line& line) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  line.low_W = {inf, inf};
  line.high_W = {-inf, -inf};
  const double widest = *std::max_element(line.width.begin(), line.width.end());
  const double margin = 0.5 * widest + end_rounding;
  for (const Vec2 p_W : line.points_W) {
    line.low_W = {std::min(line.low_W.x, p_W.x - margin), std::min(line.low_W.y, p_W.y - margin)};
    line.high_W = {std::max(line.high_W.x, p_W.x + margin),
                   std::max(line.high_W.y, p_W.y + margin)};
  }
}

/// The step from a lane into one that lies right beside it, though the map does not say so; 0: the
/// lanes overlap, lie apart or lead apart.
int step_between(const LanePlace& from, const LanePlace& to) {
  constexpr double slit = 0.5;                     // between the bounds, or overlap [m]
  constexpr double parallel = from_degrees(10.0);  // of two lanes
  const double apart = from.offset - to.offset;    // > 0: the new lane is to the left
  const double wanted = 0.5 * (from.width + to.width);
  const bool adjacent = std::abs(std::abs(apart) - wanted) <= slit &&
                        std::abs(wrap_angle(from.heading - to.heading)) <= parallel;
  return !adjacent ? 0 : apart > 0.0 ? 1 : -1;
}

std::vector<std::size_t> indices_of(const std::vector<std::int64_t>& ids,
                                    const std::map<std::int64_t, std::size_t>& index) {
  std::vector<std::size_t> indices;
  for (const std::int64_t id : ids) {
    if (const auto found = index.find(id); found != index.end()) {
      indices.push_back(found->second);
    }
  }
  return indices;
}

std::optional<std::size_t> same_way_neighbour(const std::optional<Neighbour>& neighbour,
                                              const std::map<std::int64_t, std::size_t>& index) {
  if (!neighbour || !neighbour->same_direction) {
    return std::nullopt;
  }
  const auto found = index.find(neighbour->lanelet);
  return found == index.end() ? std::nullopt : std::optional<std::size_t>(found->second);
}

}  // namespace

LaneMap::LaneMap(const CommonRoad& file) {
  std::map<std::int64_t, std::size_t> index;
  std::vector<RawLine> raw;
  std::vector<const Lanelet*> used;
  for (const Lanelet& lanelet : file.lanelets) {
    RawLine line = raw_line(lanelet);
    if (line.points_W.size() >= 2) {  // one without length holds nobody
      index[lanelet.id] = raw.size();
      raw.push_back(std::move(line));
      used.push_back(&lanelet);
    }
  }
  for (std::size_t k = 0; k < raw.size(); ++k) {
    Line line;
    line.id = used[k]->id;
    line.predecessors = indices_of(used[k]->predecessors, index);
    line.successors = indices_of(used[k]->successors, index);
    line.left = same_way_neighbour(used[k]->left, index);
    line.right = same_way_neighbour(used[k]->right, index);
    fill_stations(raw, k, line);
    fill_box(line);
    lines_.push_back(std::move(line));
  }
}

std::optional<LanePlace> LaneMap::place_in(std::size_t lanelet, const Pose& X_WA,
                                           double beyond) const {
  const Line& line = lines_[lanelet];
  const Vec2 p_W = X_WA.p;
  if (!(p_W.x >= line.low_W.x - beyond && p_W.x <= line.high_W.x + beyond &&
        p_W.y >= line.low_W.y - beyond && p_W.y <= line.high_W.y + beyond)) {
    return std::nullopt;
  }
  std::size_t nearest = 0;
  double share = 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < line.points_W.size(); ++k) {
    const Vec2 ab = line.points_W[k + 1] - line.points_W[k];
    const double t = std::clamp(dot(p_W - line.points_W[k], ab) / dot(ab, ab), 0.0, 1.0);
    const double distance = norm(p_W - (line.points_W[k] + t * ab));
    if (distance < least) {
      least = distance;
      nearest = k;
      share = t;
    }
  }
  const auto mixed = [&](const std::vector<double>& values) {
    return values[nearest] + share * (values[nearest + 1] - values[nearest]);
  };
  LanePlace place;
  place.lanelet = lanelet;
  place.along = mixed(line.along);
  place.width = mixed(line.width);
  place.curvature = mixed(line.curvature);
  const Vec2 ab = line.points_W[nearest + 1] - line.points_W[nearest];
  const Vec2 off = p_W - (line.points_W[nearest] + share * ab);
  const Vec2 along_W = (1.0 / norm(ab)) * ab;
  const bool is_left = along_W.x * off.y - along_W.y * off.x >= 0.0;
  place.offset = is_left ? least : -least;
  place.heading = wrap_angle(X_WA.yaw - mixed(line.heading));
  const bool past_end = std::abs(dot(along_W, off)) > end_rounding;
  if (past_end || !(place.width > 0.0) || !(least <= 0.5 * place.width + beyond) ||
      !(std::abs(place.heading) <= other_way)) {
    return std::nullopt;
  }
  return place;
}

std::vector<LanePlace> LaneMap::places(const Pose& X_WA, double beyond) const {
  std::vector<LanePlace> found;
  for (std::size_t k = 0; k < lines_.size(); ++k) {
    if (const std::optional<LanePlace> place = place_in(k, X_WA, beyond)) {
      found.push_back(*place);
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const LanePlace& a, const LanePlace& b) {
    return std::abs(a.offset) < std::abs(b.offset);
  });
  return found;
}

std::vector<std::size_t> LaneMap::lane_from(std::size_t lanelet) const {
  std::vector<std::size_t> lane{lanelet};
  std::size_t first = 0;
  for (std::size_t hop = 0; hop < most_hops; ++hop) {
    for (const std::size_t end = lane.size(); first < end; ++first) {
      for (const std::size_t next : lines_[lane[first]].successors) {
        if (std::find(lane.begin(), lane.end(), next) == lane.end()) {
          lane.push_back(next);
        }
      }
    }
  }
  return lane;
}

LaneSighting LaneMap::follow(const std::optional<LanePlace>& before, const Pose& X_WA) const {
  const std::vector<std::size_t> lane =
      before ? lane_from(before->lanelet) : std::vector<std::size_t>{};
  std::optional<LanePlace> kept;
  for (const std::size_t lanelet : lane) {
    const std::optional<LanePlace> place = place_in(lanelet, X_WA, lane_hold);
    constexpr double rounding = 1e-9;  // [m]: equals go to the first, where it was
    if (place && (!kept || std::abs(place->offset) < std::abs(kept->offset) - rounding)) {
      kept = place;
    }
  }
  if (kept) {
    return {kept, 0};
  }
  for (const std::size_t lanelet : lane) {
    for (const int step : {1, -1}) {
      const std::optional<std::size_t> beside =
          step > 0 ? lines_[lanelet].left : lines_[lanelet].right;
      const auto place = beside ? place_in(*beside, X_WA, 0.0) : std::nullopt;
      if (place) {
        return {place, step};
      }
    }
  }
  const std::vector<LanePlace> found = places(X_WA);
  if (found.empty()) {
    return {};
  }
  LaneSighting sighting{found.front(), 0};
  for (const std::size_t lanelet : lane) {
    const std::optional<LanePlace> left_behind = place_in(lanelet, X_WA, found.front().width);
    if (left_behind && sighting.lane_step == 0) {
      sighting.lane_step = step_between(*left_behind, found.front());
    }
  }
  return sighting;
}

LaneMap::Way LaneMap::way_ahead(const LanePlace& from, double reach) const {
  Way way{{{from.lanelet, -from.along}}, reach};
  for (std::size_t k = 0; k < way.lanelets.size(); ++k) {
    const Ahead here = way.lanelets[k];
    const Line& line = lines_[here.lanelet];
    const double end = here.way + line.length();
    if (end >= reach) {
      continue;
    }
    if (line.successors.empty()) {
      way.end = std::min(way.end, end);
    }
    for (const std::size_t next : line.successors) {
      const bool known = std::any_of(way.lanelets.begin(), way.lanelets.end(),
                                     [next](const Ahead& a) { return a.lanelet == next; });
      if (!known && way.lanelets.size() < most_lanelets_ahead) {
        way.lanelets.push_back({next, end});
      }
    }
  }
  return way;
}

}  // namespace saca::recordings
