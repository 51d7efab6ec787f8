#include "saca/thinking/danger/follow.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "saca/base/core/contract.h"

namespace saca::danger {
namespace {

constexpr double longest_part = 0.1;   // [s] of a Runge-Kutta step
constexpr double between_looks = 0.1;  // [m] of way between two looks at the intrusion

/// What is held over a step: a speed's change and either a curvature or an acceleration across.
struct HeldInput {
  double along = 0.0;
  double across = 0.0;
  double curvature = 0.0;  ///< in place of `across` while braking

  [[nodiscard]] double course_rate(double speed) const {
    if (along < 0.0) {
      return curvature * speed;
    }
    return speed > 0.0 ? across / speed : 0.0;
  }
};

/// Nearest admissible input: first across, then along.
Acceleration admissible_input(const Limits& limits, Acceleration input) {
  const double across = std::clamp(input.across, -limits.across, limits.across);
  const double rest = std::sqrt(std::max(0.0, limits.disc * limits.disc - across * across));
  return {std::clamp(input.along, -rest, std::min(rest, limits.drive)), across};
}

State rate_of_state(const Avoidance& system, const State& state, const HeldInput& held) {
  const double speed = std::max(0.0, state[3]);
  return {speed * std::cos(state[2]) - system.obstacle_speed, speed * std::sin(state[2]),
          held.course_rate(speed), held.along};
}

State moved(const State& state, const State& rate, double dt) {
  State next{};
  for (std::size_t i = 0; i < next.size(); ++i) {
    next[i] = state[i] + dt * rate[i];
  }
  return next;
}

State runge_kutta(const Avoidance& system, const State& state, const HeldInput& held, double dt) {
  const State k1 = rate_of_state(system, state, held);
  const State k2 = rate_of_state(system, moved(state, k1, 0.5 * dt), held);
  const State k3 = rate_of_state(system, moved(state, k2, 0.5 * dt), held);
  const State k4 = rate_of_state(system, moved(state, k3, dt), held);
  State next = state;
  for (std::size_t i = 0; i < next.size(); ++i) {
    next[i] += dt / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
  }
  return next;
}

State driven_for(const Avoidance& system, State state, const HeldInput& held, double duration) {
  const int parts = std::max(1, static_cast<int>(std::ceil(duration / longest_part)));
  for (int i = 0; i < parts; ++i) {
    state = runge_kutta(system, state, held, duration / parts);
  }
  return state;
}

/// Fastest that any point of the ego can come nearer to the obstacle [m/s].
double fastest_point(const Avoidance& system, const State& state, double reach) {
  return state[3] + std::abs(system.obstacle_speed) +
         reach * limits_at(system, state[3]).course_rate;
}

}  // namespace

State driven(const Avoidance& system, const State& state, Acceleration input, double duration) {
  expects(duration >= 0.0, "duration >= 0");
  const double speed = state[3];
  const Limits limits = limits_at(system, speed);
  if (speed <= 0.0) {
    return moved(state, {-system.obstacle_speed, 0.0, 0.0, 0.0}, duration);
  }
  const Acceleration taken = admissible_input(limits, input);
  const HeldInput held{taken.along, taken.across, taken.across / (speed * speed)};
  const double until_stopped = taken.along < 0.0 ? speed / -taken.along : duration;
  if (until_stopped > duration) {
    return driven_for(system, state, held, duration);
  }
  State next = driven_for(system, state, held, until_stopped);
  if (taken.along < 0.0) {
    next[3] = 0.0;
    next[0] -= system.obstacle_speed * (duration - until_stopped);
  }
  return next;
}

Steering by_gradient(const Avoidance& system, std::function<State(const State&)> gradient) {
  return [system, slopes = std::move(gradient)](const State& state) {
    return best_input(system, state[3], slopes(state));
  };
}

Steering by_look_ahead(const Avoidance& system, std::function<double(const State&)> value,
                       double ahead, int inputs) {
  expects(ahead > 0.0, "ahead > 0");
  expects(inputs >= 4, "inputs >= 4");
  return [system, value = std::move(value), ahead, inputs](const State& state) {
    const double disc = limits_at(system, state[3]).disc;
    Acceleration best;
    double least = value(driven(system, state, best, ahead));
    for (int i = 0; i < inputs; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / inputs;
      const Acceleration input{disc * std::cos(angle), disc * std::sin(angle)};
      const double after = value(driven(system, state, input, ahead));
      if (after < least) {
        least = after;
        best = input;
      }
    }
    return best;
  };
}

EvasionPath follow(const Avoidance& system, const std::function<double(const State&)>& intrusion,
                   const Steering& steering, const State& start, const FollowSettings& settings) {
  const auto [reach, step, longest] = settings;
  expects(reach > 0.0, "reach > 0");
  expects(step > 0.0, "step > 0");
  expects(longest > 0.0, "longest > 0");
  double h = intrusion(start);
  EvasionPath way{.highest = h, .last = start};
  const int steps = static_cast<int>(std::ceil(longest / step));
  for (int k = 0; k < steps; ++k) {
    const State& state = way.last;
    const bool rests = state[3] <= 0.0 && system.obstacle_speed == 0.0;
    if (rests || (h < 0.0 && intrusion(driven(system, state, {}, 1e-3)) < h)) {
      way.is_settled = true;
      break;
    }
    const Acceleration input = steering(state);
    const double covered = fastest_point(system, state, reach) * step;
    if (h + covered > way.highest) {  // else nothing higher can come within the step
      const int looks = static_cast<int>(std::ceil(covered / between_looks));
      for (int i = 1; i < looks; ++i) {
        way.highest =
            std::max(way.highest, intrusion(driven(system, state, input, step * i / looks)));
      }
    }
    way.last = driven(system, state, input, step);
    h = intrusion(way.last);
    way.highest = std::max(way.highest, h);
    way.duration = (k + 1) * step;
  }
  return way;
}

}  // namespace saca::danger
