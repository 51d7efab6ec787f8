#include "saca/onboard/drivers/driver.h"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/base/core/units.h"

namespace saca::drivers {
namespace {

constexpr double slope_time = 0.2;          // [s], assumption: to see that somebody brakes
constexpr double most_deceleration = 10.0;  // [m/s^2]: no vehicle brakes harder
constexpr double least_counted_gap = 0.01;  // [m]: nearer is as near

bool is_valid(const DriverLaw& law) {
  return std::isfinite(law.desired_speed) && law.desired_speed > 0.0 &&
         std::isfinite(law.time_gap) && law.time_gap >= 0.0 && std::isfinite(law.least_gap) &&
         law.least_gap > 0.0 && std::isfinite(law.acceleration) && law.acceleration > 0.0 &&
         std::isfinite(law.comfortable) && law.comfortable > 0.0 && std::isfinite(law.hardest) &&
         law.hardest > 0.0 && law.reaction >= 0.0 && law.reaction <= longest_reaction;
}

}  // namespace

double idm_acceleration(const DriverLaw& law, double speed, const Ahead& ahead) {
  const double braking_way =
      speed * (speed - ahead.speed) / (2.0 * std::sqrt(law.acceleration * law.comfortable));
  const double wanted_gap = law.least_gap + std::max(0.0, speed * law.time_gap + braking_way);
  const double share = wanted_gap / std::max(ahead.gap, least_counted_gap);
  return law.acceleration *
         (1.0 - std::pow(speed / law.desired_speed, acceleration_exponent) - share * share);
}

DriverLaw content_with(DriverLaw law, double speed, double gap) {
  expects(speed >= 0.0, "speed >= 0");
  expects(!std::isnan(gap), "gap is a number");
  if (std::isinf(gap) && gap > 0.0) {
    return law;  // nobody is ahead
  }
  const double kept = std::max(gap, least_counted_gap);
  law.least_gap = std::min(law.least_gap, kept);
  if (speed > 0.0) {
    const double share = std::pow(speed / law.desired_speed, acceleration_exponent);
    const double while_driving = kept * std::sqrt(std::max(0.0, 1.0 - share)) - law.least_gap;
    law.time_gap = std::clamp(while_driving / speed, 0.0, law.time_gap);
  }
  return law;
}

Driver::Driver(const DriverLaw& law, double speed, double grip, double step)
    : law_(law), speed_(speed), grip_(grip), step_(step) {
  expects(is_valid(law), "a driver's law is finite, > 0 and its reaction at most 3 s");
  expects(speed >= 0.0 && std::isfinite(speed), "speed >= 0");
  expects(grip > 0.0 && std::isfinite(grip), "grip > 0");
  expects(step > 0.0 && std::isfinite(step), "step > 0");
  const double steps = std::round(law.reaction / step);
  expects(steps <= static_cast<double>(longest_delay), "step >= reaction / 300");
  delay_ = static_cast<std::size_t>(steps);
  slope_ = static_cast<std::size_t>(
      std::clamp(std::round(slope_time / step), 1.0, static_cast<double>(longest_slope)));
}

void Driver::look(const Ahead& ahead) {
  Look now{way_ + ahead.gap, ahead.speed, 0};
  if (num_looks_ > 0) {
    // Another body takes its place with a jump; none is farther from where it was predicted.
    constexpr double jump = 0.5;  // [m]
    const Look& before = looks_[(num_looks_ - 1) % capacity];
    const bool the_same = std::abs(now.place - before.place - before.speed * step_) < jump;
    now.steps_known = the_same ? before.steps_known + 1 : 0;
  }
  looks_[num_looks_ % capacity] = now;
  ++num_looks_;
}

double Driver::advance(const Ahead& ahead) {
  look(ahead);
  if (ahead.gap <= 0.0) {
    speed_ = std::min(speed_, std::max(0.0, ahead.speed));
    way_ += speed_ * step_;
    return speed_ * step_;
  }
  const double most = from_g(grip_);
  const double acceleration =
      std::clamp(idm_acceleration(law_, speed_, remembered()), -std::min(law_.hardest, most), most);
  const double before = speed_;
  speed_ = std::max(0.0, before + acceleration * step_);
  const double way = speed_ > 0.0 || acceleration >= 0.0 ? 0.5 * (before + speed_) * step_
                                                         : before * before / (-2.0 * acceleration);
  way_ += way;
  return way;
}

Ahead Driver::remembered() const {
  const std::size_t now = num_looks_ - 1;
  const std::size_t then = now - std::min(now, delay_);  // at first, all that it ever saw
  const Look& look = looks_[then % capacity];
  const double since = static_cast<double>(now - then) * step_;
  const std::size_t steps = std::min(slope_, look.steps_known);
  if (steps == 0 || look.speed <= 0.0) {
    return {look.place + look.speed * since - way_, look.speed};
  }
  const double slower = looks_[(then - steps) % capacity].speed - look.speed;
  const double deceleration =
      std::clamp(slower / (static_cast<double>(steps) * step_), 0.0, most_deceleration);
  const double braking = std::min(since, look.speed / deceleration);  // until it rests
  const double speed = look.speed - deceleration * braking;
  return {look.place + 0.5 * (look.speed + speed) * braking - way_, speed};
}

void Driver::speed_up(double factor) {
  expects(factor > 0.0 && std::isfinite(factor), "factor > 0");
  speed_ *= factor;
  law_.desired_speed *= factor;
}

namespace {

constexpr std::size_t most_corners = 24;  // of an ellipse: 0.9 % of its half axes inside it

struct Outline {
  std::array<Vec2, most_corners> p_L;  ///< along the road: s and d [m]
  std::size_t size = 0;
};

Outline outline(const world::Road& road, const Present& body) {
  const world::Footprint& it = *body.footprint;
  const double a = 0.5 * it.length;
  const double b = it.shape == world::Shape::segment ? 0.0 : 0.5 * it.width;
  Outline all;
  const auto add = [&](Vec2 p_B) {
    const world::LanePose at =
        world::to_lane(road, {body.X_WA * (p_B + Vec2{it.centre_x, 0.0}), 0.0});
    all.p_L[all.size++] = {at.s, at.d};
  };
  if (it.shape != world::Shape::ellipse) {
    for (const Vec2 corner : {Vec2{a, b}, Vec2{-a, b}, Vec2{-a, -b}, Vec2{a, -b}}) {
      add(corner);
    }
    return all;
  }
  for (std::size_t k = 0; k < most_corners; ++k) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / most_corners;
    add({a * std::cos(angle), b * std::sin(angle)});
  }
  return all;
}

// The least s, or seen against the lane the largest, of what of a body lies between two d;
// nullopt: nothing does.
std::optional<double> nearest_within(const world::Road& road, const Present& body, double low,
                                     double high, double direction) {
  const Outline all = outline(road, body);
  std::optional<double> nearest;
  const auto look_at = [&](double s) {
    nearest = nearest ? direction * std::min(direction * *nearest, direction * s) : s;
  };
  for (std::size_t i = 0; i < all.size; ++i) {
    const Vec2 p = all.p_L[i];
    const Vec2 q = all.p_L[(i + 1) % all.size];
    if (p.y > low && p.y < high) {
      look_at(p.x);
    }
    for (const double d : {low, high}) {
      if ((p.y < d) != (q.y < d)) {
        look_at(p.x + (d - p.y) / (q.y - p.y) * (q.x - p.x));
      }
    }
  }
  return nearest;
}

}  // namespace

