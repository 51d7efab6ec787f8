#pragma once

#include <optional>
#include <vector>

#include "saca/base/world/scene.h"
#include "saca/base/world/track.h"
#include "saca/onboard/atlas/atlas.h"
#include "saca/onboard/collision/harm.h"
#include "saca/onboard/forecast/plans.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/onboard/reflex/followers.h"
#include "saca/onboard/reflex/verdict.h"

namespace saca::reflex {

/// What the reflex plane can say by itself where the forecaster is late: a verdict by the atlas, as
/// if the others went on as they do (world::actor_going_on) but for those behind, who react to the
/// ego (reflex/followers.h). First contacts only. Takes all its memory when it is made.
class AtlasJudge {
 public:
  /// Refers to `car` and `harm`.
  AtlasJudge(const manoeuvre::Car& car, const atlas::Atlas& atlas, const collision::HarmModel& harm,
             forecast::Braking braking = forecast::Braking::any_strength);
  AtlasJudge(AtlasJudge&&) = default;
  AtlasJudge& operator=(AtlasJudge&&) = default;
  AtlasJudge(const AtlasJudge&) = delete;  // a copy would not have the room
  AtlasJudge& operator=(const AtlasJudge&) = delete;
  ~AtlasJudge() = default;

  /// Allocates nothing.
  /// @param scene  breaks no rule
  /// @return       the plans that the atlas holds; nullopt: emergency braking is not among them
  [[nodiscard]] std::optional<Verdict> judge(const world::Scene& scene) noexcept;

 private:
  [[nodiscard]] std::optional<JudgedPlan> judged(const manoeuvre::Plan& plan,
                                                 const world::Scene& scene,
                                                 const Followers& followers) noexcept;

  const manoeuvre::Car* car_;
  atlas::Atlas atlas_;
  const collision::HarmModel* harm_;
  forecast::Braking braking_;
  world::Track X_WB_;
  std::vector<world::Track> tracks_;  ///< max_actors of them
};

}  // namespace saca::reflex
