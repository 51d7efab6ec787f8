#include "saca/memory/similarity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "saca/core/angle.h"
#include "saca/core/contract.h"

namespace saca::memory {
namespace {

using world::ActorKind;
using world::Beyond;

// Scales: what, alone, makes a difference of 1. Fitted, but for those marked assumed: in the
// encounters that they were fitted to, these hardly differ (docs/decisions/0029-experience.md).
constexpr double sideways_scale = 1.0;  // of the ego, across [m/s], assumed
constexpr double offset_scale = 1.0;    // of the ego in its lane [m], assumed
constexpr double heading_scale = 0.2;   // [rad], assumed
constexpr double yaw_rate_scale = 0.3;  // [rad/s], assumed
constexpr double ego_size_scale = 2.0;  // [m], assumed
constexpr double lane_scale = 1.0;      // its width [m], assumed
constexpr double curve_scale = 2.0;     // [m/s^2], assumed
constexpr double room_scale = 3.0;      // [m]
constexpr double ample_room = 7.0;      // [m]
constexpr double other_ground = 2.0;    // soft instead of hard beyond an edge that is at hand
constexpr double other_marking = 1.25;  // oncoming traffic or not
constexpr double other_topology = 4.0;
// Of an actor. Where it will be across the lane in 1 s counts most: it hits or misses.
constexpr double along_now_scale = 6.0;      // [m]
constexpr double across_now_scale = 4.0;     // [m]
constexpr double across_then_scale = 0.7;    // in 1 s, at constant velocity [m]
constexpr double along_then_scale = 8.0;     // in 2 s, likewise [m]
constexpr double speed_along_scale = 3.5;    // [m/s]
constexpr double speed_across_scale = 4.5;   // [m/s]
constexpr double acceleration_scale = 1.25;  // across the lane [m/s^2]
constexpr double edge_scale = 0.6;           // of half its length or width [m]
constexpr double turned_scale = 4.0;         // of the ends of its body [m]
constexpr double other_kind = 0.4;           // of the same group
constexpr double other_group = 1.0;
constexpr double absence_share = 0.75;  // of its threat, which is at most 4

// An actor's absence is a `full_threat` where it touches ground that the ego can reach, and 1 where
// it stays a lane's width away from it.
constexpr double full_threat = 4.0;
constexpr double lane = 3.5;              // [m]
constexpr double gravity = 9.80665;       // [m/s^2]
constexpr double swerve_share = 0.6;      // of grip, as mean sideways acceleration of a lane change
constexpr int num_threat_samples = 13;    // 3 s: a stop from 25 m/s on a dry road
constexpr double threat_interval = 0.25;  // [s]

constexpr double square(double x) {
  return x * x;
}

bool is_hard(Beyond beyond) {
  return beyond == Beyond::barrier || beyond == Beyond::trees;
}

/// Actors of one group can stand in for each other when a manoeuvre is chosen.
int group(ActorKind kind) {
  switch (kind) {
    case ActorKind::car:
    case ActorKind::van:
    case ActorKind::truck:
      return 0;
    case ActorKind::motorcycle:
    case ActorKind::bicycle:
      return 1;
    case ActorKind::pedestrian:
      return 2;
    case ActorKind::obstacle:
      break;
  }
  return 3;
}

EgoFeatures ego_features(const world::Scene& scene, const world::LanePose& ego) {
  const world::Road& road = scene.road;
  const Vec2 v_L = rotated(scene.ego.v_B, ego.heading);
  return {.usable = true,
          .v_L = v_L,
          .offset = ego.d,
          .heading = ego.heading,
          .yaw_rate = scene.ego.yaw_rate,
          .length = scene.ego_footprint.length,
          .width = scene.ego_footprint.width,
          .log_grip = std::log(scene.grip),
          .lane_width = road.lane_width,
          .curve = road.curvature * dot(v_L, v_L),
          .room_left = std::min(road.left_edge - ego.d, ample_room),
          .room_right = std::min(ego.d - road.right_edge, ample_room),
          .topology = road.topology,
          .left_beyond = road.left_beyond,
          .right_beyond = road.right_beyond,
          .oncoming_left = road.oncoming_left,
          .oncoming_right = road.oncoming_right};
}

/// Distance of `x` from [low, high].
double outside(double x, double low, double high) {
  return std::max({low - x, x - high, 0.0});
}

/// The ground that the ego's body can cover at one time: from full braking to going on, and a lane
/// change to either side. Relative to where it would be going on.
struct Reach {
  double rear = 0.0;   ///< s [m]
  double front = 0.0;  ///< s [m]
  double side = 0.0;   ///< |d| [m]
};
using Reaches = std::array<Reach, num_threat_samples>;

Reaches ego_reaches(const world::Scene& scene, const EgoFeatures& ego) {
  const double deceleration = scene.grip * gravity;
  const double speed = std::abs(ego.v_L.x);
  Reaches reaches;
  for (std::size_t k = 0; k < reaches.size(); ++k) {
    const double t = threat_interval * static_cast<double>(k);
    const double braking_time = std::min(t, speed / deceleration);
    const double kept_back = speed * t - braking_time * (speed - 0.5 * deceleration * braking_time);
    const double centre = scene.ego_footprint.centre_x;
    const double sideways =
        std::min({0.5 * swerve_share * deceleration * t * t, scene.road.lane_width, speed * t});
    // A car that rolls backwards brakes the other way.
    const double behind = ego.v_L.x >= 0.0 ? kept_back : 0.0;
    const double ahead = ego.v_L.x >= 0.0 ? 0.0 : kept_back;
    reaches[k] = {centre - 0.5 * ego.length - behind, centre + 0.5 * ego.length + ahead,
                  0.5 * ego.width + sideways};
  }
  return reaches;
}

double threat(const ActorFeatures& actor, double existence, const Reaches& reaches) {
  const Vec2 f{std::abs(actor.forward_L.x), std::abs(actor.forward_L.y)};
  const double half_s = 0.5 * (f.x * actor.length + f.y * actor.width);
  const double half_d = 0.5 * (f.y * actor.length + f.x * actor.width);
  double nearest2 = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < reaches.size(); ++k) {
    const double t = threat_interval * static_cast<double>(k);
    const Vec2 p = actor.p_rel_L + t * actor.v_rel_L;
    const double gap_s = outside(p.x, reaches[k].rear - half_s, reaches[k].front + half_s);
    const double gap_d = outside(p.y, -reaches[k].side - half_d, reaches[k].side + half_d);
    nearest2 = std::min(nearest2, square(gap_s) + square(gap_d));
  }
  return existence * full_threat * std::pow(full_threat, -std::sqrt(nearest2) / lane);
}

ActorFeatures actor_features(const world::Actor& actor, const world::Road& road,
                             const world::LanePose& ego, Vec2 ego_v_L) {
  const world::LanePose pose = world::to_lane(road, actor.X_WA);
  const Vec2 v_L = rotated(actor.v_W, pose.heading - actor.X_WA.yaw);
  return {.p_rel_L = {pose.s - ego.s, pose.d - ego.d},
          .v_rel_L = v_L - ego_v_L,
          .sideways = rotated(actor.a_W, pose.heading - actor.X_WA.yaw).y,
          .forward_L = {std::cos(pose.heading), std::sin(pose.heading)},
          .length = actor.footprint.length,
          .width = actor.footprint.width,
          .kind = actor.kind};
}

double marking_difference2(const EgoFeatures& a, const EgoFeatures& b) {
  return (a.oncoming_left != b.oncoming_left ? square(other_marking) : 0.0) +
         (a.oncoming_right != b.oncoming_right ? square(other_marking) : 0.0);
}

double topology_difference2(const EgoFeatures& a, const EgoFeatures& b) {
  return a.topology != b.topology ? square(other_topology) : 0.0;
}

/// One part of what the ego and its road differ in.
struct EgoPart {
  const char* what;
  double squared;
};
constexpr std::size_t num_ego_parts = 12;

double edge_difference2(double room_a, double room_b, Beyond a, Beyond b) {
  // What lies beyond matters fully within a lane's width and not at all where room is ample.
  const double nearness =
      std::clamp((ample_room - 0.5 * (room_a + room_b)) / (ample_room - lane), 0.0, 1.0);
  const double ground = is_hard(a) != is_hard(b) ? other_ground * nearness : 0.0;
  return square((room_a - room_b) / room_scale) + square(ground);
}

std::array<EgoPart, num_ego_parts> ego_parts(const EgoFeatures& a, const EgoFeatures& b) {
  const Vec2 v = a.v_L - b.v_L;
  return {{{"speed", square(v.x / speed_scale) + square(v.y / sideways_scale)},
           {"place in the lane", square((a.offset - b.offset) / offset_scale)},
           {"heading", square(wrap_angle(a.heading - b.heading) / heading_scale)},
           {"yaw rate", square((a.yaw_rate - b.yaw_rate) / yaw_rate_scale)},
           {"body", square((a.length - b.length) / ego_size_scale) +
                        square((a.width - b.width) / ego_size_scale)},
           {"grip", square((a.log_grip - b.log_grip) / log_grip_scale)},
           {"width of the lane", square((a.lane_width - b.lane_width) / lane_scale)},
           {"curve", square((a.curve - b.curve) / curve_scale)},
           {"room to the left",
            edge_difference2(a.room_left, b.room_left, a.left_beyond, b.left_beyond)},
           {"room to the right",
            edge_difference2(a.room_right, b.room_right, a.right_beyond, b.right_beyond)},
           {"markings", marking_difference2(a, b)},
           {"kind of road", topology_difference2(a, b)}}};
}

double ego_difference2(const EgoFeatures& a, const EgoFeatures& b) {
  double sum = 0.0;
  for (const EgoPart& part : ego_parts(a, b)) {
    sum += part.squared;
  }
  return sum;
}

double actor_difference2(const ActorFeatures& a, const ActorFeatures& b) {
  const Vec2 p = a.p_rel_L - b.p_rel_L;
  const Vec2 v = a.v_rel_L - b.v_rel_L;
  double sum = square(p.x / along_now_scale) + square(p.y / across_now_scale);
  sum += square((p.y + v.y) / across_then_scale) + square((p.x + 2.0 * v.x) / along_then_scale);
  sum += square(v.x / speed_along_scale) + square(v.y / speed_across_scale);
  sum += square((a.sideways - b.sideways) / acceleration_scale);
  sum += square(0.5 * (a.length - b.length) / edge_scale);
  sum += square(0.5 * (a.width - b.width) / edge_scale);
  // Turning moves the ends of a long body, not those of a disc; front and rear are alike.
  const double arm = 0.25 * (std::abs(a.length - a.width) + std::abs(b.length - b.width));
  const double sine = a.forward_L.x * b.forward_L.y - a.forward_L.y * b.forward_L.x;
  sum += square(arm * sine / turned_scale);
  if (a.kind != b.kind) {
    sum += square(group(a.kind) == group(b.kind) ? other_kind : other_group);
  }
  return sum;
}

double absence2(const ActorFeatures& actor) {
  return square(absence_share * actor.threat);
}

/// The assignment of which the sum of squared differences is smallest, exactly: the Hungarian
/// method, one row after the other by shortest augmenting paths (R. Jonker, A. Volgenant, A
/// shortest augmenting path algorithm for dense and sparse linear assignment problems, Computing
/// 38, 1987). To match two actors saves what their absences count above their difference; nobody
/// is matched where that saves nothing.
class Assignment {
 public:
  using Actors = std::span<const ActorFeatures>;

