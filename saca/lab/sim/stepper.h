#pragma once

#include <cstdint>
#include <optional>

#include "saca/base/world/scene.h"
#include "saca/lab/scenario/chance.h"
#include "saca/lab/scenario/scenario.h"
#include "saca/lab/sim/perception.h"
#include "saca/lab/sim/traffic.h"
#include "saca/onboard/collision/outcome.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/manoeuvre/controller.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/onboard/vehicle/vehicle.h"

namespace saca::sim {

/// A scenario in motion, under one draw of what it leaves to chance: simulated time is a step count
/// times 1 ms. The ego follows what the scenario gives until somebody takes the wheel; the others
/// are Traffic, a step of which is ten of these.
class Stepper {
 public:
  static constexpr double step = vehicle::usual_step;  ///< [s]

  /// Scenario and car outlive the stepper.
  /// @param car  what the ego takes itself for; `chance` says how the real one differs
  Stepper(const scenario::Scenario& scenario, const manoeuvre::Car& car,
          const scenario::Chance& chance = {});

  [[nodiscard]] double time() const { return static_cast<double>(num_steps_) * step; }
  [[nodiscard]] bool over() const { return time() >= scenario_.duration; }

  /// From now on the vehicle model moves the ego, from the state it has, and recorded followers
  /// react to it (Traffic::let_followers_react).
  void take_the_wheel();
  [[nodiscard]] bool driven() const { return driven_; }

  /// One step. The command counts only when driven.
  void advance(const vehicle::Command& command);

  /// The car; at rest in its parameters' sense before the wheel is taken.
  [[nodiscard]] const vehicle::VehicleState& car_state() const { return state_; }
  [[nodiscard]] world::EgoState ego() const;

  /// The scene as it truly is now.
  [[nodiscard]] world::Scene scene() const;
  /// The scene as the ego perceives it now, through the scenario's perception. It knows its own
  /// motion. One look: call it once at every step of the traffic, from the first on.
  [[nodiscard]] world::Scene perceive();

  /// How the real car differs from what the ego takes it for; grip() and the scene hold the rest.
  [[nodiscard]] manoeuvre::ParameterPerturbation perturbation_from_now() const;

  /// True friction coefficient.
  [[nodiscard]] double grip() const { return grip_; }

  /// scene() with everybody who is there then or will be: who appears later is where it will.
  [[nodiscard]] world::Scene whole_scene() const;

  /// How the actors of whole_scene() move from now on if the ego moves so: to the scenario's end,
  /// and until 3 s after the ego's motion, in which those behind it have stopped or not.
  [[nodiscard]] collision::Others others() const;

 private:
  [[nodiscard]] world::Scene scene_of(
      const StaticVector<world::Actor, world::max_actors>& actors) const;
  /// Moves actors on from the last step of the traffic to now.
  void carry_on(StaticVector<world::Actor, world::max_actors>& actors) const;

  const scenario::Scenario& scenario_;
  const manoeuvre::Car& car_;
  scenario::Chance chance_;
  vehicle::Vehicle real_car_;
  double grip_;
  Traffic traffic_;
  std::optional<Perception> perception_;  ///< from the first look on
  world::EgoState seen_by_traffic_;
  std::int64_t num_steps_ = 0;
  bool driven_ = false;
  vehicle::VehicleState state_;
};

}  // namespace saca::sim
