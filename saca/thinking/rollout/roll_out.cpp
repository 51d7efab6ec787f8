#include "saca/thinking/rollout/roll_out.h"
#include "saca/thinking/rollout/collision_sequence.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/base/core/parallel.h"
#include "saca/onboard/manoeuvre/drive.h"
#include "saca/onboard/vehicle/vehicle.h"
#include "saca/thinking/rollout/batch.h"

namespace saca::rollout {
namespace {

// Of a policy that never ends: everybody who matters has come by [s].
constexpr double clear_end = 20.0;

// Time to drive: half as long again as an even stop takes, and time for the brakes to build up, in
// whole seconds.
double longest(const world::Scene& scene, double grip) {
  return std::max(clear_end,
                  std::ceil(1.0 + 1.5 * norm(scene.ego.v_B) / (grip * vehicle::gravity)));
}

double true_grip(const Attempt& attempt) {
  return std::min(1.2, attempt.grip * attempt.perturbation.grip);
}

rollout::Drive drive_of(const manoeuvre::Car& car, const Attempt& attempt) {
  rollout::Drive drive =
      drive_from(car, attempt.plan, *attempt.scene, longest(*attempt.scene, true_grip(attempt)));
  drive.grip = attempt.grip;
  drive.perturbation = attempt.perturbation;
  return drive;
}

}  // namespace

collision::Outcome roll_out(const manoeuvre::Car& car, const manoeuvre::Plan& plan,
                            const world::Scene& scene, std::span<const world::Track> tracks,
                            double grip, const collision::HarmModel& harm) {
  return judge(drive(car, plan, scene, grip, longest(scene, grip)), scene, tracks, harm, grip);
}

std::vector<CollisionSequence> roll_out_all(const manoeuvre::Car& car,
                                            std::span<const Attempt> attempts,
                                            const collision::HarmModel& harm, int threads) {
  std::vector<rollout::Drive> drives;
  double horizon = 0.0;
  for (const Attempt& attempt : attempts) {
    expects(attempt.scene != nullptr && attempt.others != nullptr,
            "an attempt has a scene and the others' motion");
    drives.push_back(drive_of(car, attempt));
    horizon = std::max(horizon, drives.back().longest);
  }
  const auto motions = drive_all(drives, horizon, threads);
  std::vector<CollisionSequence> sequences(attempts.size());
  in_parallel(attempts.size(), threads, [&](std::size_t i) {
    const Attempt& attempt = attempts[i];
    sequences[i] =
        collision_sequence(motions[i], *attempt.scene, *attempt.others, harm, true_grip(attempt));
  });
  return sequences;
}

}  // namespace saca::rollout
