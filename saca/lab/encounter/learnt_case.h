#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/encounter/encounter.h"
#include "saca/lab/encounter/hindsight.h"
#include "saca/onboard/reflex/verdict.h"
#include "saca/thinking/language_model/review.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/memory/store.h"
#include "saca/thinking/memory/thinning.h"

namespace saca::encounter {

/// The inputs that a case was worked out with: car, harm, intentions, atlas.
/// @param car  its name or file
[[nodiscard]] std::vector<memory::MadeWith> made_with(const preview::ForecastTools& tools,
                                                      const intent::Model& intent,
                                                      const std::string& car);

/// Of each policy the plan that is expected to harm least, by what is seen.
[[nodiscard]] memory::PolicyHarms forecast_harms(const reflex::Verdict& verdict);

/// Of each policy the plan that would have harmed least.
[[nodiscard]] memory::PolicyHarms happened_harms(std::span<const preview::RolledOut> tried);

/// What every case has, however it came about: the scene, what was believed of its actors, and
/// where it comes from.
/// @param beliefs  one per actor
[[nodiscard]] memory::Case case_of(const world::Scene& seen, const intent::Beliefs& beliefs,
                                   const scenario::Scenario& scenario);

/// The trigger of an encounter as SACA saw it, and what followed from it.
struct Trigger {
  world::Scene seen;
  intent::Beliefs beliefs;  ///< one per actor of it
  DecisionPoint point;      ///< the truth
};

/// What memory keeps of an encounter in which something was decided.
/// @param record  with a decision and its hindsight
[[nodiscard]] memory::Case learnt_case(const Setup& setup, const Record& record,
                                       const Trigger& trigger);

/// The case by which memory spoke for what was decided; nullopt: memory did not decide.
/// @param previews  all that was thought until then
[[nodiscard]] std::optional<match::CaseId> followed_case(
    const reflex::Decision& decision, std::span<const arbitration::Preview> previews);

/// The case whose policy was carried out by memory's word and did materially more harm than full
/// braking would have; nullopt: there is none.
/// @param record  with a decision and its hindsight
[[nodiscard]] std::optional<match::CaseId> refuted_case(const Record& record);

/// From now on nobody asks this case, unless a check finds that it holds.
/// @return  what memory could not do; nothing where somebody has deleted it
[[nodiscard]] std::optional<Error> quarantine(memory::Store& memory, match::CaseId id);

/// Memory learns an encounter: its case is added or merged, and a case that it refutes is
/// quarantined. A bank in a file is kept within a bound (memory::keep_within); one on a server
/// belongs to many, who thin it when they want to.
/// @return  what it came to, as the bank then is (Store::catch_up); or what memory could not do
[[nodiscard]] Result<memory::LearningResult> learn(memory::Store& memory, const memory::Case& one,
                                                   const std::optional<match::CaseId>& refuted,
                                                   std::size_t bound = memory::usual_bound);

/// Adds what of a model's review is true to the case that memory learnt; the figures alone it has.
/// @return  what memory could not do
[[nodiscard]] std::optional<Error> keep_lesson(memory::Store& memory, match::CaseId id,
                                               const language_model::Review& review);

}  // namespace saca::encounter