  /// @param rows  not more than `columns`
  Assignment(Actors rows, Actors columns) : rows_(rows), columns_(columns) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (std::size_t j = 0; j < columns.size(); ++j) {
        pair2_[i][j] = actor_difference2(rows[i], columns[j]);
      }
      assign(i);
    }
  }

  /// Calls take(row, column, squared difference) for each pair, and for who is unmatched with
  /// `none` in the other's place.
  template <class Take>
  void each(const Take& take) const {
    std::array<bool, world::max_actors> is_matched{};
    for (std::size_t j = 0; j < columns_.size(); ++j) {
      const std::size_t row = row_of_[j];
      if (row != none && saving2(row, j) > 0.0) {
        take(row, j, pair2_[row][j]);
        is_matched[row] = true;
      } else {
        take(none, j, absence2(columns_[j]));
      }
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (!is_matched[i]) {
        take(i, none, absence2(rows_[i]));
      }
    }
  }

  /// Sum of squares over the pairs and the unmatched: from the smallest on, so that it does not
  /// depend on their order, nor on which scene comes first.
  [[nodiscard]] double sum2() const {
    std::array<double, 2 * world::max_actors> parts;
    std::size_t size = 0;
    each([&](std::size_t, std::size_t, double squared) { parts[size++] = squared; });
    std::sort(parts.data(), parts.data() + size);
    return std::accumulate(parts.data(), parts.data() + size, 0.0);
  }

  static constexpr std::size_t none = world::max_actors;

 private:
  [[nodiscard]] double saving2(std::size_t i, std::size_t j) const {
    return absence2(rows_[i]) + absence2(columns_[j]) - pair2_[i][j];
  }
  [[nodiscard]] double cost(std::size_t i, std::size_t j) const {
    return -std::max(saving2(i, j), 0.0);
  }

  /// Finds a column for a row, moving the rows before where that is cheaper.
  void assign(std::size_t row) {
    constexpr double far = std::numeric_limits<double>::infinity();
    std::array<double, world::max_actors> shortest;       // reduced cost of the way to each column
    std::array<std::size_t, world::max_actors> before{};  // column on that way
    std::array<bool, world::max_actors> done{};
    shortest.fill(far);
    std::size_t column = none;  // where the way has come to
    std::size_t from = row;     // the row that is without a column there
    double length = 0.0;
    while (true) {
      std::size_t next = none;
      for (std::size_t j = 0; j < columns_.size(); ++j) {
        if (done[j]) {
          continue;
        }
        const double way = length + cost(from, j) - row_price_[from] - column_price_[j];
        if (way < shortest[j]) {
          shortest[j] = way;
          before[j] = column;
        }
        if (next == none || shortest[j] < shortest[next]) {
          next = j;
        }
      }
      column = next;
      length = shortest[column];
      if (row_of_[column] == none) {
        break;
      }
      done[column] = true;
      from = row_of_[column];
    }
    row_price_[row] += length;
    for (std::size_t j = 0; j < columns_.size(); ++j) {
      if (done[j]) {
        row_price_[row_of_[j]] += length - shortest[j];
        column_price_[j] -= length - shortest[j];
      }
    }
    while (before[column] != none) {
      row_of_[column] = row_of_[before[column]];
      column = before[column];
    }
    row_of_[column] = row;
  }

  static constexpr std::array<std::size_t, world::max_actors> nobody() {
    std::array<std::size_t, world::max_actors> all{};
    all.fill(none);
    return all;
  }

  Actors rows_;
  Actors columns_;
  std::array<std::array<double, world::max_actors>, world::max_actors> pair2_;
  std::array<std::size_t, world::max_actors> row_of_ = nobody();
  std::array<double, world::max_actors> row_price_{};
  std::array<double, world::max_actors> column_price_{};
};

}  // namespace

