#include "saca/danger/check.h"

#include <algorithm>
#include <array>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <optional>

#include "saca/core/percentile.h"
#include "saca/danger/arc_evasions.h"
#include "saca/danger/draws.h"
#include "saca/reach/car_limits.h"

namespace saca::danger {
namespace {

using manoeuvre::Demand;

Situation drawn_situation(const manoeuvre::Car& car, const world::Footprint& body, Random& random) {
  Situation situation;
  situation.grip = uniform(random, 0.2, 1.0);
  situation.car = drawn_start(car, situation.grip, random);
  const State state = state_of(car, situation);
  const Obstacle obstacle = drawn_obstacle(random);
  std::optional<Obstacle> placed;
  if (happens(random, 0.5)) {
    const ArcEvasions arcs(reach::avoidance_of(car, 1.0), body, state);
    placed = placed_near_boundary(
        body, state, obstacle,
        [&](double level, const Obstacle& there) { return arcs.stay_below(level, there); }, random);
  }
  situation.obstacles.push_back(placed ? *placed : placed_anywhere(body, state, obstacle, random));
  return situation;
}

/// What is held for a while, then another.
struct Step {
  Demand demand;
  double until;  ///< [s]
};
constexpr double for_ever = 1e9;
constexpr double diagonal = 0.70710678118654752;
const std::array<std::array<Step, 3>, 10> sequences{{
    {{{{-1.0, 0.0}, for_ever}}},
    {{{{0.0, 0.0}, for_ever}}},
    {{{{1.0, 0.0}, for_ever}}},
    {{{{0.0, 1.0}, 0.7}, {{0.0, -1.0}, 1.4}, {{-1.0, 0.0}, for_ever}}},
    {{{{0.0, -1.0}, 0.7}, {{0.0, 1.0}, 1.4}, {{-1.0, 0.0}, for_ever}}},
    {{{{0.0, 1.0}, for_ever}}},
    {{{{0.0, -1.0}, for_ever}}},
    {{{{-diagonal, diagonal}, for_ever}}},
    {{{{-diagonal, -diagonal}, for_ever}}},
    {{{{-0.5, 0.0}, for_ever}}},
}};

Policy held(const std::array<Step, 3>& steps) {
  return [&steps](const State& /*state*/, double time) {
    const auto* const now = std::find_if(steps.begin(), steps.end(),
                                         [&](const Step& step) { return time < step.until; });
    return now != steps.end() ? now->demand : Demand{};
  };
}

Policy best_arc(const manoeuvre::Car& car, const world::Footprint& body) {
  return [limits = reach::avoidance_of(car, 1.0), body](const State& state, double /*time*/) {
    return ArcEvasions(limits, body, state).best(state.obstacles[0]).demand;
  };
}

}  // namespace

Checked checked(const manoeuvre::Car& car, const world::Footprint& body, const Network& network,
                std::uint64_t seed) {
  Random random(seed);
  const Situation situation = drawn_situation(car, body, random);
  const State state = state_of(car, situation);
  Checked result{.speed = norm(state.ego.v_B), .grip = situation.grip};
  result.told = joint_v(network, body, state);
  const auto by = [&](const Policy& policy) { return highest_h(car, body, situation, policy); };
  result.acted = by([&](const State& now, double) { return least_q(network, body, now); });
  result.best = std::min(result.acted, by(best_arc(car, body)));
  for (const auto& steps : sequences) {
    result.best = std::min(result.best, by(held(steps)));
  }
  return result;
}

double upper_bound(const Share& share, double confidence) {
  if (share.count >= share.of) {
    return 1.0;
  }
  using Binomial = boost::math::binomial_distribution<double>;
  return Binomial::find_upper_bound_on_p(share.of, share.count, 1.0 - confidence);
}

double margin_of(const std::vector<Checked>& all) {
  constexpr double beyond = 0.01;  // [m]
  double margin = 0.0;
  for (const Checked& one : all) {
    if (one.acted >= 0.0) {
      margin = std::max(margin, beyond - one.told);
    }
  }
  return margin;
}

CheckFigures figures_of(const std::vector<Checked>& all, double margin) {
  constexpr double near = 2.0;  // [m]
  CheckFigures figures;
  std::vector<double> errors;
  const auto add = [](Share& share, bool counts) {
    ++share.of;
    share.count += counts ? 1 : 0;
  };
  for (const Checked& one : all) {
    const bool told_safe = one.told + margin < 0.0;
    const bool is_safe = one.best < 0.0;
    if (told_safe) {
      add(figures.hit_given_told_safe, one.acted >= 0.0);
    }
    if (is_safe) {
      add(figures.false_alarms, !told_safe);
    } else {
      add(figures.told_safe_given_hit, told_safe);
    }
    if (std::abs(one.best) < near) {
      add(figures.agreeing_near, told_safe == is_safe);
      const double error = one.told - one.best;
      errors.push_back(std::abs(error));
      figures.mean_error_near += std::abs(error);
      figures.bias_near += error;
      figures.lost_near += one.acted - one.best;
    }
  }
  const double num_near = std::max(1.0, static_cast<double>(errors.size()));
  figures.mean_error_near /= num_near;
  figures.bias_near /= num_near;
  figures.lost_near /= num_near;
  figures.p99_error_near = errors.empty() ? 0.0 : percentile(errors, 0.99);
  return figures;
}

}  // namespace saca::danger
