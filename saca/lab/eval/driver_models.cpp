#include "saca/lab/eval/driver_models.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace saca::eval {
namespace {

using encounter::Action;
using manoeuvre::PolicyId;

/// Below this nobody brakes, nor lets a brake's law divide by nothing [m/s^2].
constexpr double least_braking = 0.05;

Action braking(double deceleration) {
  return {.plan = {PolicyId::aeb, std::nullopt},
          .deceleration = std::max(least_braking, deceleration)};
}

}  // namespace

std::optional<Action> Reacting::step(double time, bool risk) {
  if (!seen_ && risk) {
    seen_ = time;
  }
  if (!seen_ || time < *seen_ + reaction_ || asked_ >= most_) {
    return std::nullopt;
  }
  const double since = time - (*seen_ + reaction_);
  asked_ = std::isinf(jerk_) ? most_ : std::min(most_, jerk_ * since);
  return braking(asked_);
}

std::optional<Action> R157Braking::step(const encounter::View& view) {
  constexpr double deceleration = 6.0;  // [m/s^2]
  constexpr double delay = 0.35;        // [s]
  constexpr double near_path = 0.5;     // [m] beside the ego
  bool risk = false;
  for (const world::Actor& actor : view.scene.actors) {
    LaneView one = lane_view(view.scene, actor);
    if (one.side_gap <= near_path) {
      one.side_gap = std::min(0.0, one.side_gap);
      const auto time = time_to_collision(one);
      risk = risk || (time && *time <= (one.ego_speed - one.speed) / (2.0 * deceleration) + delay);
    }
  }
  return reacting_.step(view.scene.time, risk);
}

std::optional<Action> CompetentDriver::step(const encounter::View& view) {
  constexpr double critical = 2.0;  // [s]
  const bool risk = std::any_of(view.scene.actors.begin(), view.scene.actors.end(),
                                [&](const world::Actor& actor) {
                                  const auto time = time_to_collision(lane_view(view.scene, actor));
                                  return time && *time <= critical;
                                });
  return reacting_.step(view.scene.time, risk);
}

FuzzySurrogates fuzzy_surrogates(double gap, double speed, double ahead, double acceleration) {
  constexpr double reaction = 0.75;    // [s]
  constexpr double comfortable = 4.0;  // [m/s^2] of who follows
  constexpr double hardest = 6.0;      // likewise
  constexpr double lead = 7.0;         // [m/s^2] of who is ahead
  constexpr double margin = 2.0;       // [m] twice: what is kept at rest, and what is safe
  const auto between = [](double value, double safe, double unsafe) {
    return value > safe ? 0.0 : value < unsafe ? 1.0 : (value - safe) / (unsafe - safe);
  };
  FuzzySurrogates both;
  const double other = ahead * ahead / (2.0 * lead);
  both.proactive =
      between(gap - margin, speed * reaction + speed * speed / (2.0 * comfortable) - other + margin,
              speed * reaction + speed * speed / (2.0 * hardest) - other);
  if (speed <= ahead) {
    return both;
  }
  const double held = std::max(acceleration, -comfortable);
  const double then = speed + reaction * held - ahead;  // closing speed
  if (then < 0.0) {
    both.critical =
        gap < (speed - ahead) * (speed - ahead) / (2.0 * std::abs(acceleration)) ? 1.0 : 0.0;
    return both;
  }
  const double way = (speed + 0.5 * held * reaction - ahead) * reaction;
  both.critical =
      between(gap, way + then * then / (2.0 * comfortable), way + then * then / (2.0 * hardest));
  return both;
}

std::optional<Action> FuzzySafety::step(const encounter::View& view) {
  constexpr double reaction = 0.75;  // [s]
  const auto looks_to_react = std::lround(reaction / encounter::ClosedLoop::step);
  constexpr double comfortable = 4.0;  // [m/s^2]
  constexpr double hardest = 6.0;      // [m/s^2]
  constexpr double jerk = 12.65;       // [m/s^3]
  constexpr double soon = 0.1;         // [s] by which who moves in must be there before the ego
  FuzzySurrogates worst;
  for (const world::Actor& actor : view.scene.actors) {
    const LaneView one = lane_view(view.scene, actor);
    const double closing = one.ego_speed - one.speed;
    if (!one.ahead) {
      continue;
    }
    if (one.side_gap > 0.0) {  // it counts when it will be in the path before the ego has passed
      const double passed = one.gap + actor.footprint.length + view.scene.ego_footprint.length;
      if (one.closing_aside <= 0.0 || closing <= 0.0 ||
          one.side_gap / one.closing_aside > passed / closing + soon) {
        continue;
      }
    }
    const FuzzySurrogates here =
        fuzzy_surrogates(one.gap, one.ego_speed, std::max(0.0, one.speed), view.scene.ego.a_B.x);
    worst.proactive = std::max(worst.proactive, here.proactive);
    worst.critical = std::max(worst.critical, here.critical);
  }
  if (worst.proactive + worst.critical <= 0.0) {
    return std::exchange(brakes_, false)
               ? std::optional(Action{.plan = {PolicyId::no_intervention, std::nullopt}})
               : std::nullopt;
  }
  if (looks_ < looks_to_react) {
    ++looks_;
    return std::nullopt;
  }
  const double wanted = worst.critical > 0.0
                            ? comfortable + worst.critical * (hardest - comfortable)
                            : worst.proactive * comfortable;
  asked_ = std::max(least_braking, std::min(asked_ + jerk * encounter::ClosedLoop::step, wanted));
  brakes_ = true;
  return braking(asked_);
}

}  // namespace saca::eval