Features features(const world::Scene& scene) noexcept {
  Features result;
  if (world::broken_rule(scene)) {
    return result;
  }
  const world::LanePose ego = world::to_lane(scene.road, scene.ego.X_WB);
  result.ego = ego_features(scene, ego);
  const Reaches reaches = ego_reaches(scene, result.ego);
  for (const world::Actor& actor : scene.actors) {
    ActorFeatures one = actor_features(actor, scene.road, ego, result.ego.v_L);
    one.threat = threat(one, actor.existence, reaches);
    result.actors.push_back(one);
  }
  return result;
}

double road_difference2(const EgoFeatures& a, const EgoFeatures& b) noexcept {
  return marking_difference2(a, b) + topology_difference2(a, b);
}

double difference(const EgoFeatures& ego_a, std::span<const ActorFeatures> actors_a,
                  const EgoFeatures& ego_b, std::span<const ActorFeatures> actors_b,
                  double limit) noexcept {
  if (!ego_a.usable || !ego_b.usable) {
    return std::numeric_limits<double>::infinity();
  }
  const double ego2 = ego_difference2(ego_a, ego_b);
  if (ego2 >= square(limit)) {
    return std::sqrt(ego2);
  }
  const bool fewer = actors_a.size() <= actors_b.size();
  return std::sqrt(ego2 +
                   Assignment(fewer ? actors_a : actors_b, fewer ? actors_b : actors_a).sum2());
}

