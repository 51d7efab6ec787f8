#include "saca/lab/learned_danger/acting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "saca/base/core/contract.h"
#include "saca/base/core/static_vector.h"
#include "saca/lab/learned_danger/arc_evasions.h"

namespace saca::learned_danger {
namespace {

using manoeuvre::Demand;

/// All around the disc's edge, six at half of it, and none.
constexpr std::size_t num_around = 24;
constexpr std::size_t num_half = 6;
using Candidates = std::array<Demand, num_around + num_half + 1>;

Candidates candidates() {
  Candidates all{};
  std::size_t next = 0;
  const auto add_circle = [&](std::size_t count, double size) {
    for (std::size_t i = 0; i < count; ++i) {
      const double angle =
          2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
      all[next++] = {size * std::cos(angle), size * std::sin(angle)};
    }
  };
  add_circle(num_around, 1.0);
  add_circle(num_half, 0.5);
  return all;
}

StaticVector<SeenByNet, most_obstacles> all_seen(const world::Footprint& body, const State& state) {
  const Observation seen = observation(state);
  StaticVector<SeenByNet, most_obstacles> all;
  for (std::size_t k = 0; k < state.obstacles.size(); ++k) {
    all.push_back(seen_by_net(body, seen, k));
  }
  return all;
}

}  // namespace

Demand least_q(const Network& network, const world::Footprint& body, const State& state) {
  expects(!state.obstacles.empty(), "an obstacle to act for");
  static const Candidates all = candidates();
  std::array<double, all.size()> q;
  network.joint_values_of(all_seen(body, state), all, q);
  return all[static_cast<std::size_t>(std::min_element(q.begin(), q.end()) - q.begin())];
}

std::optional<Demand> straight_evasion(const danger::Avoidance& limits,
                                       const world::Footprint& body, const State& state) {
  constexpr double least = 1.0;   // [m]
  constexpr double driven = 0.2;  // [s]
  const double clearance = least + driven * norm(state.ego.v_B);
  return ArcEvasions(limits, body, state)
      .straight_below(-clearance, {state.obstacles.begin(), state.obstacles.size()});
}

Demand evasion(const danger::Avoidance& limits, const Network& network,
               const world::Footprint& body, const State& state) {
  const auto straight = straight_evasion(limits, body, state);
  return straight ? *straight : least_q(network, body, state);
}

double joint_v(const Network& network, const world::Footprint& body, const State& state) {
  return network.joint_value(all_seen(body, state));
}

double highest_single_v(const Network& network, const world::Footprint& body, const State& state) {
  const auto seen = all_seen(body, state);
  std::array<double, most_obstacles> v{};
  const auto values = std::span(v).first(seen.size());
  network.values(seen, values);
  return *std::max_element(values.begin(), values.end());
}

State state_of(const manoeuvre::Car& car, const Situation& situation) {
  return {
      .ego = ego_of(car, situation.car), .grip = situation.grip, .obstacles = situation.obstacles};
}

double highest_h(const manoeuvre::Car& car, const world::Footprint& body,
                 const Situation& situation, const Policy& policy) {
  constexpr double between = look_step / static_cast<double>(poses_per_look);
  DemandDrivenCar driven(car, situation.car, situation.grip);
  State state = state_of(car, situation);
  double highest = intrusion(body, state);
  for (int look = 0; look < horizon_looks && !is_settled(body, state); ++look) {
    for (const Pose& pose : driven.hold(policy(state, look_step * look))) {
      move_obstacles(state, between);
      state.ego.X_WB = pose;
      highest = std::max(highest, intrusion(body, state));
    }
    state.ego = driven.ego();
  }
  return highest;
}

}  // namespace saca::learned_danger
