// Longer than 400 lines: one measure and its parts, which are compared thousands of times for each
// scene and are compiled together.
#include "saca/onboard/match/similarity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <numeric>

#include "saca/base/core/angle.h"
#include "saca/base/core/contract.h"

namespace saca::match {
namespace {

using world::ActorKind;

constexpr double far_from_edge = 7.0;   // [m]
constexpr double other_ground = 2.0;    // soft instead of hard beyond an edge that is at hand
constexpr double other_marking = 1.25;  // oncoming traffic or not
constexpr double other_topology = 4.0;
constexpr double other_kind = 0.4;  // of the same group
constexpr double other_group = 1.0;

// An actor's absence is a `full_threat` where it touches ground that the ego can reach, and 1 where
// it stays a lane's width away from it.
constexpr double full_threat = 4.0;
constexpr double lane = 3.5;              // [m]
constexpr double gravity = 9.80665;       // [m/s^2]
constexpr double swerve_share = 0.6;      // of grip, as mean sideways acceleration of a lane change
constexpr int num_threat_samples = 13;    // 3 s: a stop from 25 m/s on a dry road
constexpr double threat_interval = 0.25;  // [s]

template <class Real>
constexpr Real square(Real x) {
  return x * x;
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
          .to_left_edge = std::min(road.left_edge - ego.d, far_from_edge),
          .to_right_edge = std::min(ego.d - road.right_edge, far_from_edge),
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

/// Square of what two egos differ in, by EgoPart.
template <class Real>
std::array<Real, num_ego_parts> ego_squares(const ScaledEgo<Real>& a, const ScaledEgo<Real>& b) {
  std::array<Real, num_ego_parts> squares;
  for (std::size_t i = 0; i < squares.size(); ++i) {
    squares[i] = square(a.parts[i] - b.parts[i]);
  }
  // The short way round.
  Real turned = std::abs(a.parts[ego_heading] - b.parts[ego_heading]);
  turned = turned > a.half_turn ? 2 * a.half_turn - turned : turned;
  squares[ego_heading] = square(turned);
  // What lies beyond matters fully within a lane's width and not at all where it is far away.
  const auto ground = [&](std::size_t part, bool is_other, Real nearness) {
    const Real share = std::clamp(nearness, Real{0}, Real{1});
    squares[part] += is_other ? square(static_cast<Real>(other_ground) * share) : Real{0};
  };
  ground(ego_to_left_edge, a.hard_left != b.hard_left, (a.near_left + b.near_left) / 2);
  ground(ego_to_right_edge, a.hard_right != b.hard_right, (a.near_right + b.near_right) / 2);
  return squares;
}

template <class Real>
Real ego_difference2(const ScaledEgo<Real>& a, const ScaledEgo<Real>& b) {
  // Four sums at once: one after the other each addition would wait for the one before.
  const std::array<Real, num_ego_parts> squares = ego_squares(a, b);
  std::array<Real, 4> sums{};
  for (std::size_t i = 0; i < squares.size(); i += sums.size()) {
    for (std::size_t k = 0; k < sums.size(); ++k) {
      sums[k] += squares[i + k];
    }
  }
  return (sums[0] + sums[1]) + (sums[2] + sums[3]) + road_difference2(a, b);
}

template <class Real>
Real actor_difference2(const ScaledActor<Real>& a, const ScaledActor<Real>& b) {
  std::array<Real, 4> sums{};
  for (std::size_t i = 0; i < a.parts.size(); i += sums.size()) {
    for (std::size_t k = 0; k < sums.size(); ++k) {
      sums[k] += square(a.parts[i + k] - b.parts[i + k]);
    }
  }
  Real sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
  // Turning moves the ends of a long body, not those of a disc; front and rear are alike.
  const Real sine = a.forward_s * b.forward_d - a.forward_d * b.forward_s;
  sum += square((a.arm + b.arm) * sine);
  if (a.kind != b.kind) {
    sum += static_cast<Real>(square(group(a.kind) == group(b.kind) ? other_kind : other_group));
  }
  return sum;
}

/// Turns p^2 / a^2 + (p + t v)^2 / b^2 + v^2 / c^2 into two squares: L^T (p, v) with the Cholesky
/// factor L of that form.
struct TwoSquares {
  double of_p = 0.0;
  double p_of_v = 0.0;
  double of_v = 0.0;

  TwoSquares(double a, double b, double t, double c)
      : of_p(std::sqrt(1.0 / square(a) + 1.0 / square(b))),
        p_of_v(t / square(b) / of_p),
        of_v(std::sqrt(square(t / b) + 1.0 / square(c) - square(p_of_v))) {}
};

template <class Real>
ScaledActor<Real> scaled_actor(const ActorFeatures& actor, const Scales& scales,
                               const TwoSquares& along, const TwoSquares& across) {
  const auto real = [](double x) { return static_cast<Real>(x); };
  const Vec2 p = actor.p_rel_L;
  const Vec2 v = actor.v_rel_L;
  ScaledActor<Real> result;
  result.parts = {
      real(along.of_p * p.x + along.p_of_v * v.x),   real(along.of_v * v.x),
      real(across.of_p * p.y + across.p_of_v * v.y), real(across.of_v * v.y),
      real(actor.sideways / scales.acceleration),    real(0.5 * actor.length / scales.edge),
      real(0.5 * actor.width / scales.edge),         Real{0}};
  result.arm = real(0.25 * std::abs(actor.length - actor.width) / scales.turned);
  result.forward_s = real(actor.forward_L.x);
  result.forward_d = real(actor.forward_L.y);
  result.absence2 = real(square(scales.absence * actor.threat));
  result.kind = actor.kind;
  return result;
}

/// The assignment of which the sum of squared differences is smallest, exactly: the Hungarian
/// method, one row after the other by shortest augmenting paths (R. Jonker, A. Volgenant, A
/// shortest augmenting path algorithm for dense and sparse linear assignment problems, Computing
/// 38, 1987). To match two actors saves what their absences count above their difference; nobody
/// is matched where that saves nothing.
template <class Real>
class Assignment {
 public:
  using Actors = std::span<const ScaledActor<Real>>;

  /// @param rows  not more than `columns`
  Assignment(Actors rows, Actors columns) : rows_(rows), columns_(columns) {
    std::array<bool, world::max_actors> is_like_somebody;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      is_like_somebody[i] = false;
      for (std::size_t j = 0; j < columns.size(); ++j) {
        pair2_[i][j] = actor_difference2(rows[i], columns[j]);
        is_like_somebody[i] |= saving2(i, j) > Real{0};
      }
    }
    std::fill_n(row_of_.begin(), columns.size(), nobody);
    std::fill_n(column_price_.begin(), columns.size(), Real{0});
    // Whom nobody is like stays unmatched, and takes nobody's place.
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (is_like_somebody[i]) {
        assign(i);
      }
    }
  }

