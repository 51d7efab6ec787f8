#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "saca/base/core/clock.h"
#include "saca/base/world/scene.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/onboard/reflex/encounter.h"
#include "saca/onboard/reflex/intake.h"
#include "saca/onboard/reflex/reflex_plane.h"
#include "saca/onboard/reflex/trigger.h"
#include "saca/onboard/vehicle/vehicle.h"
#include "saca/runtime/event_log.h"
#include "saca/runtime/planes.h"
#include "saca/thinking/intent/model.h"
#include "saca/thinking/intent/observer.h"

namespace saca {

/// What an avoider is made of. What it points to outlives it.
struct AvoiderSetup {
  runtime::PlanesSetup planes;  ///< the car, its harm and atlas, memory, model, pace, clock
  const intent::Model* intent = nullptr;  ///< not null
  /// Hears the thinking plane while it thinks, its reasoning too, in place of `next_event`; at pace
  /// `real` on its thread, which waits for it. nullopt: `next_event` tells its events, and nobody
  /// hears its reasoning.
  std::optional<runtime::Planes::Listener> thinking;
  std::size_t num_timed = 0;  ///< of how many steps, the first, `planes().timing()` knows
};

/// What an avoider says to one instant.
struct Answer {
  std::optional<manoeuvre::Plan> plan;     ///< to be carried out now: `Avoider::control` does it;
                                           ///< nullopt: the stack drives
  bool begins = false;                     ///< it begins in this very answer, as the next two tell
  bool triggered = false;                  ///< by a decision at a trigger: `Avoider::decision`
  std::optional<reflex::Switch> switched;  ///< in place of another plan; of no intervention, the
                                           ///< wheel is given back
  std::optional<reflex::Threat> threat;    ///< as reflex::Reflex has it
  /// Somebody or everything is carried on instead of seen; or nothing can be, so that nothing new
  /// begins (for more than Intake::longest_carried nothing usable has come): an event says which.
  bool degraded = false;
};

/// SACA as a driving stack embeds it: scenes in, at 10 to 100 Hz, a plan out at each; while there
/// is one, commands to the car, up to 1,000 times a second.
///
/// Watches all day: intentions from the first scene on; within T2 the forecaster and the thinking
/// plane work; at T1 the decision, and supervision until the plan has reached its end or nobody is
/// in the way. Then the stack drives again, and the next encounter finds nothing of this one.
/// Whatever comes in, the answer is valid (reflex::Intake).
///
/// `step` and `control` belong to one thread; they wait for nothing and allocate nothing (in
/// lockstep, where thinking is done in `step`, they do). At pace `real` two more threads
/// work; they end with the object.
class Avoider {
 public:
  /// @param setup  car, harm, intent and clock are given, at either pace; else ContractViolation is
  ///               thrown
  explicit Avoider(const AvoiderSetup& setup);
  Avoider(const Avoider&) = delete;
  Avoider& operator=(const Avoider&) = delete;
  ~Avoider() = default;

  /// A scene came.
  /// @param at  when, on the clock, it was true; of no account in lockstep
  Answer step(const world::Scene& scene, Clock::Time at = Clock::Time{0});
  /// None came until `now` [s], in the scenes' time.
  Answer step(double now, Clock::Time at = Clock::Time{0});

  /// The driver or the stack has taken the wheel: what is under way is dropped, and this encounter
  /// forgotten. It goes on watching, and acts again where somebody still threatens.
  void stand_down();

  /// What to tell the car: carries the plan of the last answer out.
  /// @param state  as measured now; of `brake_line` nothing is read, `transfer_a_B` is a_B behind a
  ///               low pass of some 0.1 s, or a_B where nothing better is known
  /// @param dt     since the last call [s], > 0: 1 ms in all that was tested
  /// @return       nothing to steer or brake, where there is no plan
  [[nodiscard]] vehicle::Command control(const vehicle::VehicleState& state, double dt) noexcept;

  /// What `control` carries out: the plan of the last answer; nullopt: the stack drives.
  [[nodiscard]] std::optional<manoeuvre::Plan> plan() const { return encounter_.plan(); }
  /// Whether what was begun last in this encounter has reached its safe end: at rest, which is
  /// held, or in a recovered lane, where the wheel is given back.
  [[nodiscard]] bool finished() const { return encounter_.finished(); }

  /// The oldest event that has not been asked for: what was decided, begun, thought and not seen,
  /// in words, for a log. nullopt: there is none now.
  ///
  /// For one thread, this one or another, which may take its time: no other waits for it. What does
  /// not fit meanwhile (`most_events`) is counted, and reported as an event.
  [[nodiscard]] std::optional<arbitration::Event> next_event() { return events_.next(); }
  static constexpr std::size_t most_events = 256;  ///< that wait, of either thread

  /// The last decision at a trigger, of this encounter; nullopt: none yet.
  [[nodiscard]] const std::optional<reflex::Decision>& decision() const {
    return planes_.decision();
  }
  /// The scene by which the last answer was given, as the intake made it of what came.
  [[nodiscard]] const world::Scene& scene() const { return intake_.scene(); }
  /// What was believed of it: one for each of its actors.
  [[nodiscard]] const intent::Beliefs& beliefs() const { return observer_.beliefs(); }
  /// What is thought, forecast and decided with: for records.
  [[nodiscard]] const runtime::Planes& planes() const { return planes_; }
  /// All that was decided by, where the setup gives it memory (runtime::PlanesSetup::tape_size).
  /// Belongs to the thread that calls `step`; a copy of its content may be written by any
  /// (runtime::tape_text), and worked out again (runtime::replay).
  [[nodiscard]] const runtime::Tape& tape() const { return planes_.tape(); }
  /// When this drive began [s], in the scenes' time: the times of decisions, events and the tape
  /// count from it.
  [[nodiscard]] double drive_began() const { return intake_.began(); }
  /// How many encounters have ended.
  [[nodiscard]] std::size_t num_encounters() const { return num_encounters_; }

  /// Ends thinking and forecasting; `step` is not called any more.
  /// @return  as Planes::finish
  std::string finish() { return planes_.finish(); }

 private:
  [[nodiscard]] Answer answer(const reflex::IntakeResult& taken, Clock::Time at);
  void remark_on(const reflex::IntakeResult& taken);
  void begin_anew(runtime::Reset forgotten);
  void end_encounter();

  AvoiderSetup setup_;
  reflex::Intake intake_;
  intent::Observer observer_;
  reflex::Encounter encounter_;
  runtime::EventLog events_;
  runtime::Planes planes_;
  runtime::Remark perception_ = runtime::Remark::seen_again;  ///< as last reported
  bool watches_ = false;  ///< a scene has come that could be used
  std::size_t num_encounters_ = 0;
};

}  // namespace saca
