#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "saca/base/world/scene.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/onboard/reflex/atlas_judge.h"
#include "saca/onboard/reflex/plan_cache.h"
#include "saca/onboard/reflex/supervisor.h"
#include "saca/onboard/reflex/track_confirmation.h"
#include "saca/onboard/reflex/trigger.h"
#include "saca/onboard/reflex/under_way.h"
#include "saca/onboard/reflex/verdict.h"

namespace saca::reflex {

/// Similarity above which a cached plan is taken for the scene at hand (the paper: 90 %).
constexpr double match_similarity = 0.90;

/// How long after the forecast trigger a cached plan is still used [s], an assumption: road users
/// that brake or turn a little less than forecast come so much later. What comes later still is
/// another situation, however alike. Forecasts reach T2 - T1 ahead, so that a plan that is used is
/// never older than T2 - T1 and this. Algorithm 1 of the paper (Guard::none) has no such limit.
constexpr double plan_expiry = 1.0;

/// A plan that cannot be driven from here, and why.
struct RefusedPlan {
  manoeuvre::Plan plan;
  manoeuvre::Refusal why{};
  friend bool operator==(const RefusedPlan&, const RefusedPlan&) = default;
};

/// What was decided at the trigger, and why.
struct Decision {
  manoeuvre::Plan plan;
  Source source = Source::fallback;
  std::optional<double> similarity;  ///< to the best cached situation; nullopt when there was none
  std::optional<std::int32_t> preview;  ///< whose plan it is, or would have been
  bool not_admissible = false;  ///< a plan matched, but it is forecast to harm too much from here
  std::optional<Verdict> verdict;  ///< by which it was decided; nullopt: by none
  bool by_atlas = false;           ///< that is the reflex plane's own: the forecaster's was too old
  std::optional<RefusedPlan> refused;  ///< decided on first; emergency braking took its place
  double time = 0.0;                   ///< of the trigger [s], in the scene's time
  std::optional<double> waiting_cost;  ///< of harm, expected: why it acts before T1; nullopt: at T1
};

/// Whether a cached plan matched and is admissible, but was not begun, since doing nothing is as
/// good (plan_of).
[[nodiscard]] bool was_needless(const Decision& decision) noexcept;

/// What the reflex plane says to one scene.
struct Reflex {
  manoeuvre::Plan plan{manoeuvre::PolicyId::no_intervention,
                       std::nullopt};  ///< valid at every instant
  std::optional<Threat> threat;        ///< what sets off the trigger; where nothing does, the
                                       ///< nearest conflict within T2, the ego going on in its
                                       ///< lane and the others as they do
  bool triggered = false;              ///< in this very call
  std::optional<Switch> switched;  ///< in this very call: `plan` begins now, in place of another
  bool refused_scene = false;      ///< the scene broke a rule and was left aside
};

/// What the reflex plane decides with. What it points to outlives the plane.
struct ReflexTools {
  Thresholds thresholds;
  const manoeuvre::Car* car = nullptr;    ///< nullptr: what cannot be driven is not found out
  std::optional<AtlasJudge> atlas;        ///< nullopt: without a verdict, cached plans are taken
                                          ///< unless their last forecast was worse than braking's
  std::optional<manoeuvre::Plan> forced;  ///< what to decide on at the trigger whatever was
                                          ///< thought; 3 and 4 without a target speed brake to half
                                          ///< of the speed then
  Guard guard = Guard::never_worse_than_braking;
};

/// The plane that is always in time: a scene in, a plan out. One thread; no lock, no allocation, no
/// system call.
///
/// Only who is confirmed (TrackConfirmation) sets off the trigger: by a conflict within T1 or,
/// while a conflict comes within T2, as soon as two verdicts running say that waiting costs more
/// than Thresholds::waiting_cost and the later one speaks for doing something, for leaving the lane
/// not before Thresholds::earliest_swerve. So T1 is when it acts at the latest. Guard::none and a
/// forced plan wait for T1.
///
/// At the trigger, in this order: the cached plan whose situation this is, where the verdict finds
/// it admissible (of a cached policy 0: the best braking; without a verdict full braking); else
/// what the verdict speaks for (plan_of). Where the newest verdict is older than verdict_expiry,
/// the atlas gives one; where it cannot, emergency braking. What cannot be driven from here gives
/// way to emergency braking. From then on the verdicts are watched (Supervisor); where none has
/// come for 0.3 s, the atlas's, which may only begin what is needed after all, or brake harder, and
/// where the atlas has none, emergency braking is what is needed. Guard::none: Algorithm 1 of the
/// paper, and its plan is kept.
class ReflexPlane {
 public:
  explicit ReflexPlane(ReflexTools tools) noexcept : tools_(std::move(tools)) {}

