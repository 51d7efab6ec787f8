#include "saca/memory/similarity.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "saca/core/angle.h"

namespace saca::memory {
namespace {

using world::ActorKind;
using world::Beyond;

// Every scale is the difference that, alone, brings the similarity to 0.9. They are judgements, not
// measurements; docs/decisions/0003-similarity.md has the reasons.
constexpr double metres = 1.0;
constexpr double metres_per_second = 1.0;
constexpr double heading_scale = 0.2;   // [rad]
constexpr double yaw_rate_scale = 0.3;  // [rad/s]
constexpr double log_grip_scale = 0.1;  // of stopping distance
constexpr double curve_scale = 2.0;     // [m/s^2]
constexpr double ample_room = 7.0;      // [m]
constexpr double other_ground = 3.0;    // soft instead of hard beyond an edge that is at hand
constexpr double other_marking = 1.5;   // oncoming traffic or not
constexpr double other_topology = 2.0;
constexpr double other_kind = 1.0;   // of the same group
constexpr double other_group = 4.0;  // as much as a missing one

// An actor's absence counts `full_threat` where it touches ground that the ego can reach, and 1
// where it stays a lane's width away from it.
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
          .forward_L = {std::cos(pose.heading), std::sin(pose.heading)},
          .length = actor.footprint.length,
          .width = actor.footprint.width,
          .kind = actor.kind};
}

double edge_difference2(double room_a, double room_b, Beyond a, Beyond b) {
  // What lies beyond matters fully within a lane's width and not at all where room is ample.
  const double nearness =
      std::clamp((ample_room - 0.5 * (room_a + room_b)) / (ample_room - lane), 0.0, 1.0);
  const double ground = is_hard(a) != is_hard(b) ? other_ground * nearness : 0.0;
  return square((room_a - room_b) / metres) + square(ground);
}

double ego_difference2(const EgoFeatures& a, const EgoFeatures& b) {
  const Vec2 v = a.v_L - b.v_L;
  double sum = dot(v, v) / square(metres_per_second);
  sum += square((a.offset - b.offset) / metres);
  sum += square(wrap_angle(a.heading - b.heading) / heading_scale);
  sum += square((a.yaw_rate - b.yaw_rate) / yaw_rate_scale);
  sum += square(0.5 * (a.length - b.length) / metres);
  sum += square(0.5 * (a.width - b.width) / metres);
  sum += square((a.log_grip - b.log_grip) / log_grip_scale);
  sum += square((a.lane_width - b.lane_width) / metres);
  sum += square((a.curve - b.curve) / curve_scale);
  sum += edge_difference2(a.room_left, b.room_left, a.left_beyond, b.left_beyond);
  sum += edge_difference2(a.room_right, b.room_right, a.right_beyond, b.right_beyond);
  sum += a.oncoming_left != b.oncoming_left ? square(other_marking) : 0.0;
  sum += a.oncoming_right != b.oncoming_right ? square(other_marking) : 0.0;
  sum += a.topology != b.topology ? square(other_topology) : 0.0;
  return sum;
}

double actor_difference2(const ActorFeatures& a, const ActorFeatures& b) {
  const Vec2 p = a.p_rel_L - b.p_rel_L;
  const Vec2 v = a.v_rel_L - b.v_rel_L;
  double sum = dot(p, p) / square(metres) + dot(v, v) / square(metres_per_second);
  sum += square(0.5 * (a.length - b.length) / metres);
  sum += square(0.5 * (a.width - b.width) / metres);
  // Turning moves the ends of a long body, not those of a disc; front and rear are alike.
  const double arm = 0.25 * (std::abs(a.length - a.width) + std::abs(b.length - b.width));
  const double sine = a.forward_L.x * b.forward_L.y - a.forward_L.y * b.forward_L.x;
  sum += square(arm * sine / metres);
  if (a.kind != b.kind) {
    sum += square(group(a.kind) == group(b.kind) ? other_kind : other_group);
  }
  return sum;
}

/// Assignment that keeps the worst difference of any actor smallest, exactly.
///
/// Under a bound t, an actor whose absence counts more than t must be matched to one that differs
/// by at most t. A matching that covers the must-haves of both sides exists when one that covers
/// those of the first side and one that covers those of the second exist (Mendelsohn and Dulmage,
/// Some generalizations of the problem of distinct representatives, 1958), so the sides are looked
/// at one by one.
class Assignment {
 public:
  using Actors = std::span<const ActorFeatures>;

