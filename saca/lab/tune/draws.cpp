#include "saca/lab/tune/draws.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saca/base/core/contract.h"
#include "saca/base/core/parallel.h"
#include "saca/base/core/units.h"
#include "saca/onboard/manoeuvre/drive.h"

namespace saca::tune {

Ending ride_to_end(manoeuvre::Ride ride, double horizon, bool with_path) {
  constexpr int steps_per_pose = 50;
  Ending ending;
  const auto steps = std::lround(horizon / vehicle::usual_step);
  int step = 0;
  for (; step < steps && !ride.ended(); ++step) {
    if (with_path && step % steps_per_pose == 0) {
      ending.path.push_back(ride.state().X_WB);
    }
    ride.step();
  }
  ending.X_WB = ride.state().X_WB;
  ending.speed = norm(ride.state().v_B);
  ending.time = step * vehicle::usual_step;
  ending.ended = ride.ended();
  if (with_path) {
    ending.path.push_back(ending.X_WB);
  }
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
    endings[i] = ride_to_end(manoeuvre::Ride(car, plan, scene, draws.grip, perturbation[i]),
                             draws.horizon, i < static_cast<std::size_t>(draws.with_paths));
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
