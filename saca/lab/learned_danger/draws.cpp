#include "saca/lab/learned_danger/draws.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "saca/base/core/angle.h"
#include "saca/base/core/units.h"
#include "saca/base/world/scene.h"
#include "saca/lab/learned_danger/behaviour.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/danger/intrusion.h"

namespace saca::learned_danger {
namespace {

struct Kind {
  double share;  ///< of the obstacles
  double length;
  double width;      ///< [m]
  double top_speed;  ///< [m/s]
  double sideways;   ///< most acceleration across its way [m/s^2]
  double tightest;   ///< [1/m]
};
constexpr std::array<Kind, 5> kinds{{{0.15, 0.5, 0.5, 4.0, 2.0, 0.5},
                                     {0.10, 1.8, 0.6, 12.0, 3.0, 0.2},
                                     {0.50, 4.5, 1.8, 40.0, 6.0, 0.18},
                                     {0.15, 9.0, 2.5, 28.0, 3.0, 0.1},
                                     {0.10, 16.5, 2.55, 25.0, 2.0, 0.08}}};

const Kind& drawn_kind(Random& random) {
  double left = uniform(random, 0.0, 1.0);
  for (const Kind& kind : kinds) {
    left -= kind.share;
    if (left < 0.0) {
      return kind;
    }
  }
  return kinds.back();
}

/// Two of five along the ego's way, one against it, two on any course.
double drawn_course(Random& random) {
  const double which = uniform(random, 0.0, 1.0);
  const double about = uniform(random, -from_degrees(10.0), from_degrees(10.0));
  if (which < 0.4) {
    return about;
  }
  return which < 0.6 ? wrap_angle(std::numbers::pi + about)
                     : uniform(random, -std::numbers::pi, std::numbers::pi);
}

/// Seven of ten within 20 degrees of where the ego goes.
double drawn_bearing(Random& random) {
  return happens(random, 0.7) ? uniform(random, -from_degrees(20.0), from_degrees(20.0))
                              : uniform(random, -std::numbers::pi, std::numbers::pi);
}

Obstacle at(const State& state, Obstacle obstacle, double bearing, double course, double distance) {
  const Pose X_BO{{distance * std::cos(bearing), distance * std::sin(bearing)}, course};
  obstacle.X_WO = state.ego.X_WB * X_BO;
  return obstacle;
}

constexpr double farthest = 100.0;  // [m]

}  // namespace

vehicle::VehicleState drawn_start(const manoeuvre::Car& car, double grip, Random& random) {
  constexpr double fastest = 40.0;  // [m/s]
  constexpr int most_looks = 10;
  const world::EgoState ego{.v_B = {uniform(random, 0.0, fastest), 0.0}};
  DemandDrivenCar driven(car, manoeuvre::rolling_state(car, ego, grip), grip);
  Driver driver(Behaviour::held, random());
  const int looks = std::uniform_int_distribution<int>(0, most_looks)(random);
  for (int i = 0; i < looks; ++i) {
    driven.hold(driver.next(driven.ego()));
  }
  return driven.state();
}

Obstacle drawn_obstacle(Random& random) {
  const Kind& kind = drawn_kind(random);
  Obstacle obstacle;
  obstacle.body = {.length = kind.length * uniform(random, 0.9, 1.1),
                   .width = kind.width * uniform(random, 0.9, 1.1)};
  if (happens(random, 0.3)) {
    return obstacle;
  }
  obstacle.speed = uniform(random, 0.0, kind.top_speed);
  const double speeds_up = uniform(random, 0.0, 1.0);
  if (speeds_up < 0.25) {
    obstacle.acceleration = uniform(random, -8.0, 0.0);
  } else if (speeds_up < 0.4) {
    obstacle.acceleration = uniform(random, 0.0, 3.0);
  }
  if (happens(random, 0.3)) {
    const double most =
        std::min(kind.tightest, kind.sideways / std::max(1e-6, obstacle.speed * obstacle.speed));
    obstacle.curvature = uniform(random, -most, most);
  }
  return obstacle;
}

Obstacle placed_anywhere(const world::Footprint& body, const State& state, Obstacle obstacle,
                         Random& random) {
  const double bearing = drawn_bearing(random);
  const double course = drawn_course(random);
  double distance = uniform(random, 2.0, farthest);
  const auto touches = [&] {
    const Obstacle there = at(state, obstacle, bearing, course, distance);
    return danger::intrusion(body, state.ego.X_WB, there.body, there.X_WO) >= 0.0;
  };
  while (touches()) {
    distance += 1.0;
  }
  return at(state, obstacle, bearing, course, distance);
}

std::optional<Obstacle> placed_near_boundary(const world::Footprint& body, const State& state,
                                             Obstacle obstacle, const CanStayBelow& can_stay_below,
                                             Random& random) {
  constexpr double band = 2.0;     // [m]
  constexpr double good_to = 0.1;  // [m], of the distance
  const double bearing = drawn_bearing(random);
  const double course = drawn_course(random);
  const double wanted = uniform(random, -band, band);
  const auto there = [&](double distance) {
    return at(state, obstacle, bearing, course, distance);
  };
  double near = 0.0;
  double far = farthest;
  if (!can_stay_below(wanted, there(far))) {
    return std::nullopt;
  }
  while (far - near > good_to) {
    const double middle = 0.5 * (near + far);
    (can_stay_below(wanted, there(middle)) ? far : near) = middle;
  }
  const Obstacle placed = there(far);
  const bool apart = danger::intrusion(body, state.ego.X_WB, placed.body, placed.X_WO) < 0.0;
  // Where the ego may pass on either side, the room jumps.
  const bool near_enough = !can_stay_below(-band - good_to, placed);
  return apart && near_enough ? std::optional(placed) : std::nullopt;
}

DrawnObstacles drawn_obstacles(const world::Footprint& body, const State& state,
                               const CanStayBelow& can_stay_below, double near_share,
                               Random& random) {
  std::discrete_distribution<int> more({0.5, 0.3, 0.2});
  const int count = 1 + more(random);
  const bool near = happens(random, near_share);
  DrawnObstacles drawn;
  for (int i = 0; i < count; ++i) {
    std::optional<Obstacle> placed;
    constexpr int tries = 20;
    for (int k = 0; near && !placed && k < tries; ++k) {
      placed = placed_near_boundary(body, state, drawn_obstacle(random), can_stay_below, random);
    }
    drawn.is_near = drawn.is_near || placed.has_value();
    drawn.obstacles.push_back(
        placed ? *placed : placed_anywhere(body, state, drawn_obstacle(random), random));
  }
  return drawn;
}

}  // namespace saca::learned_danger
