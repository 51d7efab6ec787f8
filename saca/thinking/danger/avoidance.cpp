#include "saca/thinking/danger/avoidance.h"

#include "saca/base/core/contract.h"
#include "saca/base/core/units.h"

namespace saca::danger {
namespace {

int sign_of(double rate) {
  return rate < 0.0 ? -1 : 1;  // a rate of 0 needs no difference: any one does
}

}  // namespace

Limits limits_at(const Avoidance& car, double speed) {
  expects(speed >= 0.0 && std::isfinite(speed), "speed >= 0");
  expects(car.grip > 0.0 && std::isfinite(car.grip), "grip > 0");
  expects(car.tightest_curvature > 0.0 && std::isfinite(car.tightest_curvature),
          "tightest_curvature > 0");
  expects(car.drive_share >= 0.0 && car.drive_share <= 1.0, "drive_share in [0, 1]");
  if (speed <= 0.0) {
    return {};
  }
  Limits limits{.speed = speed, .disc = from_g(car.grip), .per_speed = 1.0 / speed};
  limits.drive = car.drive_share * limits.disc;
  limits.across = std::min(limits.disc, car.tightest_curvature * speed * speed);
  const auto beside = [&](double a) { return std::sqrt(limits.disc * limits.disc - a * a); };
  limits.across_driven = std::min(limits.across, beside(limits.drive));
  limits.braked_across = beside(limits.across);
  limits.driven_across = std::min(limits.drive, limits.braked_across);
  limits.course_rate = limits.across * limits.per_speed;
  return limits;
}

Avoidance::Row Avoidance::row(const std::array<double, 4>& state) const {
  const double course = state[2];
  const double speed = state[3];
  Row row{speed * std::cos(course) - obstacle_speed, speed * std::sin(course),
          limits_at(*this, speed)};
  row.direction = {sign_of(row.x_rate), sign_of(row.y_rate), 0, 0};
  return row;
}

EdgeAvoidance::Row EdgeAvoidance::row(const std::array<double, 3>& state) const {
  const double course = state[1];
  const double speed = state[2];
  Row row{speed * std::sin(course), limits_at(car, speed)};
  row.direction = {sign_of(row.y_rate), 0, 0};
  return row;
}

Acceleration best_input(const Avoidance& car, double speed, const std::array<double, 4>& gradient) {
  const Limits limits = limits_at(car, speed);
  const double q = std::abs(gradient[2]) * limits.per_speed;
  const double slope = gradient[3];
  const double size = std::hypot(q, slope);
  if (!(size > 0.0) || limits.speed <= 0.0) {
    return {};
  }
  const double free = limits.disc * (q / size);
  const bool drives = slope < 0.0;
  const double across =
      std::min(drives ? std::max(free, limits.across_driven) : free, limits.across);
  const double beside = std::sqrt(std::max(0.0, limits.disc * limits.disc - across * across));
  double along = 0.0;
  if (slope != 0.0) {
    along = drives ? std::min(limits.drive, beside) : -beside;
  }
  if (!(q > 0.0)) {
    return {along, 0.0};
  }
  return {along, std::copysign(across, -gradient[2])};
}

ScaledAvoidance scaled_to(const Avoidance& system, double grip) {
  expects(grip > 0.0 && std::isfinite(grip), "grip > 0");
  expects(system.grip > 0.0 && std::isfinite(system.grip), "grip > 0");
  const double factor = std::sqrt(grip / system.grip);
  ScaledAvoidance scaled{system, factor, 1.0 / factor};
  scaled.system.grip = grip;
  scaled.system.obstacle_speed *= factor;
  return scaled;
}

}  // namespace saca::danger
