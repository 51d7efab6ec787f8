#pragma once

#include <vector>

#include "saca/manoeuvre/controller.h"
#include "saca/manoeuvre/ego.h"
#include "saca/sim/scenario.h"
#include "saca/vehicle/vehicle.h"
#include "saca/world/scene.h"
#include "saca/world/track.h"

namespace saca::sim {

/// A scenario in motion: simulated time is a step count times 1 ms. The ego follows what the
/// scenario gives until somebody takes the wheel; the others follow their true tracks.
class Stepper {
 public:
  static constexpr double step = vehicle::usual_step;  ///< [s]

  /// Scenario and car outlive the stepper.
  Stepper(const Scenario& scenario, const vehicle::Vehicle& car);

  [[nodiscard]] double time() const { return static_cast<double>(num_steps_) * step; }
  [[nodiscard]] bool over() const { return time() >= scenario_.duration; }

  /// From now on the vehicle model moves the ego, from the state it has.
  void take_the_wheel();
  [[nodiscard]] bool driven() const { return driven_; }

  /// One step. The command counts only when driven.
  void advance(const vehicle::Command& command);

  /// The car; at rest in its parameters' sense before the wheel is taken.
  [[nodiscard]] const vehicle::VehicleState& car_state() const { return state_; }
  [[nodiscard]] world::EgoState ego() const;

  /// The scene as it is now: perception without noise, delay or loss. Accelerations of the others
  /// are backward differences over 0.5 s, as a tracker would know them; zero until an actor has
  /// been seen that long.
  [[nodiscard]] world::Scene scene() const;

  /// True motion of the actors that are in scene(), in its order, over the whole scenario.
  [[nodiscard]] std::vector<world::Track> tracks() const;

 private:
  [[nodiscard]] bool is_there(const world::Track& track) const { return track.start <= time(); }

  const Scenario& scenario_;
  const vehicle::Vehicle& car_;
  std::vector<world::Track> tracks_;
  std::int64_t num_steps_ = 0;
  bool driven_ = false;
  vehicle::VehicleState state_;
};

}  // namespace saca::sim
