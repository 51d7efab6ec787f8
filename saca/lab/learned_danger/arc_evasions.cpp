#include "saca/lab/learned_danger/arc_evasions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saca/thinking/danger/intrusion.h"

namespace saca::learned_danger {
namespace {

constexpr double look_ahead = 16.0;     // [s]: longer than a stop from 30 m/s on grip 0.2 takes
constexpr double shortest_step = 0.02;  // [s]
constexpr double longest_step = 2.0;    // [s]

/// By how much h rises at most in a second of the next `longest_step` [m/s].
double fastest_rise(const world::Footprint& body, const Obstacle& motion) {
  const double speed = motion.speed + std::max(0.0, motion.acceleration) * longest_step;
  return speed * (1.0 + std::abs(motion.curvature) * world::bounding_radius(body));
}

/// The highest h while both go on, if it lies between `least` and `most`: `least` where it is less,
/// and the first that is met where it is more. As h rises only so fast, most of the way is skipped.
double highest_on_the_way(const world::Footprint& body, const Obstacle& ego,
                          const Obstacle& obstacle, double least, double most) {
  double highest = least;
  double time = 0.0;
  while (time <= look_ahead) {
    const Obstacle ego_then = after(ego, time);
    const Obstacle then = after(obstacle, time);
    const double h = danger::intrusion(body, ego_then.X_WO, then.body, then.X_WO);
    highest = std::max(highest, h);
    const double rise = fastest_rise(body, ego_then) + fastest_rise(then.body, then);
    if (highest > most || rise == 0.0) {
      break;
    }
    const double good_to = 0.1 * std::max(0.0, -h);  // [m]: who is far need not be met exactly
    time += std::clamp((highest - h + good_to) / rise, shortest_step, longest_step);
  }
  return highest;
}

}  // namespace

ArcEvasions::ArcEvasions(const danger::Avoidance& limits, const world::Footprint& body,
                         const State& state)
    : body_(body) {
  const double speed = norm(state.ego.v_B);
  danger::Avoidance car = limits;
  car.grip = state.grip;
  const danger::Limits most = danger::limits_at(car, speed);
  const auto add = [&](double along, double across) {
    Arc arc;
    arc.motion.X_WO = {state.ego.X_WB.p, course(state.ego)};
    arc.motion.speed = speed;
    if (speed > 0.0) {
      arc.demand = {along / most.disc, across / most.disc};
      arc.motion.acceleration = along;
      arc.motion.curvature = across / (speed * speed);
    }
    arcs_.push_back(arc);
  };
  add(0.0, 0.0);
  if (speed == 0.0) {
    return;
  }
  add(most.drive, 0.0);
  for (int i = 0; i < num_turns; ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) / (num_turns - 1) - 0.5);
    const double across = std::clamp(-most.disc * std::sin(angle), -most.across, most.across);
    add(-std::sqrt(std::max(0.0, most.disc * most.disc - across * across)), across);
  }
}

bool ArcEvasions::stay_below(double level, const Obstacle& obstacle) const {
  return std::any_of(arcs_.begin(), arcs_.end(), [&](const Arc& arc) {
    return highest_on_the_way(body_, arc.motion, obstacle, level, level) <= level;
  });
}

std::optional<manoeuvre::Demand> ArcEvasions::straight_below(
    double level, std::span<const Obstacle> obstacles) const {
  constexpr std::size_t going_on = 0;
  constexpr std::size_t braking = 2 + num_turns / 2;  // of the turns the middle one
  for (const std::size_t which : {going_on, braking}) {
    if (which < arcs_.size() &&
        std::all_of(obstacles.begin(), obstacles.end(), [&](const Obstacle& obstacle) {
          return highest_on_the_way(body_, arcs_[which].motion, obstacle, level, level) <= level;
        })) {
      return arcs_[which].demand;
    }
  }
  return std::nullopt;
}

ArcEvasions::Best ArcEvasions::best(const Obstacle& obstacle) const {
  Best best;
  for (const Arc& arc : arcs_) {
    const double highest = highest_on_the_way(
        body_, arc.motion, obstacle, -std::numeric_limits<double>::infinity(), best.highest);
    if (highest < best.highest) {
      best = {arc.demand, highest};
    }
  }
  return best;
}

}  // namespace saca::learned_danger
