#include "saca/manoeuvre/drive.h"
#include "saca/outcome/outcome.h"

namespace saca::outcome {

// Longer than any manoeuvre of the library: 25 m/s at grip 0.2 takes 18 s to rest [s].
constexpr double longest = 20.0;

Outcome roll_out(const manoeuvre::Car& car, const manoeuvre::Plan& plan, const world::Scene& scene,
                 std::span<const world::Track> tracks, double grip, const HarmModel& harm) {
  return judge(drive(car, plan, scene, grip, longest), scene, tracks, harm);
}

Outcome roll_out(const manoeuvre::Car& car, const manoeuvre::Plan& plan, const world::Scene& scene,
                 const Others& others, double grip, const HarmModel& harm) {
  return judge(drive(car, plan, scene, grip, longest), scene, others, harm);
}

}  // namespace saca::outcome
