#include "saca/lab/learned_danger/obstacle.h"

#include <algorithm>
#include <cmath>

namespace saca::learned_danger {

Obstacle after(const Obstacle& obstacle, double time) {
  Obstacle later = obstacle;
  double moving = time;
  if (obstacle.acceleration < 0.0) {
    moving = std::min(time, -obstacle.speed / obstacle.acceleration);
  }
  const double way = moving * (obstacle.speed + 0.5 * obstacle.acceleration * moving);
  later.speed = std::max(0.0, obstacle.speed + obstacle.acceleration * moving);
  const double turned = obstacle.curvature * way;
  // The chord of an arc points half of its turn to the side; sin(x) / x near 0 is 1.
  const double half = 0.5 * turned;
  const double chord = way * (std::abs(half) < 1e-6 ? 1.0 : std::sin(half) / half);
  later.X_WO = obstacle.X_WO * Pose{{chord * std::cos(half), chord * std::sin(half)}, turned};
  return later;
}

}  // namespace saca::learned_danger
