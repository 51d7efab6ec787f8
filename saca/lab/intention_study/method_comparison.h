#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saca/lab/intention_scoring/bootstrap.h"
#include "saca/lab/intention_scoring/displacement.h"
#include "saca/lab/intention_scoring/evaluation.h"
#include "saca/lab/intention_scoring/sequence_file.h"
#include "saca/thinking/intent/motion.h"

/// How well intentions are recognised: examples, ways to predict beside each other, what people
/// measured, and all of that as documents, texts and pages.
namespace saca::intention_study {

/// Sequences that are scored together.
struct ScoredSet {
  std::vector<intention_scoring::Sequence> sequences;
  std::vector<std::string> splits;  ///< one per sequence
};

/// What was recorded.
/// @param site  only there; empty: everywhere
[[nodiscard]] ScoredSet recorded_of(const intention_scoring::SequenceSet& set,
                                    const std::string& site = "");
/// Simulated vehicles that nothing was trained with: of the split "test".
[[nodiscard]] ScoredSet simulated_of(const intention_scoring::SequenceSet& set);

/// The same without what the vehicles tell of their controls: no pedals, no steering.
[[nodiscard]] ScoredSet nothing_shared(ScoredSet scored);

/// One way to predict and its figures.
struct MethodFigures {
  std::string method;
  intention_scoring::Figures figures;
  /// Our macro F1 less its, and our logarithmic loss less its; of ourselves there is none.
  std::array<std::optional<intention_scoring::Interval>, intention_scoring::num_heads>
      macro_f1_difference;
  std::array<std::optional<intention_scoring::Interval>, intention_scoring::num_heads>
      log_loss_difference;
};

/// Everything that is compared on the same sequences; ours comes first.
class MethodComparison {
 public:
  /// @param scored   outlives this
  /// @param classes  over which macro F1 is taken; they outlive this
  /// @param seed     of the groups that are drawn for intervals
  MethodComparison(std::string title, const ScoredSet& scored, std::span<const std::size_t> classes,
                   std::uint64_t seed);

  /// @param forecasts  one per sequence
  void add(const std::string& method, std::vector<intention_scoring::Forecasts> forecasts);

  [[nodiscard]] const std::string& title() const { return title_; }
  [[nodiscard]] const std::vector<MethodFigures>& methods() const { return methods_; }
  /// Where our own forecasts say that vehicles will be.
  [[nodiscard]] intention_scoring::Displacements displacements(const intent::MotionLaw& law) const;

 private:
  std::string title_;
  const ScoredSet& scored_;
  std::span<const std::size_t> classes_;
  std::uint64_t seed_;
  std::vector<intention_scoring::Forecasts> ours_;
  std::vector<MethodFigures> methods_;
};

}  // namespace saca::intention_study
