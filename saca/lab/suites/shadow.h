#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/base/world/scene.h"
#include "saca/base/world/track.h"
#include "saca/lab/eval/shadow_judge.h"
#include "saca/lab/scenario/scenario.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/reflex/trigger.h"
#include "saca/runtime/planes.h"
#include "saca/thinking/intent/model.h"

namespace saca::suites {

// SACA in shadow: it watches a recorded drive and never takes the wheel. What it would have done to
// people in ordinary traffic shows in how often it wakes, and how often it would have acted without
// need.

/// What watches. What it points to outlives the watching.
struct ShadowSetup {
  const manoeuvre::Car* car = nullptr;  ///< whose body the ego has
  const intent::Model* intent = nullptr;
  reflex::Thresholds thresholds;
  /// Decides, as it ships, of the same car and by the same thresholds; nullptr: nobody does, and
  /// there are no interventions.
  const runtime::PlanesSetup* saca = nullptr;
};

/// Two previews, triggers or interventions that lie no farther apart are one [s].
constexpr double rearmed_after = 2.0;

/// Somebody threatens within T2 under a likely intention (preview::previewed_threat): SACA thinks.
struct ShadowPreview {
  double from = 0.0;  ///< [s]
  double to = 0.0;    ///< the last look at which it holds [s]
  std::string who;    ///< threatens at first
};

/// Somebody who is confirmed threatens within T1 if all go on as they do: a system that always
/// acts then, as full braking at T1, would have acted.
struct ShadowTrigger {
  double time = 0.0;  ///< [s]
  std::string who;
  double time_to_conflict = 0.0;  ///< then [s], >= 0
  double speed = 0.0;             ///< of the ego [m/s]
  eval::ShadowJudgement judgement;
};

/// SACA itself would have taken the wheel: at T1, before where waiting would cost harm, or later
/// where it had decided to do nothing and the scene got worse.
struct ShadowIntervention {
  ShadowTrigger trigger;  ///< when, and for whom; judged by the same rule
  std::string plan;       ///< "AEB": what it would have begun with
  bool early = false;     ///< before T1
};

/// What there was to see in one drive.
struct ShadowDrive {
  double seconds = 0.0;  ///< watched
  double metres = 0.0;   ///< driven meanwhile
  std::vector<ShadowPreview> previews;
  std::vector<ShadowTrigger> triggers;
  std::vector<ShadowIntervention> interventions;
};

/// Plays a recorded drive from its start to its end and watches, every 10 ms, as
/// encounter::ClosedLoop does: the same scenes, beliefs and thresholds, perception exact. Everybody
/// does what was recorded.
///
/// An actor is there from its first sample to its last: what it does beyond is a guess, and a
/// trigger that rests on one would be neither right nor wrong. The ego's body is the car's,
/// whatever was recorded.
///
/// Triggers and interventions are judged by the rule of `judged` (shadow_judge.h). SACA is told at
/// once that the driver keeps the wheel (Avoider::stand_down), and watches on.
///
/// @return  Error::Code::out_of_range, naming the scenario, when the ego has no recording of 1 s or
///          more from 0 on, when a time or pose of anybody's recording is not finite or times do
///          not grow, or when a scene breaks a rule of `world::broken_rule`
/// @throws ContractViolation  if car or intent is missing, `saca` is of another car, or the window
///                            is not 0 <= from < until
[[nodiscard]] Result<ShadowDrive> shadow_drive(const scenario::Scenario& scenario,
                                               const ShadowSetup& setup,
                                               const eval::ShadowWindow& window = {});

/// A trigger for people to look at.
struct ShadowPicture {
  world::Scene scene;  ///< at the trigger
  world::Track ego;    ///< as recorded, 3 s from there
  std::vector<world::Track> others;
  world::Track supposed_ego;  ///< as the trigger supposed, until the conflict
  std::vector<world::Track> supposed_others;
};

/// @param trigger  of shadow_drive on the same scenario
[[nodiscard]] ShadowPicture shadow_picture(const scenario::Scenario& scenario,
                                           const ShadowSetup& setup, const ShadowTrigger& trigger);

}  // namespace saca::suites