std::vector<DifferencePart> difference_parts(const world::Scene& a, const world::Scene& b) {
  const Features of_a = features(a);
  const Features of_b = features(b);
  expects(of_a.ego.usable && of_b.ego.usable, "neither scene breaks a rule");
  std::vector<DifferencePart> parts;
  for (const EgoPart& part : ego_parts(of_a.ego, of_b.ego)) {
    parts.push_back({part.what, std::sqrt(part.squared)});
  }
  const bool fewer = of_a.actors.size() <= of_b.actors.size();
  const world::Scene& rows = fewer ? a : b;
  const world::Scene& columns = fewer ? b : a;
  const auto span_of = [](const Features& one) {
    return std::span(one.actors.begin(), one.actors.size());
  };
  const Assignment assignment(span_of(fewer ? of_a : of_b), span_of(fewer ? of_b : of_a));
  assignment.each([&](std::size_t row, std::size_t column, double squared) {
    constexpr std::size_t none = Assignment::none;
    const std::string of_row = row == none ? "nobody" : actor_name(rows.actors[row]);
    const std::string of_column = column == none ? "nobody" : actor_name(columns.actors[column]);
    parts.push_back({(fewer ? of_row : of_column) + " for " + (fewer ? of_column : of_row),
                     std::sqrt(squared)});
  });
  std::erase_if(parts, [](const DifferencePart& one) { return one.size == 0.0; });
  std::stable_sort(
      parts.begin(), parts.end(),
      [](const DifferencePart& one, const DifferencePart& other) { return one.size > other.size; });
  return parts;
}

double similarity_at(double difference) noexcept {
  constexpr double log_of_gate = -0.10536051565782628;  // ln 0.9
  return std::exp(log_of_gate * difference);
}

double similarity(const Features& a, const Features& b) noexcept {
  return similarity_at(difference(a.ego, {a.actors.begin(), a.actors.size()}, b.ego,
                                  {b.actors.begin(), b.actors.size()}));
}

double similarity(const world::Scene& a, const world::Scene& b) noexcept {
  return similarity(features(a), features(b));
}

}  // namespace saca::memory
