#pragma once

#include <optional>
#include <vector>

#include "saca/decide/verdict.h"
#include "saca/manoeuvre/atlas.h"
#include "saca/manoeuvre/car.h"
#include "saca/manoeuvre/plan.h"
#include "saca/outcome/harm.h"
#include "saca/preview/followers.h"
#include "saca/preview/plans.h"
#include "saca/world/scene.h"
#include "saca/world/track.h"

namespace saca::decide {

/// What the reflex plane can say by itself where the forecaster is late: a verdict by the atlas, as
/// if the others went on as they do (world::actor_going_on) but for those behind, who react to the
/// ego (preview/followers.h). First contacts only. Takes all its memory when it is made.
class AtlasJudge {
 public:
  /// Refers to `car` and `harm`.
  AtlasJudge(const manoeuvre::Car& car, const manoeuvre::Atlas& atlas,
             const outcome::HarmModel& harm,
             preview::Braking braking = preview::Braking::any_strength);
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
                                                 const preview::Followers& followers) noexcept;

  const manoeuvre::Car* car_;
  manoeuvre::Atlas atlas_;
  const outcome::HarmModel* harm_;
  preview::Braking braking_;
  world::Track X_WB_;
  std::vector<world::Track> tracks_;  ///< max_actors of them
};

}  // namespace saca::decide
