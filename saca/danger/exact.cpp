#include "saca/danger/exact.h"

#include <limits>

#include "saca/reach/follow.h"
#include "saca/vehicle/vehicle.h"

namespace saca::danger {

std::optional<double> exact_value(const reach::DangerModel& model, const world::Footprint& body,
                                  const State& state, const Obstacle& obstacle) {
  const bool keeps_on = obstacle.acceleration == 0.0 && obstacle.curvature == 0.0;
  return keeps_on ? model.exact(meeting_of(body, state, obstacle)) : std::nullopt;
}

std::optional<manoeuvre::Demand> exact_best(const reach::DangerModel& model,
                                            reach::Avoidance limits, const world::Footprint& body,
                                            const State& state, const Obstacle& obstacle) {
  constexpr double ahead = 0.2;  // [s]
  if (!exact_value(model, body, state, obstacle)) {
    return std::nullopt;
  }
  const reach::Meeting meeting = meeting_of(body, state, obstacle);
  limits.grip = state.grip;
  limits.obstacle_speed = meeting.obstacle_speed;
  const auto value = [&](const reach::State& at) {
    reach::Meeting later = meeting;
    later.state = at;
    return model.exact(later).value_or(std::numeric_limits<double>::infinity());
  };
  const reach::Acceleration best = reach::by_look_ahead(limits, value, ahead)(meeting.state);
  const double most = state.grip * vehicle::gravity;
  return manoeuvre::admissible({best.along / most, best.across / most});
}

}  // namespace saca::danger
