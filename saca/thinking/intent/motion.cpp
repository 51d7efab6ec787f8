#include "saca/thinking/intent/motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "saca/base/core/contract.h"
#include "saca/base/core/quintic.h"
#include "saca/thinking/intent/line.h"
#include "saca/thinking/intent/vru.h"

namespace saca::intent {
namespace {

using world::Actor;
using world::ActorKind;
using world::Scene;

constexpr double step = motion_step;
constexpr double least_scale = 0.1;     // nearer the centre of a bend there is no lane
constexpr double settling_speed = 0.2;  // [m/s], assumption: less is wavering within the lane

/// A deceleration that rises from `first` to `full` within `rise`, and stays, until rest.
class Slowing {
 public:
  Slowing(double speed, double first, double full, double rise)
      : speed_(speed), first_(first), full_(full), rise_(rise), rest_(time_of_rest()) {}

  [[nodiscard]] double moving(double time) const { return std::min(time, rest_); }
  [[nodiscard]] double way(double time) const {
    const double t = moving(time);
    return speed_ * t - 0.5 * first_ * t * t - (full_ - first_) * risen_way(t);
  }
  /// Derivative of the way by the logarithm of `full`, as a size. After rest it is that at rest:
  /// the speed there is 0, so when that comes does not matter.
  [[nodiscard]] double way_per_log(double time) const { return full_ * risen_way(moving(time)); }

 private:
  /// What a deceleration that rises to 1 within `rise` takes off speed and way until t.
  [[nodiscard]] double risen_speed(double t) const {
    return t < rise_ ? 0.5 * t * t / rise_ : t - 0.5 * rise_;
  }
  [[nodiscard]] double risen_way(double t) const {
    if (t < rise_) {
      return t * t * t / (6.0 * rise_);
    }
    const double after = t - rise_;
    return rise_ * rise_ / 6.0 + 0.5 * rise_ * after + 0.5 * after * after;
  }
  [[nodiscard]] double time_of_rest() const {
    if (full_ <= 0.0) {
      return std::numeric_limits<double>::infinity();
    }
    const double after_rise = speed_ - first_ * rise_ - (full_ - first_) * risen_speed(rise_);
    if (after_rise >= 0.0) {
      return rise_ + after_rise / full_;
    }
    const double jerk = (full_ - first_) / rise_;
    return 2.0 * speed_ / (first_ + std::sqrt(first_ * first_ + 2.0 * jerk * speed_));
  }

  double speed_;
  double first_;
  double full_;
  double rise_;
  double rest_;
};

/// 0 to 0 with slope 1 at the beginning and 0 at the end, and zero curvature at both.
double fading(double x) {
  const double left = 1.0 - x;
  return x * left * left * left * (1.0 + 3.0 * x);
}
double fading_slope(double x) {
  return 1.0 + x * x * (-18.0 + x * (32.0 - 15.0 * x));
}

/// The share of a lane change's time after which this share of its way is made.
double time_share(double way_share) {
  double low = 0.0;
  double high = 1.0;
  constexpr int halvings = 40;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (quintic(middle) < way_share ? low : high) = middle;
  }
  return low;
}

/// A move to the side over the way driven.
struct Aside {
  double way = 0.0;     ///< to the left [m]
  double slope = 0.0;   ///< sideways per way driven, at the beginning [-]
  double length = 1.0;  ///< of way driven [m], > 0

