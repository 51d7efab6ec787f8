#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include "saca/base/core/static_vector.h"
#include "saca/base/world/scene.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/onboard/reflex/under_way.h"
#include "saca/onboard/reflex/verdict.h"

namespace saca::reflex {

/// Why another plan begins in place of the one under way.
enum class SwitchReason : std::uint8_t {
  needed_after_all,  ///< nothing was done, and now something has to be
  no_longer_needed,  ///< nobody is in the way under any hypothesis: the wheel is given back
  better_by_far,     ///< from the present state, the other is materially better
  harder_needed,     ///< braking goes on, but harder: that is expected to harm less
  cannot_be_judged,  ///< nothing was done, a conflict is near, and nobody can say what is best
};
[[nodiscard]] std::string_view name(SwitchReason reason);

/// What going on with a plan under way is expected to end in: the rest of it, where it has a past
/// (has_past), else the same begun anew. nullptr: the verdict does not say.
[[nodiscard]] const JudgedPlan* going_on(const Verdict& verdict,
                                         const manoeuvre::Plan& under_way) noexcept;

/// Another plan begins.
struct Switch {
  manoeuvre::Plan plan;
  SwitchReason reason = SwitchReason::needed_after_all;
  double harm = 0.0;  ///< expected of it; 0 where nobody can say
  double harm_before =
      0.0;  ///< of going on, or of doing nothing where nothing is under way; likewise
};

/// What the supervisor looks at. Refers to what it is given.
struct SupervisedScene {
  const world::Scene& scene;
  const Verdict* verdict = nullptr;  ///< made after the plan under way began; not null for `look`
  bool by_atlas = false;  ///< it is the reflex plane's own (AtlasJudge), which supposes that others
                          ///< go on as they do
  const UnderWay& under_way;
  bool threatened = false;  ///< somebody is in conflict within T2, all going on as they do
  bool triggers = false;    ///< likewise within T1
  bool finished = false;    ///< the plan has reached its safe end
};

/// Whether nothing is under way any more: nothing was done, or the plan has reached its safe end.
[[nodiscard]] bool is_idle(const UnderWay& under_way, bool finished) noexcept;
/// Whether a verdict of the atlas may change anything: only to more than is done now.
[[nodiscard]] bool may_do_more(const UnderWay& under_way, bool finished) noexcept;

/// Watches a plan from the trigger on, verdict by verdict. It may
/// * begin what a verdict speaks for where nothing was done, or a swerve has come to its end,
///   whenever the trigger's rule fires;
/// * give the wheel back where braking is under way and, for `clear_time`, doing nothing harms
///   nobody under any hypothesis;
/// * brake harder at once, as often as it likes, where braking is under way and harder braking is
///   expected to harm less by more than collision::harm_tie: to wait for a second verdict would
///   cost way, and nothing is begun that was not under way;
/// * begin another plan, gentler braking or doing nothing among them, where the least harmful is
///   expected to harm less than going on by `material_harm`, and what would begin (plan_of) less
///   than going on, in two verdicts one after the other: once, and once more for each road user who
///   has come since. Not out of a drift, which cannot be left.
/// By a verdict of the atlas, which knows one motion of each road user, nothing is given up that
/// was begun: only the first and the third. Trivially copyable; allocates nothing.
class Supervisor {
 public:
  static constexpr double period = look_ahead;  ///< between two verdicts that are looked at [s]
  static constexpr double clear_time = 0.5;     ///< [s]

  /// Whether another verdict is looked at: the last was looked at `period` ago, the ego moves, and
  /// where nothing is under way, the trigger's rule fires.
  [[nodiscard]] bool is_due(const world::Scene& scene, const UnderWay& under_way, bool triggers,
                            bool finished) const noexcept;

  /// A plan begins at the trigger.
  void begin(const world::Scene& scene) noexcept;

  /// @param car  nullptr: what cannot be driven is not found out
  /// @return     what begins now; nullopt: what is under way goes on
  [[nodiscard]] std::optional<Switch> look(const SupervisedScene& now,
                                           const manoeuvre::Car* car) noexcept;

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();
  struct Name {
    world::ActorKind kind = world::ActorKind::car;
    std::uint8_t id = 0;
  };

  [[nodiscard]] bool somebody_came(const world::Scene& scene) const noexcept;
  void note(const world::Scene& scene) noexcept;
  [[nodiscard]] std::optional<Switch> better(const SupervisedScene& now) noexcept;

  StaticVector<Name, world::max_actors> known_;       ///< when the last plan began
  double looked_at_ = -never;                         ///< when a verdict was last looked at [s]
  double verdict_at_ = -never;                        ///< of which scene it was [s]
  std::optional<double> clear_since_;                 ///< [s]
  std::optional<manoeuvre::PolicyId> better_before_;  ///< what the last verdict would have begun
  bool switched_ = false;
};

}  // namespace saca::reflex
