#pragma once

#include <limits>
#include <optional>
#include <string>

#include "saca/base/core/result.h"
#include "saca/base/world/scene.h"
#include "saca/lab/encounter/outcome_recorder.h"
#include "saca/lab/scenario/chance.h"
#include "saca/lab/scenario/scenario.h"
#include "saca/lab/sim/stepper.h"
#include "saca/onboard/collision/harm.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/manoeuvre/execution.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/onboard/reflex/track_confirmation.h"
#include "saca/onboard/reflex/trigger.h"
#include "saca/runtime/avoider.h"
#include "saca/thinking/intent/observer.h"

namespace saca::encounter {

/// An encounter, and what it is simulated with. What it points to outlives the simulation.
struct Stage {
  const scenario::Scenario* scenario = nullptr;
  const manoeuvre::Car* car = nullptr;  ///< what the ego takes itself for
  const collision::HarmModel* harm = nullptr;
  const intent::Model* intent = nullptr;
  reflex::Thresholds thresholds;
  scenario::Chance chance;  ///< what is left to chance; as it stands, nothing
};

/// One encounter in motion, in closed loop: the true world, what the ego perceives and believes of
/// it, what carries out a plan with full vehicle dynamics, and what happens to the ego. Whoever
/// decides (Method) is not part of it.
///
/// At every instant, 10 ms apart, in this order: look(); wake(); whatever is decided:
/// carry_out(), or an avoider is shown what is seen; keep(); advance(), of that avoider where there
/// is one. A copy goes on by itself: from one instant on, what follows from several decisions can
/// be simulated without simulating again what led there.
class ClosedLoop {
 public:
  static constexpr int steps_per_look = 10;                            ///< of the stepper
  static constexpr double step = steps_per_look * sim::Stepper::step;  ///< between two looks [s]

  explicit ClosedLoop(const Stage& stage);

  /// Perceives and judges intentions.
  /// @return  what is wrong with the truth or with what is perceived of it: it breaks a rule of
  ///          `world::broken_rule`
  [[nodiscard]] std::optional<Error> look();

  [[nodiscard]] double time() const { return stepper_.time(); }
  [[nodiscard]] const sim::Stepper& truth() const { return stepper_; }
  /// What the ego perceives, as of the last look.
  [[nodiscard]] const world::Scene& seen() const { return seen_; }
  /// One for each actor of `seen()`.
  [[nodiscard]] const intent::Beliefs& beliefs() const { return beliefs_; }

  /// Who of them has been seen often enough to set off a trigger.
  [[nodiscard]] const reflex::ActorSet& confirmed() const { return tracks_.confirmed(); }
  /// What sets off the reflex plane's trigger now, as far as it has not been by then.
  [[nodiscard]] std::optional<reflex::Threat> trigger() const {
    return reflex::triggering_threat(seen_, stage_->thresholds, confirmed());
  }

  /// Takes the wheel as soon as somebody threatens within T2 under any likely intention
  /// (preview::previewed_threat): it is then that an automated vehicle takes over from whoever
  /// drove.
  /// @return  that threat, when the wheel is taken now
  std::optional<reflex::Threat> wake();

  /// From now on the vehicle model moves the ego; lane and speed are kept until something else is
  /// carried out.
  void take_the_wheel();
  [[nodiscard]] bool driven() const { return stepper_.driven(); }

  /// Begins a plan, taking the wheel where nobody has. One that cannot be driven from here gives
  /// way to emergency braking.
  /// @param deceleration  largest that the brakes are asked for [m/s^2], > 0
  /// @return  why it cannot be driven; nullopt: it can
  std::optional<std::string> carry_out(
      manoeuvre::Plan plan, double deceleration = std::numeric_limits<double>::infinity());
  /// Changes how hard the plan under way may brake.
  void limit_braking(double deceleration);
  /// Lane and speed kept, or the last that was carried out; not that of an avoider.
  [[nodiscard]] const manoeuvre::Plan& plan() const {
    return execution_ ? execution_->plan() : manoeuvre::doing_nothing;
  }

  /// Keeps what truly happened since the last look; counts only once the wheel is taken.
  void keep();
  /// To the next instant.
  void advance();
  /// Likewise; while the avoider has a plan, it commands the car, taking the wheel where nobody
  /// has. Else the driving stack does: it keeps lane and speed, from where the avoider left them.
  /// @param avoider  has been shown what is seen now
  void advance(Avoider& avoider);

  /// Did a contact end the ego's motion?
  [[nodiscard]] bool contact() const { return contact_; }
  /// Has what was carried out, by an avoider or else by this, reached its safe end: at rest, or in
  /// a recovered lane? As of the last step.
  [[nodiscard]] bool finished() const { return finished_; }
  /// Nothing that matters comes any more: a contact ended the motion, the scenario is over, or what
  /// was carried out ended 2 s ago and nobody threatens or comes up from behind.
  [[nodiscard]] bool over() const;

  /// Of all that was kept, and where a contact ended the motion, of what that leads to; nullopt:
  /// the wheel was never taken.
  [[nodiscard]] std::optional<collision::Outcome> outcome() const;
  /// Of what was kept from a time on, without contact until then and after it.
  [[nodiscard]] collision::Outcome outcome_since(double time) const {
    return recorder_.outcome_since(time);
  }
  /// Among whom the outcome's contacts count.
  [[nodiscard]] const world::Scene& met() const { return recorder_.scene(); }

  [[nodiscard]] double steering() const;

 private:
  void keep_lane_and_speed();
  void note_end();
  /// @param command  what to tell a car in this state
  template <class Command>
  void move(Command&& command);
  /// What the loop's own execution tells the car.
  [[nodiscard]] vehicle::Command own_command(const vehicle::VehicleState& state);

  const Stage* stage_;
  sim::Stepper stepper_;
  intent::Observer observer_;
  OutcomeRecorder recorder_;
  world::Scene seen_;
  intent::Beliefs beliefs_;
  reflex::TrackConfirmation tracks_;
  std::optional<manoeuvre::Execution> execution_;  ///< once the wheel is taken
  double deceleration_ = std::numeric_limits<double>::infinity();
  bool avoids_ = false;  ///< an avoider's plan was carried out in the last step
  bool acts_ = false;    ///< something was carried out
  bool kept_ = false;    ///< something was kept
  bool contact_ = false;
  bool finished_ = false;
  std::optional<double> ended_;  ///< when what was carried out had reached its end [s]
};

}  // namespace saca::encounter