  Assignment(Actors a, Actors b) : a_(a), b_(b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (std::size_t j = 0; j < b.size(); ++j) {
        pair2_[i][j] = actor_difference2(a[i], b[j]);
      }
    }
  }

  /// Square of the smallest worst difference.
  [[nodiscard]] double worst2() const {
    const double low = lower_bound2();
    if (fits(low)) {
      return low;
    }
    // Leaving all unmatched always fits; the answer is one of the differences on the way there.
    const double high = std::max(largest_threat2(a_), largest_threat2(b_));
    std::array<double, world::max_actors*(world::max_actors + 2)> bounds;
    std::size_t size = 0;
    const auto offer = [&](double bound) {
      if (bound > low && bound <= high) {
        bounds[size++] = bound;
      }
    };
    for (std::size_t i = 0; i < a_.size(); ++i) {
      offer(square(a_[i].threat));
      std::for_each_n(pair2_[i].begin(), b_.size(), offer);
    }
    for (const ActorFeatures& actor : b_) {
      offer(square(actor.threat));
    }
    std::sort(bounds.data(), bounds.data() + size);
    return *std::partition_point(bounds.data(), bounds.data() + size - 1,
                                 [this](double bound) { return !fits(bound); });
  }

 private:
  using Mask = std::uint32_t;
  static_assert(world::max_actors <= 32);

  static double largest_threat2(Actors actors) {
    double largest = 0.0;
    for (const ActorFeatures& actor : actors) {
      largest = std::max(largest, square(actor.threat));
    }
    return largest;
  }

  /// Nobody can do better than its best partner or its absence.
  [[nodiscard]] double lower_bound2() const {
    double bound = 0.0;
    std::array<double, world::max_actors> best_of_b;
    for (std::size_t j = 0; j < b_.size(); ++j) {
      best_of_b[j] = square(b_[j].threat);
    }
    for (std::size_t i = 0; i < a_.size(); ++i) {
      double best = square(a_[i].threat);
      for (std::size_t j = 0; j < b_.size(); ++j) {
        best = std::min(best, pair2_[i][j]);
        best_of_b[j] = std::min(best_of_b[j], pair2_[i][j]);
      }
      bound = std::max(bound, best);
    }
    for (std::size_t j = 0; j < b_.size(); ++j) {
      bound = std::max(bound, best_of_b[j]);
    }
    return bound;
  }

  [[nodiscard]] bool fits(double bound2) const {
    std::array<Mask, world::max_actors> partners_of_a{};
    std::array<Mask, world::max_actors> partners_of_b{};
    for (std::size_t i = 0; i < a_.size(); ++i) {
      for (std::size_t j = 0; j < b_.size(); ++j) {
        const Mask near = pair2_[i][j] <= bound2 ? 1U : 0U;
        partners_of_a[i] |= near << j;
        partners_of_b[j] |= near << i;
      }
    }
    return covers(a_, partners_of_a, bound2) && covers(b_, partners_of_b, bound2);
  }

  /// Can all actors that must be matched find partners of their own?
  static bool covers(Actors actors, const std::array<Mask, world::max_actors>& partners,
                     double bound2) {
    std::array<std::size_t, world::max_actors> taken_by{};
    Mask taken = 0;
    for (std::size_t i = 0; i < actors.size(); ++i) {
      Mask open = ~Mask{0};
      if (square(actors[i].threat) > bound2 && !settle(i, partners, taken_by, taken, open)) {
        return false;
      }
    }
    return true;
  }

  /// Finds a partner for `actor`, moving others to their second choice where needed (Kuhn's
  /// augmenting paths; `open` are the partners not yet tried, so it recurses at most 32 deep).
  static bool settle(std::size_t actor, const std::array<Mask, world::max_actors>& partners,
                     std::array<std::size_t, world::max_actors>& taken_by, Mask& taken,
                     Mask& open) {  // NOLINT(misc-no-recursion)
    while ((partners[actor] & open) != 0) {
      const auto partner = static_cast<std::size_t>(std::countr_zero(partners[actor] & open));
      const Mask bit = Mask{1} << partner;
      open &= ~bit;
      if ((taken & bit) == 0 || settle(taken_by[partner], partners, taken_by, taken, open)) {
        taken |= bit;
        taken_by[partner] = actor;
        return true;
      }
    }
    return false;
  }

  Actors a_;
  Actors b_;
  std::array<std::array<double, world::max_actors>, world::max_actors> pair2_;
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
  return std::sqrt(ego2 + Assignment(actors_a, actors_b).worst2());
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
