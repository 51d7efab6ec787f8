#include "saca/lab/families/family_vehicles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saca/base/core/angle.h"
#include "saca/base/core/quintic.h"
#include "saca/base/core/units.h"
#include "saca/lab/scenario/turn.h"

namespace saca::families {
namespace {

using world::ActorKind;

/// When a move to the side has gone so far, as a share of the time that it takes.
double when_moved(double share) {
  double low = 0.0;
  double high = 1.0;
  constexpr int halvings = 40;
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (low + high);
    (quintic(middle) < share ? low : high) = middle;
  }
  return high;
}

bool heads_along(double heading) {
  return std::abs(std::sin(heading)) < 1e-6;
}

/// Where across the road the arc begins.
double arc_aside(const scenario::Turn& turn, double lane) {
  if (heads_along(turn.heading)) {
    return lane;
  }
  const double end = turn.heading + turn.angle;
  const double target = heads_along(end) && std::cos(end) < 0.0 ? lane : 0.0;
  return target - turn.pose(turn.arc_length()).p.y;
}

/// The way along the turn at which it is first in the middle of our lane.
double meets_our_lane(const scenario::Turn& turn, double aside) {
  constexpr double step = 0.05;  // [m]
  constexpr double near = 0.1;   // [m]
  const int num_steps = static_cast<int>(2.0 * (std::abs(aside) + turn.arc_length()) / step);
  int best = -num_steps;
  for (int k = -num_steps; k <= num_steps; ++k) {
    const double d = std::abs(aside + turn.pose(step * k).p.y);
    if (d < near) {
      return step * k;
    }
    if (d < std::abs(aside + turn.pose(step * best).p.y)) {
      best = k;
    }
  }
  return step * best;
}

}  // namespace

Harmless slower_lead(Stage& stage) {
  constexpr double least_closing = 4.0;  // [m/s]
  Dice& dice = stage.dice;
  const ActorKind kind = stage.any_vehicle();
  const double pace =
      std::clamp(dice.in("lead_mps"), 0.0, std::max(0.0, stage.speed - least_closing));
  const double s = stage.head() + 0.5 * Stage::length_of(kind) - pace * Stage::approach;
  stage.add(kind, {.start = {s, dice.in("offset_m"), 0.0}, .speed = pace});
  stage.decision = Stage::approach - Stage::trigger;
  return std::nullopt;
}

Harmless sideswipe(Stage& stage) {
  Dice& dice = stage.dice;
  const ActorKind kind = stage.any_vehicle();
  const double side = dice.side("from_left_share");
  const double pace = dice.in("other_speed_mps");
  const double takes = dice.in("takes_s");
  stage.want_lane(side);
  const double between_sides = 0.5 * (stage.width + Stage::width_of(kind));
  const double begins =
      Stage::approach - takes * when_moved(1.0 - std::min(1.0, between_sides / stage.lane()));
  const double length = stage.front + stage.rear;
  const double overlap = 0.1 * std::min(length, Stage::length_of(kind));
  const double most = 0.5 * (length + Stage::length_of(kind)) - overlap;
  const double beside = std::clamp(dice.in("beside_ahead_m"), -most, most);
  const double centre = stage.speed * Stage::approach + 0.5 * (stage.front - stage.rear);
  const world::LanePose start{centre + beside - pace * Stage::approach, side * stage.lane(), 0.0};
  stage.add(kind, changing_lane(start, pace, 0.0, std::max(0.0, begins), takes));
  stage.decision = Stage::approach - Stage::trigger;
  return scenario::Script{.start = start, .speed = pace};
}

Harmless turning(Stage& stage) {
  Dice& dice = stage.dice;
  const ActorKind kind = stage.any_vehicle();
  const double pace = dice.in("other_speed_mps");
  const scenario::Turn turn{.heading = from_degrees(dice.in("from_deg")),
                            .angle = from_degrees(dice.in("turn_deg")),
                            .radius = dice.in("radius_m")};
  const double late = dice.in("late_s");
  const double aside = arc_aside(turn, stage.lane());
  if (std::max(aside, aside + turn.pose(turn.arc_length()).p.y) > 0.5 * stage.lane()) {
    stage.widen(1.0, 1.5 * stage.lane());
    stage.left_lane = true;
    stage.scenario.road.oncoming_left = true;
  }
  const double along = meets_our_lane(turn, aside);
  const Pose met = turn.pose(along);
  const double half = 0.5 * (std::abs(std::cos(met.yaw)) * Stage::length_of(kind) +
                             std::abs(std::sin(met.yaw)) * Stage::width_of(kind));
  const Vec2 begins{stage.head() + half - met.p.x, aside};
  const double at_arc = Stage::approach + late - along / pace;
  const scenario::Recording recording =
      scenario::recording_of(turn, begins, at_arc, pace, stage.scenario.duration);
  stage.add(kind, {}).motion = recording;
  stage.decision = Stage::approach - Stage::trigger;
  // The twin waits where it would turn, or before our lane and whatever lane lies before it.
  const Pose start = recording.front().X_WA;
  const double lanes = aside > 0.0 && stage.left_lane ? 1.5 : 0.5;
  const double before =
      heads_along(turn.heading) ? pace * at_arc : std::abs(start.p.y) - lanes * stage.lane() - 1.0;
  const double room = before - 0.5 * Stage::length_of(kind);
  if (!(room > 0.0)) {
    return std::nullopt;
  }
  return stopping_after({.start = {start.p.x, start.p.y, turn.heading}, .speed = pace}, room);
}

}  // namespace saca::families
