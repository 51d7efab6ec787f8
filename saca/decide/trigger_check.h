#pragma once

#include <optional>
#include <vector>

#include "saca/manoeuvre/atlas.h"
#include "saca/manoeuvre/plan.h"
#include "saca/outcome/harm.h"
#include "saca/preview/followers.h"
#include "saca/world/scene.h"
#include "saca/world/track.h"

namespace saca::decide {

/// What a plan and emergency braking are forecast to do when they begin now: expected harms.
struct Comparison {
  double plan = 0.0;
  double aeb = 0.0;

  /// By a class of the one ordering at least (outcome/ordering.h).
  [[nodiscard]] bool plan_harms_more() const;
};

/// The last look before a plan is carried out, read from the atlas: the others go on as they do
/// (world::actor_going_on), those behind react to the ego (preview/followers.h). Takes all its
/// memory when it is made.
class TriggerCheck {
 public:
  /// Refers to `harm`.
  TriggerCheck(const manoeuvre::Atlas& atlas, const outcome::HarmModel& harm);
  TriggerCheck(TriggerCheck&&) = default;
  TriggerCheck& operator=(TriggerCheck&&) = default;
  TriggerCheck(const TriggerCheck&) = delete;  // a copy would not have the room
  TriggerCheck& operator=(const TriggerCheck&) = delete;
  ~TriggerCheck() = default;

  /// @param scene  breaks no rule
  /// @return       nullopt when the atlas cannot tell of one of the two. Allocates nothing
  [[nodiscard]] std::optional<Comparison> compare(const manoeuvre::Plan& plan,
                                                  const world::Scene& scene) noexcept;

 private:
  [[nodiscard]] std::optional<double> harm_of(const manoeuvre::Plan& plan,
                                              const world::Scene& scene,
                                              const preview::Followers& followers) noexcept;

  manoeuvre::Atlas atlas_;
  const outcome::HarmModel* harm_;
  world::Track X_WB_;
  std::vector<world::Track> tracks_;  ///< max_actors of them
};

}  // namespace saca::decide
