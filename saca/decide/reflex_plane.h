#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "saca/decide/plan_cache.h"
#include "saca/decide/trigger_check.h"
#include "saca/manoeuvre/plan.h"
#include "saca/preview/threat.h"
#include "saca/world/scene.h"

namespace saca::decide {

/// Similarity above which a cached plan is taken for the scene at hand (the paper: 90 %).
constexpr double match_similarity = 0.90;

/// What was decided at the trigger, and why.
struct Decision {
  manoeuvre::Plan plan;
  Source source = Source::fallback;
  std::optional<double> similarity;  ///< to the best cached situation; nullopt when there was none
  std::optional<std::int32_t> preview;  ///< whose plan it is, or would have been
  bool gave_way_to_aeb = false;         ///< a plan matched, but a forecast was worse than AEB's
  std::optional<Comparison> forecast;   ///< at the trigger, by the atlas; nullopt: not asked, or
                                        ///< it could not tell
  double time = 0.0;                    ///< of the trigger [s], in the scene's time
};

/// What the reflex plane says to one scene.
struct Reflex {
  manoeuvre::Plan plan{manoeuvre::PolicyId::no_intervention,
                       std::nullopt};     ///< valid at every instant
  std::optional<preview::Threat> threat;  ///< nearest conflict within T2, all going on as they do
  bool triggered = false;                 ///< in this very call
  bool refused_scene = false;             ///< the scene broke a rule and was left aside
};

/// The plane that is always in time: a scene in, a plan out. One thread; no lock, no allocation, no
/// system call. Once triggered it keeps its plan.
///
/// A matching plan gives way to emergency braking where the thinking plane's last forecast has that
/// end better, or where the atlas says, at the trigger itself, that the plan harms more. So nothing
/// is knowingly worse than braking, unless Guard::none was asked for.
class ReflexPlane {
 public:
  /// @param check   nullopt: the last forecast alone decides
  /// @param forced  what to carry out at the trigger whatever was thought
  explicit ReflexPlane(const preview::Thresholds& thresholds,
                       std::optional<TriggerCheck> check = std::nullopt,
                       std::optional<manoeuvre::Plan> forced = std::nullopt,
                       Guard guard = Guard::never_worse_than_braking) noexcept
      : thresholds_(thresholds), check_(std::move(check)), forced_(forced), guard_(guard) {}

  /// Takes over the newest plans.
  void receive(const PlanCache& plans) noexcept { plans_ = plans; }

  [[nodiscard]] Reflex step(const world::Scene& scene) noexcept;

  /// nullopt before the trigger.
  [[nodiscard]] const std::optional<Decision>& decision() const noexcept { return decision_; }

 private:
  [[nodiscard]] Decision decide(const world::Scene& scene) noexcept;

  preview::Thresholds thresholds_;
  std::optional<TriggerCheck> check_;
  std::optional<manoeuvre::Plan> forced_;
  Guard guard_;
  PlanCache plans_;
  std::optional<Decision> decision_;
};

}  // namespace saca::decide
