#include "saca/lab/learned_danger/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "saca/base/core/percentile.h"
#include "saca/lab/learned_danger/arc_evasions.h"
#include "saca/lab/learned_danger/draws.h"
#include "saca/thinking/danger/car_limits.h"

namespace saca::learned_danger {
namespace {

using manoeuvre::Demand;

Situation drawn_situation(const manoeuvre::Car& car, const world::Footprint& body, Random& random) {
  constexpr double near_share = 0.5;
  Situation situation;
  situation.grip = uniform(random, 0.2, 1.0);
  situation.car = drawn_start(car, situation.grip, random);
  const State state = state_of(car, situation);
  const ArcEvasions arcs(danger::avoidance_of(car, 1.0), body, state);
  situation.obstacles =
      drawn_obstacles(
          body, state,
          [&](double level, const Obstacle& there) { return arcs.stay_below(level, there); },
          near_share, random)
          .obstacles;
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

/// For one of the obstacles, whatever the others do.
Policy best_arc(const manoeuvre::Car& car, const world::Footprint& body, std::size_t obstacle) {
  return [limits = danger::avoidance_of(car, 1.0), body, obstacle](const State& state, double) {
    return ArcEvasions(limits, body, state).best(state.obstacles[obstacle]).demand;
  };
}

/// Drives one situation by this and that.
class Trials {
 public:
  Trials(const manoeuvre::Car& car, const world::Footprint& body, const Network& network,
         const Situation& situation)
      : car_(car), body_(body), network_(network), situation_(situation) {}

  [[nodiscard]] double by_evasion() const {
    return by([this, limits = danger::avoidance_of(car_, 1.0)](const State& now, double) {
      return evasion(limits, network_, body_, now);
    });
  }
  /// Without what was learnt.
  [[nodiscard]] double best_of_all() const {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < situation_.obstacles.size(); ++k) {
      best = std::min(best, by(best_arc(car_, body_, k)));
    }
    for (const auto& steps : sequences) {
      best = std::min(best, by(held(steps)));
    }
    return best;
  }
  /// Whether some drive evades each obstacle as if it were alone.
  [[nodiscard]] bool each_alone_is_evaded() const {
    return std::all_of(situation_.obstacles.begin(), situation_.obstacles.end(),
                       [this](const Obstacle& obstacle) {
                         Situation alone = situation_;
                         alone.obstacles.clear();
                         alone.obstacles.push_back(obstacle);
                         const Trials trials(car_, body_, network_, alone);
                         return trials.best_of_all() < 0.0 || trials.by_evasion() < 0.0;
                       });
  }

 private:
  [[nodiscard]] double by(const Policy& policy) const {
    return highest_h(car_, body_, situation_, policy);
  }

  const manoeuvre::Car& car_;
  const world::Footprint& body_;
  const Network& network_;
  const Situation& situation_;
};

CheckedCase told_of(const manoeuvre::Car& car, const Network& network, const world::Footprint& body,
                    const State& state) {
  return {.speed = norm(state.ego.v_B),
          .grip = state.grip,
          .num_obstacles = state.obstacles.size(),
          .is_straight = straight_evasion(danger::avoidance_of(car, 1.0), body, state).has_value(),
          .told = joint_v(network, body, state),
          .told_alone = highest_single_v(network, body, state)};
}

}  // namespace

CheckedCase checked(const manoeuvre::Car& car, const world::Footprint& body, const Network& network,
                    std::uint64_t seed) {
  Random random(seed);
  const Situation situation = drawn_situation(car, body, random);
  const Trials trials(car, body, network, situation);
  CheckedCase result = told_of(car, network, body, state_of(car, situation));
  result.acted = trials.by_evasion();
  result.best = std::min(result.acted, trials.best_of_all());
  result.is_pincer =
      result.num_obstacles > 1 && result.best >= 0.0 && trials.each_alone_is_evaded();
  return result;
}

MarginSample driven_by_evasion(const manoeuvre::Car& car, const world::Footprint& body,
                               const Network& network, std::uint64_t seed,
                               const std::array<bool, num_bins>& wanted) {
  Random random(seed);
  const Situation situation = drawn_situation(car, body, random);
  const CheckedCase told = told_of(car, network, body, state_of(car, situation));
  MarginSample result{.bin = bin_of(told.is_straight, told.speed, told.grip, told.num_obstacles),
                      .told = told.told,
                      .acted = std::nullopt};
  if (result.told < 0.0 && wanted[result.bin]) {
    result.acted = Trials(car, body, network, situation).by_evasion();
  }
  return result;
}

CheckFigures figures_of(const std::vector<CheckedCase>& all,
                        const std::function<double(const CheckedCase&)>& margin) {
  constexpr double near = 2.0;       // [m]
  constexpr double just_safe = 1.0;  // [m]
  CheckFigures figures;
  std::vector<double> errors;
  const auto add = [](Share& share, bool counts) {
    ++share.of;
    share.count += counts ? 1 : 0;
  };
  for (const CheckedCase& one : all) {
    const double told = one.told + margin(one);
    const bool told_safe = told < 0.0;
    const bool is_safe = one.best < 0.0;
    if (told_safe) {
      add(figures.hit_given_told_safe, one.acted >= 0.0);
    }
    if (told_safe && told >= -just_safe) {
      add(figures.hit_given_just_safe, one.acted >= 0.0);
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
    if (one.num_obstacles > 1) {
      add(figures.pincers, one.is_pincer);
    }
    if (one.is_pincer) {
      add(figures.told_of_pincers, !told_safe);
      add(figures.told_alone_of_pincers, one.told_alone + margin(one) >= 0.0);
    }
  }
  const double num_near = std::max(1.0, static_cast<double>(errors.size()));
  figures.mean_error_near /= num_near;
  figures.bias_near /= num_near;
  figures.lost_near /= num_near;
  figures.p99_error_near = errors.empty() ? 0.0 : percentile(errors, 0.99);
  return figures;
}

}  // namespace saca::learned_danger