  [[nodiscard]] double share(double driven) const { return std::clamp(driven / length, 0.0, 1.0); }
  [[nodiscard]] double at(double driven) const {
    const double x = share(driven);
    return way * quintic(x) + slope * length * fading(x);
  }
  [[nodiscard]] double slope_at(double driven) const {
    const double x = share(driven);
    return std::clamp(way / length * quintic_slope(x) + slope * fading_slope(x), -1.0, 1.0);
  }
  /// Derivative of the place across by the logarithm of the duration, as a size; once it was at its
  /// largest, that: nobody knows better later where it drives.
  [[nodiscard]] double way_per_log(double driven) const {
    constexpr double of_the_largest = 0.6;  // x^3 (1 - x)^2
    const double x = std::min(share(driven), of_the_largest);
    return std::abs(way) * x * quintic_slope(x);
  }
};

double side_of(Intention intention) {
  switch (intention) {
    case Intention::lane_left:
    case Intention::brake_left:
      return 1.0;
    case Intention::lane_right:
    case Intention::brake_right:
      return -1.0;
    default:
      return 0.0;
  }
}

/// Way to the left [m] to where it is going to drive.
double way_aside(const Line& line, double side) {
  const double quarter = 0.25 * line.road.lane_width;
  if (side == 0.0) {
    const bool settles = std::abs(line.offset) > quarter &&
                         std::abs(line.lateral) > settling_speed &&
                         line.lateral * line.offset < 0.0;
    return settles ? -line.offset : 0.0;
  }
  const double to_centre = -side * line.offset;  // of the lane it is in, in the direction of change
  return side * (to_centre > quarter ? to_centre : to_centre + line.road.lane_width);
}

Aside aside(const Line& line, double side, const MotionLaw& law) {
  const double way = way_aside(line, side);
  if (way == 0.0) {
    return {};
  }
  const double size = std::abs(way);
  const double made = std::max(0.0, 1.0 - size / line.road.lane_width);
  double time = law.lane_change * (1.0 - time_share(made));
  if (line.lateral * way > 0.0) {
    // Longer, and it would overshoot: 1 - quintic(x) is 10 (1 - x)^3 near the end, fading(x) is
    // 4 (1 - x)^3.
    time = std::min(time, 2.5 * size / std::abs(line.lateral));
  }
  constexpr double steepest = 0.5;      // sin 30 deg
  constexpr double peak = 30.0 / 16.0;  // of quintic_slope
  return {.way = way,
          .slope = line.lateral / line.speed,
          .length = std::max(line.speed * time, peak / steepest * size)};
}

bool is_held(const Line& line, const MotionLaw& law) {
  return law.holds && line.deceleration >= braking_mark;
}

Slowing slowing(const Line& line, ActorKind kind, Intention intention, const MotionLaw& law) {
  if (!is_braking(intention)) {
    return {line.speed, 0.0, 0.0, 0.0};
  }
  if (intention == Intention::stop) {
    const double usual = kind == ActorKind::pedestrian ? law.walking_stop : law.cycling_stop;
    const double full = std::max(usual, line.deceleration);
    return {line.speed, full, full, 0.0};
  }
  if (is_held(line, law)) {
    return {line.speed, line.deceleration, line.deceleration, 0.0};
  }
  const double full = std::max(law.braking, line.deceleration);
  const double first = std::clamp(line.deceleration, 0.0, full);
  return {line.speed, first, full, law.braking_rise};
}

void check(const MotionLaw& law) {
  const auto wavers = [](const OrnsteinUhlenbeck& one) { return one.sd >= 0.0 && one.time > 0.0; };
  expects(wavers(law.driving) && wavers(law.walking) && law.braking > 0.0 &&
              law.braking_log_sd >= 0.0 && law.braking_rise >= 0.0 && law.held_log_sd >= 0.0 &&
              law.lane_change > 0.0 && law.lane_change_log_sd >= 0.0 && law.walking_speed > 0.0 &&
              law.walking_stop > 0.0 && law.cycling_stop > 0.0 && law.starting > 0.0 &&
              law.turning > 0.0,
          "a motion law's numbers are in their ranges");
}

Forecast at_rest(const Scene& scene, const Actor& actor, double horizon) {
  const double moves = actor.kind == ActorKind::obstacle ? 0.0 : actor.velocity_sd;
  Forecast forecast{.track = {.start = scene.time, .step = step, .X_WA = {}},
                    .spread = {.start = scene.time, .step = step, .at = {}}};
  const int num_steps = static_cast<int>(std::ceil(horizon / step));
  for (int k = 0; k <= num_steps; ++k) {
    const double sd = std::hypot(actor.position_sd, moves * k * step);
    forecast.track.X_WA.push_back(actor.X_WA);
    forecast.spread.at.push_back({sd, sd});
  }
  return forecast;
}

}  // namespace

