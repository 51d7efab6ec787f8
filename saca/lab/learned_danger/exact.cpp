#include "saca/lab/learned_danger/exact.h"

#include <limits>

#include "saca/onboard/vehicle/vehicle.h"
#include "saca/thinking/danger/follow.h"

namespace saca::learned_danger {

std::optional<double> exact_value(const danger::DangerModel& model, const world::Footprint& body,
                                  const State& state, const Obstacle& obstacle) {
  const bool keeps_on = obstacle.acceleration == 0.0 && obstacle.curvature == 0.0;
  return keeps_on ? model.exact(meeting_of(body, state, obstacle)) : std::nullopt;
}

std::optional<manoeuvre::Demand> exact_best(const danger::DangerModel& model,
                                            danger::Avoidance limits, const world::Footprint& body,
                                            const State& state, const Obstacle& obstacle) {
  constexpr double ahead = 0.2;  // [s]
  if (!exact_value(model, body, state, obstacle)) {
    return std::nullopt;
  }
  const danger::Meeting meeting = meeting_of(body, state, obstacle);
  limits.grip = state.grip;
  limits.obstacle_speed = meeting.obstacle_speed;
  const auto value = [&](const danger::State& at) {
    danger::Meeting later = meeting;
    later.state = at;
    return model.exact(later).value_or(std::numeric_limits<double>::infinity());
  };
  const danger::Acceleration best = danger::by_look_ahead(limits, value, ahead)(meeting.state);
  const double most = state.grip * vehicle::gravity;
  return manoeuvre::admissible({best.along / most, best.across / most});
}

}  // namespace saca::learned_danger