  /// Calls take(row, column, squared difference) for each pair, and for who is unmatched with
  /// `none` in the other's place.
  template <class Take>
  void each(const Take& take) const {
    std::array<bool, world::max_actors> is_matched;
    std::fill_n(is_matched.begin(), rows_.size(), false);
    for (std::size_t j = 0; j < columns_.size(); ++j) {
      const std::size_t row = row_of_[j];
      if (row != nobody && saving2(row, j) > Real{0}) {
        take(row, j, pair2_[row][j]);
        is_matched[row] = true;
      } else {
        take(none, j, columns_[j].absence2);
      }
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (!is_matched[i]) {
        take(i, none, rows_[i].absence2);
      }
    }
  }

  /// Sum of squares over the pairs and the unmatched: from the smallest on, so that it does not
  /// depend on their order, nor on which scene comes first.
  [[nodiscard]] Real sum2() const {
    std::array<Real, 2 * world::max_actors> parts;
    std::size_t size = 0;
    each([&](std::size_t, std::size_t, Real squared) { parts[size++] = squared; });
    std::sort(parts.data(), parts.data() + size);
    return std::accumulate(parts.data(), parts.data() + size, Real{0});
  }

  static constexpr std::size_t none = world::max_actors;

 private:
  [[nodiscard]] Real saving2(std::size_t i, std::size_t j) const {
    return rows_[i].absence2 + columns_[j].absence2 - pair2_[i][j];
  }
  [[nodiscard]] Real cost(std::size_t i, std::size_t j) const {
    return -std::max(saving2(i, j), Real{0});
  }