// The correlation of an Ornstein-Uhlenbeck process, integrated twice over both times.
double ornstein_uhlenbeck_sd(const OrnsteinUhlenbeck& process, double time) {
  const double x = time / process.time;
  constexpr double small = 0.05;  // below it the sum loses its digits; the next term is x^6 / 72
  const double variance =
      x < small ? x * x * x * x * (0.25 - x / 15.0)
                : 2.0 / 3.0 * x * x * x - x * x + 2.0 - 2.0 * std::exp(-x) * (1.0 + x);
  return process.sd * process.time * process.time * std::sqrt(variance);
}

Forecast motion_under(const Scene& scene, const Actor& actor, Intention intention, double horizon,
                      const MotionLaw& law) {
  expects(horizon > 0.0, "horizon > 0");
  check(law);
  const std::span<const Intention> possible = intentions_of(actor.kind);
  expects(std::find(possible.begin(), possible.end(), intention) != possible.end(),
          "somebody of this kind may intend this");
  if (intention == Intention::cross) {
    return crossing_motion(scene, actor, horizon, law);
  }
  if (actor.kind == ActorKind::obstacle || norm(actor.v_W) < rest_speed) {
    return at_rest(scene, actor, horizon);
  }
  const Line line = line_of(scene, actor);
  const bool brakes = is_braking(intention);
  const Slowing slowed = slowing(line, actor.kind, intention, law);
  const double log_sd = is_held(line, law) ? law.held_log_sd : law.braking_log_sd;
  const OrnsteinUhlenbeck& process = is_vru(actor.kind) ? law.walking : law.driving;
  const Aside moved = is_vru(actor.kind) ? Aside{} : aside(line, side_of(intention), law);

  Forecast forecast{
      .track = {.start = scene.time, .step = step, .X_WA = {actor.X_WA}},
      .spread = {
          .start = scene.time, .step = step, .at = {{actor.position_sd, actor.position_sd}}}};
  double along = 0.0;
  const int num_steps = static_cast<int>(std::ceil(horizon / step));
  for (int k = 1; k <= num_steps; ++k) {
    const double t = k * step;
    const double before = slowed.way(t - step);
    const double driven = slowed.way(t);
    const double d = moved.at(driven);
    const double d_before = moved.at(before);
    // What is driven sideways is not driven along; outside a bend the same way is less of it.
    const double forward =
        std::sqrt(std::max(0.0, std::pow(driven - before, 2.0) - std::pow(d - d_before, 2.0)));
    const double scale = std::abs(1.0 - line.road.curvature * 0.5 * (d + d_before));
    along += forward / std::max(scale, least_scale);
    forecast.track.X_WA.push_back(world::from_lane(
        line.road, {.s = along, .d = d, .heading = line.crab + std::asin(moved.slope_at(driven))}));

    const double perceived = std::hypot(actor.position_sd, actor.velocity_sd * slowed.moving(t));
    const double of_speed =
        brakes ? log_sd * slowed.way_per_log(t) : ornstein_uhlenbeck_sd(process, t);
    const double of_change = law.lane_change_log_sd * moved.way_per_log(driven);
    const double aside_sd = is_vru(actor.kind) && !brakes ? of_speed : of_change;
    forecast.spread.at.push_back(
        {std::hypot(perceived, of_speed), std::hypot(perceived, aside_sd)});
  }
  return forecast;
}

}  // namespace saca::intent
