#include "saca/lab/tune/draws.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saca/base/core/contract.h"
#include "saca/base/core/parallel.h"
#include "saca/base/core/units.h"
#include "saca/onboard/manoeuvre/drive.h"

namespace saca::tune {

namespace {

/// @param look  is called before each step, with its number
template <class Look>
Ending ridden(manoeuvre::Ride ride, double horizon, const Look& look) {
  Ending ending;
  const auto steps = std::lround(horizon / vehicle::usual_step);
  int step = 0;
  for (; step < steps && !ride.ended(); ++step) {
    look(step, ride);
    ride.step();
  }
  ending.X_WB = ride.state().X_WB;
  ending.speed = norm(ride.state().v_B);
  ending.time = step * vehicle::usual_step;
  ending.ended = ride.ended();
  return ending;
}

}  // namespace

Ending ride_to_end(manoeuvre::Ride ride, double horizon) {
  return ridden(ride, horizon, [](int, const manoeuvre::Ride&) {});
}

Ending ride_along_path(manoeuvre::Ride ride, double horizon) {
  constexpr int steps_per_pose = 50;
  std::vector<Pose> path;
  Ending ending = ridden(ride, horizon, [&](int step, const manoeuvre::Ride& now) {
    if (step % steps_per_pose == 0) {
      path.push_back(now.state().X_WB);
    }
  });
  path.push_back(ending.X_WB);
  ending.path = std::move(path);
  return ending;
}

std::vector<Ending> draw_endings(const manoeuvre::Car& car, const manoeuvre::Plan& plan,
                                 const world::Scene& scene, const EndingDraws& draws) {
  expects(!manoeuvre::refusal(car, plan, scene).has_value(),
          "the plan can be driven: refusal(...)");
  expects(draws.count >= 0 && draws.threads >= 1, "count >= 0 and threads >= 1");
  std::mt19937_64 rng(draws.seed);
  std::vector<manoeuvre::ParameterPerturbation> perturbation(static_cast<std::size_t>(draws.count));
  for (manoeuvre::ParameterPerturbation& one : perturbation) {
    one = manoeuvre::draw(rng);
  }
  std::vector<Ending> endings(perturbation.size());
  in_parallel(endings.size(), draws.threads, [&](std::size_t i) {
    const manoeuvre::Ride ride(car, plan, scene, draws.grip, perturbation[i]);
    endings[i] = i < static_cast<std::size_t>(draws.with_paths)
                     ? ride_along_path(ride, draws.horizon)
                     : ride_to_end(ride, draws.horizon);
  });
  return endings;
}

int num_across(const std::vector<Ending>& endings, const manoeuvre::Plan& plan,
               const world::Road& road) {
  const double wanted = manoeuvre::side(plan.policy) * 0.5 * std::numbers::pi;
  return static_cast<int>(std::count_if(endings.begin(), endings.end(), [&](const Ending& ending) {
    const double heading = world::to_lane(road, ending.X_WB).heading;
    return ending.ended && std::abs(wrap_angle(heading - wanted)) <= from_degrees(10.0);
  }));
}

}  // namespace saca::tune