Present present(const world::Road& road, const world::Footprint& footprint, const Pose& X_WA,
                Vec2 v_W) {
  return {&footprint, X_WA, v_W, world::to_lane(road, X_WA)};
}

LaneDriver::LaneDriver(const world::Road& road, const world::Footprint& footprint, const Pose& X_WA,
                       const Driver& driver)
    : road_(road),
      footprint_(footprint),
      place_(world::to_lane(road, X_WA)),
      direction_(std::cos(place_.heading) >= 0.0 ? 1.0 : -1.0),
      driver_(driver) {}

Ahead LaneDriver::ahead(std::span<const Present> others, std::size_t skip) const {
  const double scale = 1.0 - road_.curvature * place_.d;
  const double front = 0.5 * footprint_.length + footprint_.centre_x;
  const double half_width = 0.5 * footprint_.width;
  Ahead nearest;
  for (std::size_t i = 0; i < others.size(); ++i) {
    if (i == skip) {
      continue;
    }
    const Present& other = others[i];
    const world::LanePose& at = other.place;
    const double radius = world::bounding_radius(*other.footprint);
    if (direction_ * (at.s - place_.s) <= 0.0 || std::abs(at.d - place_.d) >= half_width + radius) {
      continue;  // a cheap look at most of them
    }
    // Within a body, s changes by at most twice the way where the road bends so little.
    const bool bends_little = std::abs(road_.curvature) * (std::abs(at.d) + radius) < 0.5;
    const double least = (direction_ * (at.s - place_.s) - 2.0 * radius) * scale - front;
    if (bends_little && least >= nearest.gap) {
      continue;
    }
    const auto rear =
        nearest_within(road_, other, place_.d - half_width, place_.d + half_width, direction_);
    if (!rear) {
      continue;
    }
    const double gap = direction_ * (*rear - place_.s) * scale - front;
    if (gap < nearest.gap) {
      const Vec2 along_W = rotated({direction_, 0.0}, other.X_WA.yaw - at.heading);
      nearest = {gap, dot(other.v_W, along_W)};
    }
  }
  return nearest;
}

