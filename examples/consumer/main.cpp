// The least that a driving stack needs of SACA: scenes go in, a plan comes out, always and at once.
// Built against an installed package: find_package(saca).
#include <cstdio>

#include "saca/decide/reflex_plane.h"

int main() {
  saca::world::Scene scene;
  scene.ego.v_B = {14.0, 0.0};
  scene.ego_footprint = {.length = 4.7, .width = 1.9, .centre_x = -0.1};
  scene.ego_mass = 1'700.0;
  saca::world::Actor wreck{.id = 1, .footprint = {.length = 4.5, .width = 1.8}, .mass = 1'500.0};
  wreck.X_WA.p = {40.0, 0.0};
  scene.actors.push_back(wreck);

  saca::decide::ReflexPlane reflex(saca::preview::Thresholds{});
  for (int k = 0; k < 300; ++k) {
    const saca::decide::Reflex out = reflex.step(scene);
    if (out.triggered) {
      const auto name = saca::manoeuvre::name(out.plan.policy);
      std::printf("after %.2f s, %.1f s before the contact: %.*s\n", scene.time, out.threat->time,
                  static_cast<int>(name.size()), name.data());
      return 0;
    }
    scene.time += 0.01;  // the stack's next scene: the ego goes on
    scene.ego.X_WB.p.x += 0.01 * scene.ego.v_B.x;
  }
  std::puts("the wreck was not seen");
  return 1;
}
