#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "saca/manoeuvre/plan.h"
#include "saca/memory/case.h"
#include "saca/memory/feature_index.h"
#include "saca/world/scene.h"

namespace saca::memory {

/// By PolicyId: what is to be added to the harm that is expected of a policy [-].
using Corrections = std::array<double, manoeuvre::num_policies>;

/// How expectations erred in cases like the scene at hand. What it was made of is not seen to
/// change; any number of threads may ask it.
///
/// Of each policy, over the cases that differ least: the mean of what happened minus what was told,
/// each case weighted by exp(-d^2 / 2 r^2) of its difference d, shrunk towards 0 as if there were
/// `prior_cases` more in which both were the same. One case counts by at most `most_counted`: harm
/// is rare and large, and a few crashes would outweigh all else. Constants are assumptions, tried
/// in docs/decisions/0029.
class Experience {
 public:
  static constexpr std::size_t most_cases = 200;
  static constexpr double reach = 3.0;  ///< r, in units of memory::difference
  static constexpr double prior_cases = 20.0;
  static constexpr double most_counted = 0.5;  ///< of harm [-]

  /// Of those that know both what was told and what happened; who is quarantined is left out.
  explicit Experience(std::span<const Case> cases);

  /// How many cases it has learnt from.
  [[nodiscard]] std::size_t size() const noexcept { return index_.size(); }

  /// Allocates nothing, waits for nothing. Nothing but 0 where there is nothing alike, or the scene
  /// breaks a rule of `world::broken_rule`.
  [[nodiscard]] Corrections corrections(const world::Scene& scene) const noexcept;

 private:
  /// What happened minus what was told; nullopt: one of them is not known.
  using Errors = std::array<std::optional<double>, manoeuvre::num_policies>;

  FeatureIndex index_;  ///< by place in `errors_`, from 1
  std::vector<Errors> errors_;
};

}  // namespace saca::memory
