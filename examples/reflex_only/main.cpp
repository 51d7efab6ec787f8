// What a vehicle carries: the reflex plane alone, on one file (`saca atlas package`). No text is
// read, nothing is thought; where a forecaster would have spoken, the atlas does. Built against an
// installed package.
#include <cstdio>

#include "saca/onboard/manoeuvre/ego.h"
#include "saca/onboard/reflex/encounter.h"
#include "saca/onboard/reflex/reflex_plane.h"
#include "saca/onboard/reflex/vehicle_package.h"

int main(int num_arguments, char** arguments) {
  using namespace saca;
  if (num_arguments != 2) {
    std::fprintf(stderr, "usage: reflex_only CAR.vehicle\n");
    return 2;
  }
  const auto package = reflex::read_vehicle_package(arguments[1]);
  if (!package.has_value()) {
    std::fprintf(stderr, "reflex_only: %s\n", package.error().message.c_str());
    return 3;
  }
  const manoeuvre::Car& car = package.value().car;
  reflex::ReflexPlane plane(
      {.car = &car, .atlas = reflex::AtlasJudge(car, package.value().atlas, package.value().harm)});

  world::Scene scene;  // 14 m/s on a dry road, a wreck ahead
  scene.ego.v_B = {14.0, 0.0};
  scene.ego_footprint = manoeuvre::footprint(car);
  scene.ego_mass = car.mass;
  world::Actor wreck{.id = 1, .footprint = {.length = 4.5, .width = 1.8}, .mass = 1'500.0};
  wreck.X_WA.p = {60.0, 0.0};
  scene.actors.push_back(wreck);

  vehicle::VehicleState state = manoeuvre::rolling_state(car, scene.ego, scene.grip);
  reflex::Encounter encounter(car);
  while (scene.time < 7.0) {
    const reflex::Reflex answer = plane.step(scene, encounter.finished());
    if (encounter.look(scene, answer)) {  // it is over
      plane.begin_anew();
      encounter.begin_anew();
    }
    if (answer.triggered || answer.switched) {
      const auto name = manoeuvre::name(answer.plan.policy);
      std::printf("%.2f s: %.*s\n", scene.time, static_cast<int>(name.size()), name.data());
    }
    for (int k = 0; k < 10; ++k) {  // the car: here its model
      state = vehicle::step(car, state, encounter.control(state, 0.001), scene.grip, 0.001);
    }
    scene.ego = manoeuvre::ego_state(state);
    scene.time += 0.01;
  }
  const double gap = wreck.X_WA.p.x - 2.25 - scene.ego.X_WB.p.x - car.front_end;
  std::printf("at %.1f m/s, %.1f m before the wreck\n", scene.ego.v_B.x, gap);
  return scene.ego.v_B.x < 0.1 && gap > 0.0 ? 0 : 1;
}
