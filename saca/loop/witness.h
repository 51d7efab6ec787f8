#pragma once

#include "saca/outcome/outcome.h"
#include "saca/sim/stepper.h"

namespace saca::loop {

/// Watches a stepper from look to look and keeps what came of it: the first contact, or the smallest
/// clearance. Only actors that are there count.
class Witness {
 public:
  /// The harm model outlives the witness.
  explicit Witness(const outcome::HarmModel& harm) : harm_(harm) {}

  /// Call at equal steps of simulated time, at least twice.
  /// @return  the scene in which contact was made in this step; nullopt when there was none
  std::optional<world::Scene> look(const sim::Stepper& stepper);

  [[nodiscard]] const outcome::Outcome& outcome() const { return outcome_; }

 private:
  const outcome::HarmModel& harm_;
  outcome::Outcome outcome_;
  std::optional<world::Scene> last_;
};

}  // namespace saca::loop
