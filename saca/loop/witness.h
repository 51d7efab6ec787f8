#pragma once

#include <optional>

#include "saca/outcome/outcome.h"
#include "saca/sim/stepper.h"

namespace saca::loop {

/// Watches a stepper from look to look and keeps what truly came of it: the first contact that ends
/// the ego's motion, or the smallest clearance. Only actors that are there count, those behind too.
/// An edge that does not stop the ego counts, and the film goes on.
class Witness {
 public:
  /// The harm model outlives the witness.
  explicit Witness(const outcome::HarmModel& harm) : harm_(harm) {}

  /// Call at whole steps of the traffic, at least twice.
  /// @return  the scene in which the ego's motion ended in contact in this step; else nullopt
  std::optional<world::Scene> look(const sim::Stepper& stepper);

  [[nodiscard]] const outcome::Outcome& outcome() const { return outcome_; }

 private:
  const outcome::HarmModel& harm_;
  outcome::Outcome outcome_;
  std::optional<world::Scene> last_;
};

}  // namespace saca::loop
