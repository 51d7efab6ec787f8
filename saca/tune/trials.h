#pragma once

#include <vector>

#include "saca/manoeuvre/car.h"
#include "saca/manoeuvre/plan.h"
#include "saca/manoeuvre/unknown.h"
#include "saca/world/scene.h"

namespace saca::tune {

/// One manoeuvre that a law must be good at.
struct Trial {
  manoeuvre::Plan plan;
  world::Scene scene;
  manoeuvre::Unknown unknown;
};

/// T-drifts to the left from 10 to 25 m/s on grip 0.2 to 0.9: each once as known, and once with a
/// draw of what is not known, from a crooked start.
[[nodiscard]] std::vector<Trial> drift_trials(unsigned long seed);

/// Lane changes to the left, at constant speed and braking, from 5 to 25 m/s on grip 0.2 to 0.9;
/// likewise twice.
[[nodiscard]] std::vector<Trial> swerve_trials(unsigned long seed);

/// What a drift costs: the heading's error at rest (1 at 8 deg, squared), ten times the share by
/// which the way forward exceeds that of a stop with all the grip, what it goes aside beyond 2 m
/// (squared, 1 at 0.5 m), and as much as the worst error where it never rests. Domains of the car's
/// tuning do not matter.
[[nodiscard]] double drift_cost(const manoeuvre::Car& car, const Trial& trial);

/// What a lane change costs: the time until it stays within 0.2 m and 2 deg, over that of the
/// shortest way with all the grip to the side, 2 sqrt(d / (mu g)); what it overshoots (squared, 1
/// at 0.3 m); much where it never settles.
[[nodiscard]] double swerve_cost(const manoeuvre::Car& car, const Trial& trial);

/// Mean of the costs and half of the worst. Works on `threads` at once; the sum does not depend on
/// their number.
[[nodiscard]] double total_cost(const manoeuvre::Car& car, const std::vector<Trial>& trials,
                                double (*cost)(const manoeuvre::Car&, const Trial&), int threads);

/// How many of a number of drifts end within 10 deg of across the lane.
/// @param count  draws of what is not known, > 0
[[nodiscard]] int num_across(const manoeuvre::Car& car, double speed, double grip, int count,
                             unsigned long seed, int threads);

/// From which speed at which grip at least 95 % of the draws end within 10 deg of across: the
/// domain of the drift, found downwards from 25 m/s. 5 % in hand, for other draws.
[[nodiscard]] manoeuvre::DriftDomain find_domain(const manoeuvre::Car& car, int draws,
                                                 unsigned long seed, int threads);

}  // namespace saca::tune
