#pragma once

#include <optional>
#include <vector>

#include "saca/lab/sim/stepper.h"
#include "saca/onboard/collision/outcome.h"

namespace saca::encounter {

/// Watches a stepper from look to look and keeps what truly happened, until a contact ends the
/// ego's motion. Whoever is there counts, those behind too. An edge that does not stop the ego
/// counts, and the film goes on.
class OutcomeRecorder {
 public:
  /// The harm model outlives the recorder.
  explicit OutcomeRecorder(const collision::HarmModel& harm) : harm_(harm) {}

  /// Call at every step of the traffic, until it has said that the motion ended.
  /// @return  did the ego's motion end in contact since the last look?
  bool look(const sim::Stepper& stepper);

  /// Of all that was seen, and, when a contact ended it, of what that leads to.
  /// @throws ContractViolation  before the first look
  [[nodiscard]] collision::Outcome outcome() const;

  /// Of what was seen from a time on [s], while no contact has ended the motion.
  /// @throws ContractViolation  after such a contact, or where nothing was seen from then on
  [[nodiscard]] collision::Outcome outcome_since(double time) const;

  /// The stepper's whole scene at the last look, to which the outcome's actors belong.
  [[nodiscard]] const world::Scene& scene() const { return scene_; }

 private:
  const collision::HarmModel& harm_;
  world::Scene scene_;
  manoeuvre::EgoMotion ego_;
  std::vector<world::Track> others_;  ///< one per actor of the scene; empty until it appears
  collision::Others afterwards_;      ///< known once a contact has ended the motion
};

}  // namespace saca::encounter