  /// Takes over the newest plans.
  void receive(const PlanCache& plans) noexcept { plans_ = plans; }
  /// Takes over the newest verdict.
  void receive(const Verdict& verdict) noexcept { verdict_ = verdict; }

  /// @param finished  what is carried out has reached its safe end: from now on the plane watches
  ///                  for another trigger
  [[nodiscard]] Reflex step(const world::Scene& scene, bool finished = false) noexcept;

  /// The encounter is over: the next trigger is another's, and what was cached is not for it. Who
  /// is confirmed stays so.
  void begin_anew() noexcept {
    plans_.clear();
    verdict_.reset();
    decision_.reset();
    under_way_.reset();
    watched_at_ = never;
    costly_at_ = never;
    judged_at_ = never;
  }

  /// Does it decide and watch by verdicts? Not as Algorithm 1, nor where the plan is given.
  [[nodiscard]] bool supervises() const noexcept {
    return tools_.guard != Guard::none && !tools_.forced;
  }
  /// Will `step` look at verdicts in this scene? Where not, none need be made.
  [[nodiscard]] bool needs_verdict(const world::Scene& scene, bool finished) const noexcept;

  /// The first; nullopt before the trigger.
  [[nodiscard]] const std::optional<Decision>& decision() const noexcept { return decision_; }
  /// What is being carried out; nullopt: nothing.
  [[nodiscard]] const std::optional<UnderWay>& under_way() const noexcept { return under_way_; }

 private:
  static constexpr double never = -std::numeric_limits<double>::infinity();
  static constexpr double rounding = 1e-9;  ///< of times [s]

  [[nodiscard]] Decision decide(const world::Scene& scene) noexcept;
  [[nodiscard]] Decision as_asked_for(const world::Scene& scene) const noexcept;
  /// From cache and verdict, whether or not it can be driven.
  [[nodiscard]] Decision chosen(const world::Scene& scene) noexcept;
  void begin(const manoeuvre::Plan& plan, const world::Scene& scene) noexcept;
  /// What takes the place of the plan under way; nullopt: it goes on.
  [[nodiscard]] std::optional<Switch> supervised(SupervisedScene now) noexcept;
  /// Likewise where there is no verdict to watch it by but the reflex plane's own.
  [[nodiscard]] std::optional<Switch> supervised_by_atlas(SupervisedScene now) noexcept;
  /// Whether verdicts are looked at before T1, and the last was a while ago.
  [[nodiscard]] bool is_watched(const world::Scene& scene) const noexcept;
  /// Who comes into conflict within T2.
  [[nodiscard]] std::optional<Threat> foreseen(const world::Scene& scene,
                                               const TrackConfirmation& tracks) const noexcept;
  /// Has the verdict before said, too, that waiting costs too much?
  [[nodiscard]] bool agrees_with_last() noexcept;
  /// What is decided before T1; nullopt: to wait.
  [[nodiscard]] std::optional<Decision> decide_early(const world::Scene& scene,
                                                     const Threat& threat) noexcept;

  ReflexTools tools_;
  PlanCache plans_;
  std::optional<Verdict> verdict_;
  std::optional<Decision> decision_;
  std::optional<UnderWay> under_way_;
  Supervisor supervisor_;
  TrackConfirmation tracks_;
  double watched_at_ = never;  ///< a verdict was looked at before T1 [s]
  double costly_at_ = never;   ///< time of the verdict that said last that waiting costs much [s]
  double judged_at_ = never;   ///< what is under way was watched by the atlas [s]
};

}  // namespace saca::reflex
