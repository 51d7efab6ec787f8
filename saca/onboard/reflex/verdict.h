#pragma once

#include <cstddef>
#include <optional>

#include "saca/base/core/static_vector.h"
#include "saca/onboard/forecast/plans.h"
#include "saca/onboard/manoeuvre/plan.h"

namespace saca::reflex {

/// What one plan is expected to end in when it begins in the scene of a verdict.
struct JudgedPlan {
  manoeuvre::Plan plan;
  bool drivable = false;  ///< from that scene; else the rest means nothing
  double harm = 0.0;      ///< expected over everything that is not known of the others; of braking
                          ///< below full strength see spread_over_strengths
  double contact = 0.0;   ///< probability, in [0, 1]
  std::optional<double> as_seen;  ///< the harm without what is only supposed, by cues of the
                                  ///< scene; nullopt: nothing was
};

/// What every plan is expected to end in, from one scene on. Trivially copyable: it crosses from
/// the forecaster to the reflex plane by value.
struct Verdict {
  double time = 0.0;  ///< of the scene that was judged [s]
  StaticVector<JudgedPlan, forecast::Plans::capacity()> plans;
  std::optional<double> later;  ///< the least expected harm of what begins `waited` later, the ego
                                ///< going on until then; where cues count, the best plan's harm
                                ///< and what waiting costs by what is seen; nullopt: not worked out
  std::optional<JudgedPlan> under_way;  ///< the rest of a plan under way that has a past (has_past)
};

/// An expected harm that is this much larger is materially larger: for less, no plan under way is
/// left.
constexpr double material_harm = 0.01;

/// How much later another verdict could be acted by [s]: as often as one is looked at.
constexpr double look_ahead = 0.1;

/// How long is waited at least where a verdict does not act yet [s]: until another says that
/// waiting costs too much, and the one after it agrees.
constexpr double waited = 2.0 * look_ahead;

/// How old a verdict may be to be decided by [s].
constexpr double verdict_expiry = 0.1;

/// Says of each braking below full strength not what it alone is expected to end in, but the mean
/// over it (1/2), the next harder one and the next gentler one (1/4 each, where they were judged).
///
/// The draws know neither grip nor brakes to be other than believed, and a strength that just
/// suffices for the one ahead and just spares the one behind does so in no other world: the best of
/// several is the one whose forecast errs most to the good side. Half of the weight one step to
/// either side is the three-point rule for a strength that is known to some 20 %, an assumption.
/// Full braking keeps its own harm: it is what all else is held against.
void spread_over_strengths(Verdict& verdict) noexcept;

/// The plan of the least expected harm among those that can be driven. nullptr: none can.
[[nodiscard]] const JudgedPlan* least_harmful(const Verdict& verdict) noexcept;

/// What it is expected to cost to wait for so long: by how much more harm the best plan ends
/// in that begins then. Nothing is learnt meanwhile in this figure: it is what waiting costs at
/// most. nullopt: the verdict does not say.
[[nodiscard]] std::optional<double> cost_of_waiting(const Verdict& verdict) noexcept;

/// The expected harms that count as that of the best: what the forecasts cannot tell apart. They
/// are the larger of 0.002 and 3 % of what full braking has above the best.
/// @return  the admissible harm at most; nullopt where nothing can be driven
[[nodiscard]] std::optional<double> admissible_harm(const Verdict& verdict) noexcept;

/// How many plans are admissible: can be driven, with at most that harm.
[[nodiscard]] std::size_t num_admissible(const Verdict& verdict) noexcept;

/// The judged plan that is the same as this, begun a little earlier or later: of the same policy,
/// with the nearest target speed or strength. nullptr: none.
[[nodiscard]] const JudgedPlan* find_plan(const Verdict& verdict,
                                          const manoeuvre::Plan& plan) noexcept;

/// How to brake: the hardest plan of policy 0 that is expected to harm as little as the best of
/// them, within 0.002 and as admissible. nullptr: none can be driven.
///
/// The harder leaves more distance for what no draw foresees ahead. What those behind gain by the
/// gentler is in the expected harm: they react in every draw.
[[nodiscard]] const JudgedPlan* best_braking(const Verdict& verdict) noexcept;

/// The plan that a verdict speaks for. In this order: doing nothing, where that is admissible; the
/// best braking, where full braking is admissible; where only gentler braking is, the best braking
/// or the mildest admissible lane change or drift (of equally mild ones the least harmful),
/// whichever is expected to harm less, braking where they harm alike (collision::harm_tie); full
/// braking, where nothing can be driven.
///
/// Nobody takes the wheel for what forecasts cannot tell apart: doing nothing is looked at again as
/// long as the trigger's rule fires, and may become anything (Supervisor). Full braking comes next
/// because it stands on no forecast; gentler braking does as a swerve does. Full braking is
/// admissible or worse than all that is: so nothing that is begun is knowingly worse than full
/// braking.
[[nodiscard]] manoeuvre::Plan plan_of(const Verdict& verdict) noexcept;

/// The plan that a choice of memory or model stands for now: of policy 0, which they choose without
/// a strength, the best braking.
[[nodiscard]] manoeuvre::Plan as_judged(const Verdict& verdict,
                                        const manoeuvre::Plan& plan) noexcept;

/// Whether the judged plan nearest to this one (find_plan) is admissible.
[[nodiscard]] bool admits(const Verdict& verdict, const manoeuvre::Plan& plan) noexcept;

}  // namespace saca::reflex
