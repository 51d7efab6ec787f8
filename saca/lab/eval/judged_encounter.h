#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/encounter/closed_loop.h"
#include "saca/onboard/collision/face.h"
#include "saca/onboard/forecast/expected.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/preview/forecast_facts.h"

namespace saca::eval {

/// The first contact of an ego that does nothing.
struct WithoutAvoidance {
  std::string met;           ///< the actor's name, or "edge"
  bool first_actor = false;  ///< it is the scenario's first: what a family's conflict is about
  collision::Face ego_face = collision::Face::front;
  collision::Face other_face = collision::Face::front;  ///< meaningless at an edge
  double relative_speed = 0.0;                          ///< [m/s]
  double after = 0.0;                                   ///< since the instant asked about [s]
};

/// What happens in an encounter as it is written, nothing being left to chance, when from SACA's
/// trigger on lane and speed are kept.
struct WrittenTrigger {
  double time = 0.0;                        ///< of the trigger [s]
  std::optional<WithoutAvoidance> contact;  ///< nullopt: none
};
/// @return  nullopt: the trigger never fires
[[nodiscard]] std::optional<WrittenTrigger> trigger_as_written(const scenario::Scenario& scenario,
                                                               const manoeuvre::Car& car,
                                                               const collision::HarmModel& harm);

/// One plan as the verdict at the trigger judges it.
struct VerdictPlan {
  manoeuvre::Plan plan;
  double harm = 0.0;        ///< expected
  double contact = 0.0;     ///< probability
  bool admissible = false;  ///< reflex::admissible_harm
};

/// What a policy leads to over draws of what is left to chance, by its plan that harms least.
struct PolicyOverDraws {
  manoeuvre::Plan plan;
  forecast::Mean harm;
  double contact = 0.0;  ///< share of draws
};

/// An encounter at SACA's trigger: what was expected of every plan, and what would have happened.
struct JudgedEncounter {
  memory::Case one;                ///< `told` by the verdict, `happened` over the draws
  std::vector<VerdictPlan> plans;  ///< those that can be driven
  std::optional<double> admissible_harm;
  manoeuvre::Plan speaks_for;  ///< what the verdict by itself would begin
  std::array<std::optional<PolicyOverDraws>, manoeuvre::num_policies> happened;
  std::optional<manoeuvre::PolicyId> driver;  ///< what the recorded driver did from then on;
                                              ///< nullopt: none was recorded
};

struct JudgingOptions {
  std::size_t told_draws = 64;  ///< of the verdict, >= 1
  int draws = 16;               ///< of what is left to chance, >= 2
  std::uint64_t seed = 1;       ///< of these
};

/// The scene is as it is perceived when the trigger first fires, nobody having acted; what happened
/// is worked out from that instant on, in worlds that are drawn (eval::oracle).
///
/// @param stage      with perception and draws, as it is played
/// @param made_with  encounter::made_with of these
/// @return           nullopt: the trigger never fires; out_of_range: it cannot be played
[[nodiscard]] Result<std::optional<JudgedEncounter>> judged_encounter(
    const encounter::Stage& stage, const preview::ForecastTools& tools,
    const JudgingOptions& options, const std::vector<memory::MadeWith>& made_with);

}  // namespace saca::eval
