#include "saca/lab/benchmarks/vehicle_times.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "saca/onboard/manoeuvre/controller.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::benchmarks {

nlohmann::json vehicle_times(const manoeuvre::Car& car, const Clock& clock, int num_stops) {
  world::Scene scene;
  scene.ego.v_B = {20.0, 0.0};
  const manoeuvre::Plan plan{manoeuvre::PolicyId::aeb, std::nullopt};
  constexpr int num_steps = 2'000;
  const Clock::Time start = clock.now();
  for (int stop = 0; stop < num_stops; ++stop) {
    manoeuvre::ControllerState memory = manoeuvre::begin(car, plan, scene);
    vehicle::VehicleState state = manoeuvre::rolling_state(car, scene.ego, 0.9);
    for (int k = 0; k < num_steps; ++k) {
      const vehicle::Command command =
          manoeuvre::control(car, scene.road, 0.9, state, memory, vehicle::usual_step);
      state = vehicle::step(car, state, command, 0.9, vehicle::usual_step);
    }
  }
  return {{"vehicle.steps_per_s", num_stops * num_steps / to_seconds(clock.now() - start)}};
}

}  // namespace saca::benchmarks
