#pragma once

#include <optional>

#include "saca/base/world/scene.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/manoeuvre/execution.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/onboard/reflex/reflex_plane.h"
#include "saca/onboard/vehicle/vehicle.h"

namespace saca::reflex {

/// Carries out what the reflex plane says, scene by scene, and knows when the encounter is over:
/// nobody has been in the way and nothing under way for `quiet_time`. Then the stack drives again.
/// One thread; allocates nothing.
class Encounter {
 public:
  static constexpr double quiet_time = 2.0;  ///< [s]

  /// @param car  outlives this
  explicit Encounter(const manoeuvre::Car& car) noexcept : car_(&car) {}

  /// The plane has answered to a scene. What it begins is begun; of no intervention, the wheel is
  /// given back. A lane that was recovered is given back, too; who has come to rest is held, and
  /// braked again if something moves it.
  /// @return  whether the encounter is over: who calls forgets it (`begin_anew`, and the plane's)
  [[nodiscard]] bool look(const world::Scene& scene, const Reflex& answer);

  /// What to tell the car (manoeuvre::Execution::control), by the grip of the last scene.
  /// @return  nothing to steer or brake, where there is no plan
  [[nodiscard]] vehicle::Command control(const vehicle::VehicleState& state, double dt) noexcept;

  void begin_anew() noexcept;

  /// What `control` carries out; nullopt: the stack drives.
  [[nodiscard]] std::optional<manoeuvre::Plan> plan() const noexcept {
    return execution_ ? std::optional(execution_->plan()) : std::nullopt;
  }
  /// Whether what was begun last in this encounter has reached its safe end; to rest it has come
  /// below 0.05 m/s and 0.02 rad/s, as measured.
  [[nodiscard]] bool finished() const noexcept { return finished_; }
  /// Whether somebody has threatened since the last encounter ended.
  [[nodiscard]] bool meets_somebody() const noexcept { return meets_somebody_; }

 private:
  void begin(const manoeuvre::Plan& plan, const world::Scene& scene);

  const manoeuvre::Car* car_;
  std::optional<manoeuvre::Execution> execution_;
  double grip_ = 0.9;  ///< as believed at the last look [-]
  bool finished_ = false;
  bool meets_somebody_ = false;
  std::optional<double> quiet_;  ///< since when nobody has threatened and nothing is under way [s]
};

}  // namespace saca::reflex
