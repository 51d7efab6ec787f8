#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "saca/base/core/static_vector.h"
#include "saca/base/world/scene.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/onboard/match/feature_index.h"
#include "saca/onboard/match/similarity.h"
#include "saca/thinking/memory/case.h"

namespace saca::memory {

/// By PolicyId: what is to be added to the harm that is expected of a policy [-].
using Corrections = std::array<double, manoeuvre::num_policies>;

/// A harm this little above the least counts as the least [-].
constexpr double as_good = 0.002;

/// Policies, by PolicyId.
using Policies = std::bitset<manoeuvre::num_policies>;

/// Those that harm as little as the best; none where nothing can be driven.
[[nodiscard]] Policies as_good_as_best(const PolicyHarms& harms) noexcept;
/// In a case: by what was told and by what happened, as far as they are known; by neither, the one
/// that is told as the best in hindsight.
[[nodiscard]] Policies as_good_as_best(const Case& one) noexcept;

/// What cases like the scene at hand speak for.
struct Recall {
  manoeuvre::PolicyId policy = manoeuvre::PolicyId::aeb;  ///< as good as the best in most of them
  double share = 0.0;          ///< of them, weighted, in which it was, shrunken; in [0, 1)
  double trusted_share = 0.0;  ///< the same where only trusted cases speak for it
  match::CaseId nearest = 0;   ///< the most alike of those in which it was
  double similarity = 0.0;     ///< of that one, in [0, 1]
};

/// A share as the gates of Algorithm 1 take it: 0.9 where at least 98 % of the policies recalled
/// with so much or more are as good as the best in hindsight, 0.7 where at least 95 % are; in
/// between, below and above linear, from 0 at 0 to 1 at 1 (docs/decisions/0029-experience.md).
[[nodiscard]] double confidence_at(double share) noexcept;

/// What was met, packed to be asked: what like cases speak for, and how expectations erred in them.
/// While nothing is added any number of threads may ask it. Asking allocates nothing and waits for
/// nothing.
class Experience {
 public:
  // Of `recall`: chosen among a few in the tuning split's encounters, each left out in turn.
  static constexpr std::size_t most_recalled = 50;
  static constexpr double recall_reach = 2.0;  ///< r, in units of match::difference
  static constexpr double doubt = 0.3;         ///< weight of what speaks for nothing
  static constexpr std::size_t most_excepted = 14;
  // Of `corrections`: assumptions, tried in docs/decisions/0029-experience.md.
  static constexpr std::size_t most_corrected = 200;
  static constexpr double correction_reach = 3.0;
  static constexpr double prior_cases = 20.0;
  static constexpr double most_counted = 0.5;  ///< of harm [-]

  Experience() = default;
  /// @param car  that asks: of the trusted cases those that another was worked out with speak like
  ///             unchecked ones (is_trusted_by)
  [[nodiscard]] static Experience for_car(std::vector<MadeWith> car);
  /// Of these, in their order.
  explicit Experience(std::span<const Case> cases);

  /// @param one  its id is greater than all before; its scene breaks no rule of
  ///             `world::broken_rule`. Who is quarantined is never asked
  void add(const Case& one);
  /// From now on it speaks for what this says. Its scene stays as it was.
  /// @param one  of an id that was added
  void relearn(const Case& one);
  /// Does it speak for what this says? No matter whether it is asked.
  /// @param one  of an id that was added
  [[nodiscard]] bool is_known_as(const Case& one) const;
  /// From now on this one is not asked.
  /// @param id  of one that was added
  void pass_over(match::CaseId id) { index_.pass_over(id); }

  [[nodiscard]] std::size_t size() const noexcept { return index_.size(); }
  /// 0 when there is none.
  [[nodiscard]] match::CaseId last_id() const noexcept { return index_.last_id(); }

  /// The nearest cases that differ by less than memory::same_encounter, the nearest first, at most
  /// `most_same`.
  static constexpr std::size_t most_same = 16;
  [[nodiscard]] StaticVector<match::CaseId, most_same> same_encounter_as(
      const match::Features& scene) const noexcept;
  /// Forgets all that was met, and asks for the same car.
  void clear() { *this = for_car(std::move(car_)); }

  /// Each policy's share of the weight of the cases that differ least, in which it was as good as
  /// the best; a case weighs exp(-d^2 / 2 r^2) for its difference d, and `doubt` is added to the
  /// whole. Where the car that asks knows the very same scene itself, what other cars know of it is
  /// not asked. The policy of the largest share; of equals the first of PolicyId.
  /// @param except  cases that are not asked, at most `most_excepted`
  /// @return        nullopt where there is none to be asked, or the features are of no scene
  [[nodiscard]] std::optional<Recall> recall(
      const match::Features& scene, std::span<const match::CaseId> except = {}) const noexcept;

  /// Of each policy, over the cases that differ least: the mean of what happened minus what was
  /// told, weighted likewise and shrunk towards 0 as if there were `prior_cases` more in which both
  /// were the same. One case counts by at most `most_counted`: harm is rare and large, and a few
  /// crashes would outweigh all else.
  /// @return  nothing but 0 where there is nothing alike, or the scene breaks a rule
  [[nodiscard]] Corrections corrections(const world::Scene& scene) const noexcept;

 private:
  /// What happened minus what was told; nullopt: one of them is not known.
  using Errors = std::array<std::optional<double>, manoeuvre::num_policies>;
  struct Lesson {
    Policies good;
    Errors errors;
    bool trusted = false;
    bool own = false;         ///< worked out with the car that asks
    bool of_another = false;  ///< worked out with another; neither: who asks or who knew is unknown

    bool operator==(const Lesson&) const = default;
  };

  [[nodiscard]] Lesson lesson_of(const Case& one) const;
  using Hit = match::FeatureIndex::Hit;
  /// Those of them that are asked, as `recall` says.
  [[nodiscard]] StaticVector<Hit, most_recalled> asked(
      std::span<const Hit> hits, std::span<const match::CaseId> except) const noexcept;

  std::vector<MadeWith> car_;
  match::FeatureIndex index_;
  std::vector<Lesson> lessons_;  ///< in its order
  bool has_others_ = false;      ///< some were worked out with another car
};

}  // namespace saca::memory