void LaneDriver::advance(const Ahead& ahead) {
  const double scale = 1.0 - road_.curvature * place_.d;
  place_.s += direction_ * driver_.advance(ahead) / scale;
}

Vec2 LaneDriver::velocity() const {
  const double lane_yaw = pose().yaw - place_.heading;
  return rotated({direction_ * driver_.speed(), 0.0}, lane_yaw);
}

void reacting_track(const world::Road& road, const world::Actor& driver, const DriverLaw& law,
                    std::span<const Body> others, const ReactionSpan& span, world::Track& track) {
  const auto& [start, duration, step, grip] = span;
  expects(duration >= 0.0, "duration >= 0");
  expects(step > 0.0, "step > 0");
  expects(others.size() <= world::max_actors, "at most max_actors others");
  LaneDriver it(road, driver.footprint, driver.X_WA, Driver(law, norm(driver.v_W), grip, step));
  const auto num_steps = static_cast<std::size_t>(std::ceil(duration / step - 1e-9));
  track.start = start;
  track.step = step;
  track.X_WA.clear();
  track.X_WA.reserve(num_steps + 1);
  track.X_WA.push_back(driver.X_WA);
  std::array<Present, world::max_actors> all;
  const std::span now(all.data(), others.size());
  for (std::size_t k = 0; k < num_steps; ++k) {
    const double time = start + static_cast<double>(k) * step;
    std::transform(others.begin(), others.end(), now.begin(), [&](const Body& body) {
      return drivers::present(road, *body.footprint, world::pose_at(*body.track, time),
                              world::velocity_at(*body.track, time));
    });
    it.advance(it.ahead(now));
    track.X_WA.push_back(it.pose());
  }
}

world::Track reacting_track(const world::Road& road, const world::Actor& driver,
                            const DriverLaw& law, std::span<const Body> others,
                            const ReactionSpan& span) {
  world::Track track;
  reacting_track(road, driver, law, others, span, track);
  return track;
}

}  // namespace saca::drivers
