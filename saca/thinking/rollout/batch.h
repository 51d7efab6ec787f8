#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "saca/base/core/simd_level.h"
#include "saca/base/world/scene.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/manoeuvre/drive.h"
#include "saca/onboard/manoeuvre/parameter_perturbation.h"
#include "saca/onboard/manoeuvre/plan.h"

namespace saca::rollout {

/// What `drive(...)` takes, for one drive of many.
struct Drive {
  const manoeuvre::Car* car = nullptr;  ///< what the controller takes the car to be; not null
  manoeuvre::Plan plan;
  double start = 0.0;  ///< `Scene::time` [s]
  world::EgoState ego;
  world::Road road;
  double known_grip = 0.9;  ///< what the controller takes the road's grip to be [-]
  double grip = 0.9;        ///< what it is [-], in (0, 1.2]
  manoeuvre::ParameterPerturbation perturbation;
  double longest = 3600.0;  ///< how long it is driven at most, whatever the batch's horizon [s]
};

/// A drive from a scene, on the grip of the scene.
[[nodiscard]] Drive drive_from(const manoeuvre::Car& car, const manoeuvre::Plan& plan,
                               const world::Scene& scene, double longest);

/// The scene that `drive(...)` takes of it; nobody else is there.
[[nodiscard]] world::Scene scene_of(const Drive& drive);

/// As `drive(...)` for each, many at once in the lanes of SIMD packs: mixed cars, plans, roads,
/// grips and starts.
///
/// @param horizon  longest time of each [s], in [0, 3600]
/// @param threads  >= 1; they do not change the result
/// @param level    available; results of two levels differ by rounding
/// @return         in the order of `drives`
/// @throws ContractViolation  if any could not be given to `drive(...)`, or left what is finite
///
/// The equations are those of `drive`, in floats; the scheme is another, with one evaluation of
/// forces a step: Adams and Bashforth's of second order for the body, Heun's for the actuators, an
/// implicit one for the wheels' spin, where a brake holds as dry friction does. Steps take 5 ms
/// while nothing brakes, 3.3 ms for plans that brake, 2.5 ms for a T-drift.
/// A drive's result depends on nothing but the drive itself, bit by bit: neither on the others, nor
/// on their order or number.
[[nodiscard]] std::vector<manoeuvre::EgoMotion> drive_all(std::span<const Drive> drives,
                                                          double horizon, int threads = 1,
                                                          SimdLevel level = best_level());
/// The same into `motions`, whose memory is used again: for many batches in a row. What `motions`
/// hold after an exception is not told.
void drive_all(std::span<const Drive> drives, double horizon,
               std::vector<manoeuvre::EgoMotion>& motions, int threads = 1,
               SimdLevel level = best_level());

}  // namespace saca::rollout
