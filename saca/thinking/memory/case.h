#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/world/scene.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/onboard/match/case_id.h"
#include "saca/thinking/intent/intention.h"

namespace saca::memory {

/// Where what a case says comes from.
enum class Origin : std::uint8_t {
  own,         ///< driven by the car whose memory this is
  simulation,  ///< a scenario that somebody wrote or drew
  recording,   ///< a recorded emergency, played again
  expert,      ///< somebody who knows
};
[[nodiscard]] std::string_view name(Origin origin);
[[nodiscard]] std::optional<Origin> origin_from(std::string_view name);

/// How far the plan of a case may be used.
enum class Trust : std::uint8_t {
  trusted,      ///< where a scene is alike enough, as it is
  unchecked,    ///< only where a rollout in the scene at hand confirms it: it came from elsewhere
  quarantined,  ///< not at all: it proved worse than braking
};
[[nodiscard]] std::string_view name(Trust trust);
[[nodiscard]] std::optional<Trust> trust_from(std::string_view name);

/// What each policy ends in, by PolicyId: the harm of that of its plans that harms least [-];
/// nullopt: it cannot be driven.
using PolicyHarms = std::array<std::optional<double>, manoeuvre::num_policies>;

/// Something that a case was worked out with: a car, an atlas, a network.
struct MadeWith {
  std::string what;
  std::string name;
  std::string digest;  ///< empty: it has none

  bool operator==(const MadeWith&) const = default;
};

/// Car and harm as one word, by their digests; empty where one of them is not known.
[[nodiscard]] std::string car_and_harm(std::span<const MadeWith> made_with);

/// Are car and harm the same, by their digests?
[[nodiscard]] bool same_car_and_harm(std::span<const MadeWith> then, std::span<const MadeWith> now);

/// Were both worked out with the same car and harm, or does one of them not say?
[[nodiscard]] bool may_be_the_same_car(std::span<const MadeWith> a, std::span<const MadeWith> b);

/// Of a case: lessons, or inputs.
constexpr std::size_t most_texts = 100;

/// What memory keeps of an encounter: the scene at the trigger, what was predicted, what was done,
/// what came of it.
struct Case {
  match::CaseId id = 0;  ///< given by the store
  world::Scene scene;
  manoeuvre::Plan plan;                                 ///< carried out
  manoeuvre::PolicyId best = manoeuvre::PolicyId::aeb;  ///< in hindsight
  double harm = 0.0;                                    ///< of what was carried out
  double best_harm = 0.0;                               ///< of the best in hindsight
  double collision_loss = 0.0;                          ///< of what was carried out
  std::string review;  ///< one line on what happened against what was forecast
  std::string source;  ///< scenario and run it came from

  Origin origin = Origin::own;
  Trust trust = Trust::trusted;
  int count = 1;  ///< encounters that it stands for, >= 1; harms are means of them
  std::optional<double> worst_harm;  ///< the largest of them, where there are several
  std::vector<intent::IntentPosterior> intentions;  ///< one per actor; empty: not known
  std::vector<double> risks;                        ///< eq. 4, one per actor; empty: not known
  std::optional<PolicyHarms> told;                  ///< expected at the trigger, by the verdict
  std::optional<PolicyHarms> happened;              ///< in hindsight
  int draws = 1;                     ///< of what is left to chance that `happened` is the mean of
  std::vector<std::string> lessons;  ///< statements of the review that were checked and hold
  std::vector<MadeWith> made_with;
};

/// Is nothing known of it but what somebody says is best, and perhaps what a check expects of it?
/// Its harms are of no encounter.
[[nodiscard]] bool is_hearsay(const Case& one) noexcept;

/// May it be used by a car of this make as it is, without a rollout in the scene at hand?
/// @param car  what a case of that car is made with; empty: no matter which
[[nodiscard]] bool is_trusted_by(std::span<const MadeWith> car, const Case& one);

/// Is it trusted by a car that is known, and not by this one?
/// @param car  likewise, not empty
[[nodiscard]] bool is_trusted_by_another(std::span<const MadeWith> car, const Case& one);

/// What is wrong with a case: the key by which files call it, and what was wanted.
struct CaseProblem {
  std::string key;
  std::string why;
};

/// @return  the first rule that is broken: harms finite and >= 0, a target speed only where the
///          policy has one, one intention and risk per actor, few texts, all in UTF-8; nullopt when
///          it can be kept. The scene's own rules are those of world::broken_rule.
[[nodiscard]] std::optional<CaseProblem> broken_rule(const Case& one);

}  // namespace saca::memory
