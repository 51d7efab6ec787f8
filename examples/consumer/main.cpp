// SACA in a driving stack: scenes go in at 100 Hz, steering and brakes come out; forecaster and
// thinking plane work beside, on threads of their own. Built against an installed package.
#include <cstdio>

#include "saca/lab/prepare/car_file.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/runtime/avoider.h"

int main() {
  using namespace saca;
  const std::filesystem::path data = SACA_DATA;
  const auto car = prepare::read_car(data / "data/vehicles/compact_rwd_ev.toml").value();
  const auto harm = prepare::read_harm(data / "data/harm.toml").value();
  const auto intent = intent::read_model(data / "models/intent/model.safetensors").value();
  SteadyClock clock;
  Avoider avoider(
      {.planes = {.forecast = {&car, &harm}, .pace = runtime::Pace::real, .clock = &clock},
       .intent = &intent});  // .memory and .model as well, where there are any

  world::Scene scene;  // 14 m/s on a dry road, a wreck ahead
  scene.ego.v_B = {14.0, 0.0};
  scene.ego_footprint = manoeuvre::footprint(car);
  scene.ego_mass = car.mass;
  world::Actor wreck{.id = 1, .footprint = {.length = 4.5, .width = 1.8}, .mass = 1'500.0};
  wreck.X_WA.p = {60.0, 0.0};
  scene.actors.push_back(wreck);

  vehicle::VehicleState state = manoeuvre::rolling_state(car, scene.ego, scene.grip);
  const Clock::Time start = clock.now();
  while (scene.time < 7.0) {
    const Answer answer = avoider.step(scene, clock.now());
    if (answer.begins && answer.plan) {
      const auto name = manoeuvre::name(answer.plan->policy);
      std::printf("%.2f s, %.1f s before the contact: %.*s\n", scene.time, answer.threat->time,
                  static_cast<int>(name.size()), name.data());
    }
    for (int k = 0; k < 10; ++k) {  // the car: here its model
      state = vehicle::step(car, state, avoider.control(state, 0.001), scene.grip, 0.001);
    }
    scene.ego = manoeuvre::ego_state(state);
    scene.time += 0.01;
    clock.wait_until(start + from_seconds(scene.time));
  }
  const double gap = wreck.X_WA.p.x - 2.25 - scene.ego.X_WB.p.x - 2.3;
  std::printf("at %.1f m/s, %.1f m before the wreck\n", scene.ego.v_B.x, gap);
  return scene.ego.v_B.x < 0.1 && gap > 0.0 ? 0 : 1;
}
