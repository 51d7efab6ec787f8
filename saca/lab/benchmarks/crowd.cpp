#include "saca/lab/benchmarks/crowd.h"

#include <cstdint>
#include <random>

#include "saca/onboard/manoeuvre/ego.h"

namespace saca::benchmarks {
namespace {

world::Scene crowd(const manoeuvre::Car& car, int num_actors, std::mt19937& rng) {
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  world::Scene scene;
  scene.ego.v_B = {20.0 + u(rng), 0.0};
  scene.ego_footprint = manoeuvre::footprint(car);
  scene.ego_mass = car.mass;
  for (int i = 0; i < num_actors; ++i) {
    world::Actor actor{.id = static_cast<std::uint8_t>(i + 1),
                       .footprint = {.length = 4.5, .width = 1.8},
                       .mass = 1'500.0};
    const int lane = (i + 1) % 3 - 1;  // the first is in the ego's own
    const int row = i / 3;
    actor.X_WA.p = {16.0 + 9.0 * row + 5.0 * u(rng), 3.5 * lane + 0.5 * u(rng)};
    actor.v_W = {11.0 + 4.0 * u(rng), 0.3 * u(rng)};
    scene.actors.push_back(actor);
  }
  return scene;
}

}  // namespace

std::vector<world::Scene> crowds(const manoeuvre::Car& car, int num_actors) {
  std::mt19937 rng(1);
  std::vector<world::Scene> scenes;
  scenes.reserve(num_crowds);
  for (int i = 0; i < num_crowds; ++i) {
    scenes.push_back(crowd(car, num_actors, rng));
  }
  return scenes;
}

void follow_ego(std::vector<world::Scene>& scenes) {
  for (world::Scene& scene : scenes) {
    world::Actor& last = scene.actors[scene.actors.size() - 1];
    last.X_WA.p = {-20.0, 0.0};
    last.v_W = scene.ego.v_B;
  }
}

}  // namespace saca::benchmarks
