#include "saca/onboard/vehicle/vehicle.h"

#include <benchmark/benchmark.h>

#include "saca/lab/prepare/shipped_cars_for_test.h"

namespace saca::vehicle {
namespace {

// Items per second are steps per second of one car; steps of 1 ms.
void vehicle_step(benchmark::State& bench) {
  const Vehicle car = prepare::default_vehicle();
  const VehicleState start = prepare::rolling(car, 20.0);
  Command command;
  command.steering = 0.03;
  command.brake_torque = {300.0, 300.0, 150.0, 150.0};
  VehicleState state = start;
  int steps = 0;
  for (auto _ : bench) {
    state = step(car, state, command, 0.9, 1e-3);
    if (++steps == 1000) {  // before it stands still, where less is to be done
      state = start;
      steps = 0;
    }
    benchmark::DoNotOptimize(state);
  }
  bench.SetItemsProcessed(bench.iterations());
}
BENCHMARK(vehicle_step);

}  // namespace
}  // namespace saca::vehicle
