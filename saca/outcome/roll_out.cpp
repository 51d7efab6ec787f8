#include <algorithm>

#include "saca/manoeuvre/drive.h"
#include "saca/outcome/outcome.h"
#include "saca/vehicle/vehicle.h"

namespace saca::outcome {
namespace {

// Of a policy that never ends: everybody who matters has come by [s].
constexpr double clear_end = 20.0;

// Time to drive: half as long again as an even stop takes, and time for the brakes to build up.
double longest(const world::Scene& scene, double grip) {
  return std::max(clear_end, 1.0 + 1.5 * norm(scene.ego.v_B) / (grip * vehicle::gravity));
}

}  // namespace

Outcome roll_out(const manoeuvre::Car& car, const manoeuvre::Plan& plan, const world::Scene& scene,
                 std::span<const world::Track> tracks, double grip, const HarmModel& harm) {
  return judge(drive(car, plan, scene, grip, longest(scene, grip)), scene, tracks, harm, grip);
}

Course roll_out(const manoeuvre::Car& car, const manoeuvre::Plan& plan, const world::Scene& scene,
                const Others& others, double grip, const HarmModel& harm,
                const manoeuvre::Unknown& unknown) {
  const double real = std::min(1.2, grip * unknown.grip);
  return play_out(drive(car, plan, scene, grip, longest(scene, real), unknown), scene, others, harm,
                  real);
}

}  // namespace saca::outcome
