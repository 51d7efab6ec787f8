#pragma once

#include <cstddef>
#include <optional>

#include "saca/core/static_vector.h"
#include "saca/manoeuvre/plan.h"
#include "saca/preview/policy_facts.h"

namespace saca::decide {

/// What one plan is expected to end in when it begins in the scene of a verdict.
struct JudgedPlan {
  manoeuvre::Plan plan;
  bool drivable = false;  ///< from that scene; else the rest means nothing
  double harm = 0.0;      ///< expected over everything that is not known of the others
  double contact = 0.0;   ///< probability, in [0, 1]
};

/// What every plan is expected to end in, from one scene on. Trivially copyable: it crosses from
/// the forecaster to the reflex plane by value.
struct Verdict {
  double time = 0.0;  ///< of the scene that was judged [s]
  StaticVector<JudgedPlan, preview::Plans::capacity()> plans;
  std::optional<JudgedPlan> under_way;  ///< the rest of a plan under way that has a past (has_past)
};

/// An expected harm that is this much larger is materially larger: for less, no plan under way is
/// left.
constexpr double material_harm = 0.01;

/// How old a verdict may be to be decided by [s].
constexpr double verdict_expiry = 0.1;

/// The plan of the least expected harm among those that can be driven. nullptr: none can.
[[nodiscard]] const JudgedPlan* least_harmful(const Verdict& verdict) noexcept;

/// The expected harms that count as that of the best: what the forecasts cannot tell apart. They
/// are the larger of 0.002 and 3 % of what emergency braking has above the best.
/// @return  the admissible harm at most; nullopt where nothing can be driven
[[nodiscard]] std::optional<double> admissible_harm(const Verdict& verdict) noexcept;

/// How many plans are admissible: can be driven, with at most that harm.
[[nodiscard]] std::size_t num_admissible(const Verdict& verdict) noexcept;

/// The judged plan that is the same as this, begun a little earlier or later: of the same policy,
/// with the nearest target speed. nullptr: none.
[[nodiscard]] const JudgedPlan* find_plan(const Verdict& verdict,
                                          const manoeuvre::Plan& plan) noexcept;

/// The plan that a verdict speaks for. In this order: doing nothing, where no hypothesis has
/// contact then; emergency braking, where it is admissible; the mildest that is admissible, of
/// equally mild ones the least harmful; emergency braking, where nothing can be driven.
///
/// Braking is admissible or worse than all that is: so nothing is knowingly worse than braking.
[[nodiscard]] manoeuvre::Plan plan_of(const Verdict& verdict) noexcept;

/// Whether the judged plan nearest to this one (find_plan) is admissible.
[[nodiscard]] bool admits(const Verdict& verdict, const manoeuvre::Plan& plan) noexcept;

}  // namespace saca::decide
