#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "saca/base/world/scene.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/manoeuvre/parameter_perturbation.h"
#include "saca/onboard/manoeuvre/plan.h"

namespace saca::tune {

/// One manoeuvre that a law must be good at.
struct Trial {
  manoeuvre::Plan plan;
  world::Scene scene;
  manoeuvre::ParameterPerturbation perturbation;
};

/// T-drifts to the left from 10 to 25 m/s on grip 0.2 to 0.9, straight and in bends: each once as
/// known, and with draws of what is not known, from crooked starts.
[[nodiscard]] std::vector<Trial> drift_trials(unsigned long seed);

/// Lane changes to the left, at constant speed and braking, from 5 to 25 m/s on grip 0.2 to 0.9;
/// likewise.
[[nodiscard]] std::vector<Trial> swerve_trials(unsigned long seed);

/// What a drift costs: the heading's error at rest (squared, 1 at 8 deg), 16 times the share by
/// which the way forward exceeds that of a stop with all the grip, what it goes aside of its first
/// direction beyond 2 m (squared, 1 at 0.5 m), and twice the worst error where it never rests. The
/// domain of the car's tuning does not matter.
[[nodiscard]] double drift_cost(const manoeuvre::Car& car, const Trial& trial);

/// What a lane change costs: 0.6 of the time until it stays within 0.2 m and 2 deg, over the
/// shortest; 0.4 of the time until 0.6 of the lane's width are done, which is to pass an obstacle,
/// over its share of the shortest; what it overshoots (squared, 1 at 0.3 m); much where it never
/// settles. The shortest is 2 sqrt(d / (mu g)), all the grip to either side in turn, but no shorter
/// than going 24 deg across at the lowest speed takes.
[[nodiscard]] double swerve_cost(const manoeuvre::Car& car, const Trial& trial);

/// Mean of the costs and half of the worst. Works on `threads` at once; the sum does not depend on
/// their number.
[[nodiscard]] double total_cost(const manoeuvre::Car& car, const std::vector<Trial>& trials,
                                double (*cost)(const manoeuvre::Car&, const Trial&), int threads);

/// How many of a number of drifts end within 10 deg of across the lane.
/// @param count  draws of what is not known, > 0
[[nodiscard]] int num_across(const manoeuvre::Car& car, double speed, double grip, int count,
                             unsigned long seed, int threads);

/// From which speed to which, at which grip, at least 95 % of the draws end within 10 deg of
/// across: the domain of the drift. 5 % in hand, for other draws.
/// @param goes_on  asked before each speed; false stops
/// @return         nullopt when stopped
[[nodiscard]] std::optional<manoeuvre::DriftDomain> find_domain(
    const manoeuvre::Car& car, int draws, unsigned long seed, int threads,
    const std::function<bool()>& goes_on);

}  // namespace saca::tune
