#include "saca/outcome/roll_out.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "saca/core/contract.h"
#include "saca/core/parallel.h"
#include "saca/manoeuvre/batch.h"
#include "saca/manoeuvre/drive.h"
#include "saca/vehicle/vehicle.h"

namespace saca::outcome {
namespace {

// Of a policy that never ends: everybody who matters has come by [s].
constexpr double clear_end = 20.0;

// Time to drive: half as long again as an even stop takes, and time for the brakes to build up; in
// whole seconds, so that many are the same.
double longest(const world::Scene& scene, double grip) {
  return std::max(clear_end,
                  std::ceil(1.0 + 1.5 * norm(scene.ego.v_B) / (grip * vehicle::gravity)));
}

double true_grip(const Attempt& attempt) {
  return std::min(1.2, attempt.grip * attempt.unknown.grip);
}

manoeuvre::Drive drive_of(const manoeuvre::Car& car, const Attempt& attempt) {
  return {.car = &car,
          .plan = attempt.plan,
          .start = attempt.scene->time,
          .ego = attempt.scene->ego,
          .road = attempt.scene->road,
          .known_grip = attempt.scene->grip,
          .grip = attempt.grip,
          .unknown = attempt.unknown};
}

}  // namespace

Outcome roll_out(const manoeuvre::Car& car, const manoeuvre::Plan& plan, const world::Scene& scene,
                 std::span<const world::Track> tracks, double grip, const HarmModel& harm) {
  return judge(drive(car, plan, scene, grip, longest(scene, grip)), scene, tracks, harm, grip);
}

std::vector<Course> roll_out_all(const manoeuvre::Car& car, std::span<const Attempt> attempts,
                                 const HarmModel& harm, int threads) {
  std::map<double, std::vector<std::size_t>> by_horizon;  // nearly always one
  for (std::size_t i = 0; i < attempts.size(); ++i) {
    expects(attempts[i].scene != nullptr && attempts[i].others != nullptr,
            "an attempt has a scene and the others' motion");
    by_horizon[longest(*attempts[i].scene, true_grip(attempts[i]))].push_back(i);
  }
  std::vector<Course> courses(attempts.size());
  for (const auto& [horizon, indices] : by_horizon) {
    std::vector<manoeuvre::Drive> drives;
    drives.reserve(indices.size());
    for (const std::size_t i : indices) {
      drives.push_back(drive_of(car, attempts[i]));
    }
    const auto motions = drive_all(drives, horizon, threads);
    in_parallel(indices.size(), threads, [&, &which = indices](std::size_t k) {
      const Attempt& attempt = attempts[which[k]];
      courses[which[k]] =
          play_out(motions[k], *attempt.scene, *attempt.others, harm, true_grip(attempt));
    });
  }
  return courses;
}

}  // namespace saca::outcome