  /// Finds a column for a row, moving the rows before where that is cheaper.
  void assign(std::size_t row) {
    constexpr Real far = std::numeric_limits<Real>::infinity();
    std::array<Real, world::max_actors> shortest;  // reduced cost of the way to each column
    std::array<Index, world::max_actors> before;   // column on that way
    std::array<bool, world::max_actors> done;
    std::fill_n(shortest.begin(), columns_.size(), far);
    std::fill_n(before.begin(), columns_.size(), nobody);
    std::fill_n(done.begin(), columns_.size(), false);
    row_price_[row] = 0;
    Index column = nobody;   // where the way has come to
    std::size_t from = row;  // the row that is without a column there
    Real length = 0;
    while (true) {
      std::size_t next = nobody;
      for (std::size_t j = 0; j < columns_.size(); ++j) {
        if (done[j]) {
          continue;
        }
        const Real way = length + cost(from, j) - row_price_[from] - column_price_[j];
        if (way < shortest[j]) {
          shortest[j] = way;
          before[j] = column;
        }
        if (next == nobody || shortest[j] < shortest[next]) {
          next = j;
        }
      }
      column = static_cast<Index>(next);
      length = shortest[column];
      if (row_of_[column] == nobody) {
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
    while (before[column] != nobody) {
      row_of_[column] = row_of_[before[column]];
      column = before[column];
    }
    row_of_[column] = static_cast<Index>(row);
  }

  // A search makes thousands of these: only what is needed is set, by the constructor.
  using Index = std::uint8_t;
  static constexpr Index nobody = 255;
  static_assert(world::max_actors < nobody);
  Actors rows_;
  Actors columns_;
  std::array<std::array<Real, world::max_actors>, world::max_actors> pair2_;
  std::array<Index, world::max_actors> row_of_;
  std::array<Real, world::max_actors> row_price_;
  std::array<Real, world::max_actors> column_price_;
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

template <class Real>
ScaledEgo<Real> scaled(const EgoFeatures& ego, const Scales& scales) noexcept {
  const auto real = [](double x) { return static_cast<Real>(x); };
  ScaledEgo<Real> result;
  result.parts = {
      real(ego.v_L.x / scales.speed),           real(ego.v_L.y / scales.sideways),
      real(ego.offset / scales.offset),         real(wrap_angle(ego.heading) / scales.heading),
      real(ego.yaw_rate / scales.yaw_rate),     real(ego.length / scales.ego_size),
      real(ego.width / scales.ego_size),        real(ego.log_grip / scales.log_grip),
      real(ego.lane_width / scales.lane_width), real(ego.curve / scales.curve),
      real(ego.to_left_edge / scales.to_edge),  real(ego.to_right_edge / scales.to_edge)};
  const auto nearness = [&](double distance) {
    return real((far_from_edge - distance) / (far_from_edge - lane));
  };
  result.near_left = nearness(ego.to_left_edge);
  result.near_right = nearness(ego.to_right_edge);
  result.half_turn = real(std::numbers::pi / scales.heading);
  result.usable = ego.usable;
  result.hard_left = world::is_hard(ego.left_beyond);
  result.hard_right = world::is_hard(ego.right_beyond);
  result.oncoming_left = ego.oncoming_left;
  result.oncoming_right = ego.oncoming_right;
  result.topology = ego.topology;
  return result;
}

template <class Real>
ScaledActors<Real> scaled(std::span<const ActorFeatures> actors, const Scales& scales) noexcept {
  const TwoSquares along(scales.along_now, scales.along_then, 2.0, scales.speed_along);
  const TwoSquares across(scales.across_now, scales.across_then, 1.0, scales.speed_across);
  ScaledActors<Real> all;
  for (const ActorFeatures& actor : actors) {
    all.push_back(scaled_actor<Real>(actor, scales, along, across));
  }
  return all;
}

template <class Real>
Real road_difference2(const ScaledEgo<Real>& a, const ScaledEgo<Real>& b) noexcept {
  constexpr auto marking2 = static_cast<Real>(square(other_marking));
  constexpr auto topology2 = static_cast<Real>(square(other_topology));
  return (a.oncoming_left != b.oncoming_left ? marking2 : Real{0}) +
         (a.oncoming_right != b.oncoming_right ? marking2 : Real{0}) +
         (a.topology != b.topology ? topology2 : Real{0});
}

template <class Real>
Real difference2(const ScaledEgo<Real>& ego_a, std::span<const ScaledActor<Real>> actors_a,
                 const ScaledEgo<Real>& ego_b, std::span<const ScaledActor<Real>> actors_b,
                 Real limit2) noexcept {
  if (!ego_a.usable || !ego_b.usable) {
    return std::numeric_limits<Real>::infinity();
  }
  const Real ego2 = ego_difference2(ego_a, ego_b);
  if (ego2 >= limit2) {
    return ego2;
  }
  const bool fewer = actors_a.size() <= actors_b.size();
  return ego2 + Assignment<Real>(fewer ? actors_a : actors_b, fewer ? actors_b : actors_a).sum2();
}

template ScaledEgo<float> scaled<float>(const EgoFeatures&, const Scales&) noexcept;
template ScaledActors<float> scaled<float>(std::span<const ActorFeatures>, const Scales&) noexcept;
template float road_difference2(const ScaledEgo<float>&, const ScaledEgo<float>&) noexcept;
template float difference2(const ScaledEgo<float>&, std::span<const ScaledActor<float>>,
                           const ScaledEgo<float>&, std::span<const ScaledActor<float>>,
                           float) noexcept;
template ScaledEgo<double> scaled<double>(const EgoFeatures&, const Scales&) noexcept;
template ScaledActors<double> scaled<double>(std::span<const ActorFeatures>,
                                             const Scales&) noexcept;
template double road_difference2(const ScaledEgo<double>&, const ScaledEgo<double>&) noexcept;
template double difference2(const ScaledEgo<double>&, std::span<const ScaledActor<double>>,
                            const ScaledEgo<double>&, std::span<const ScaledActor<double>>,
                            double) noexcept;

namespace {

template <class Real>
std::span<const ScaledActor<Real>> span_of(const ScaledActors<Real>& actors) {
  return {actors.begin(), actors.size()};
}

}  // namespace

double difference(const EgoFeatures& ego_a, std::span<const ActorFeatures> actors_a,
                  const EgoFeatures& ego_b, std::span<const ActorFeatures> actors_b,
                  double limit) noexcept {
  const auto of_a = scaled<double>(actors_a);
  const auto of_b = scaled<double>(actors_b);
  return std::sqrt(difference2(scaled<double>(ego_a), span_of(of_a), scaled<double>(ego_b),
                               span_of(of_b), square(limit)));
}

std::vector<DifferencePart> difference_parts(const world::Scene& a, const world::Scene& b) {
  const Features of_a = features(a);
  const Features of_b = features(b);
  expects(of_a.ego.usable && of_b.ego.usable, "neither scene breaks a rule");
  const auto ego_a = scaled<double>(of_a.ego);
  const auto ego_b = scaled<double>(of_b.ego);
  const auto squares = ego_squares(ego_a, ego_b);
  const auto root = [&squares](std::initializer_list<std::size_t> which) {
    double sum = 0.0;
    for (const std::size_t part : which) {
      sum += squares[part];
    }
    return std::sqrt(sum);
  };
  std::vector<DifferencePart> parts{
      {"speed", root({ego_speed, ego_sideways})},
      {"place in the lane", root({ego_offset})},
      {"heading", root({ego_heading})},
      {"yaw rate", root({ego_yaw_rate})},
      {"body", root({ego_length, ego_width})},
      {"grip", root({ego_grip})},
      {"width of the lane", root({ego_lane_width})},
      {"curve", root({ego_curve})},
      {"room to the left", root({ego_to_left_edge})},
      {"room to the right", root({ego_to_right_edge})},
      {"road and markings", std::sqrt(road_difference2(ego_a, ego_b))}};
  const bool fewer = of_a.actors.size() <= of_b.actors.size();
  const world::Scene& rows = fewer ? a : b;
  const world::Scene& columns = fewer ? b : a;
  const auto actors_of = [](const Features& one) {
    return scaled<double>(std::span(one.actors.begin(), one.actors.size()));
  };
  const auto of_rows = actors_of(fewer ? of_a : of_b);
  const auto of_columns = actors_of(fewer ? of_b : of_a);
  const Assignment<double> assignment(span_of(of_rows), span_of(of_columns));
  assignment.each([&](std::size_t row, std::size_t column, double squared) {
    constexpr std::size_t none = Assignment<double>::none;
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

}  // namespace saca::match
