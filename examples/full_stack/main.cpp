// SACA in a driving stack: scenes go in at 100 Hz, steering and brakes come out; forecaster and
// thinking plane work beside, on threads of their own. Built against an installed package.
#include <cstdio>
#include <filesystem>
#include <optional>

#include "saca/onboard/manoeuvre/ego.h"
#include "saca/onboard/reflex/vehicle_package.h"
#include "saca/runtime/avoider.h"

int main(int num_arguments, char** arguments) {
  using namespace saca;
  if (num_arguments != 2) {
    std::fprintf(stderr, "usage: full_stack CAR.vehicle\n");
    return 2;
  }
  const auto package = reflex::read_vehicle_package(arguments[1]);
  const std::filesystem::path data = SACA_DATA;
  const auto intent = intent::read_model(data / "models/intent/model.safetensors");
  for (const auto& problem : {package.has_value() ? std::nullopt : std::optional(package.error()),
                              intent.has_value() ? std::nullopt : std::optional(intent.error())}) {
    if (problem) {
      std::fprintf(stderr, "full_stack: %s\n", problem->message.c_str());
      return 3;
    }
  }
  const auto& [car_name, car, harm, atlas] = package.value();
  SteadyClock clock;
  Avoider avoider(
      {.planes = {.forecast = {&car, &harm, &atlas}, .pace = runtime::Pace::real, .clock = &clock},
       .intent = &intent.value()});  // .memory and .model as well, where there are any

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
    if (answer.triggered && answer.threat && answer.plan) {
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
  const double gap = wreck.X_WA.p.x - 2.25 - scene.ego.X_WB.p.x - car.front_end;
  std::printf("at %.1f m/s, %.1f m before the wreck\n", scene.ego.v_B.x, gap);
  return scene.ego.v_B.x < 0.1 && gap > 0.0 ? 0 : 1;
}
