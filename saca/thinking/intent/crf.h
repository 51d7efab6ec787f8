#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace saca::intent {

/// What a vehicle can be about to do: the first six values of Intention, the paper's eq. 5.
constexpr std::size_t num_classes = 6;

/// One number per class, in the order of Intention.
using Scores = std::array<double, num_classes>;

/// A linear-chain conditional random field over the classes.
///
///   log p(y | x) = start[y_1] + sum_t emission_t[y_t] + sum_t transition[y_t-1][y_t] - log Z
///
/// A transition or start of -infinity forbids it.
/// Source: Lafferty, McCallum, Pereira, Conditional random fields, ICML 2001.
struct Crf {
  Scores start{};
  std::array<Scores, num_classes> transition{};  ///< [from][to]
};

constexpr double forbidden = -std::numeric_limits<double>::infinity();

/// Which classes may be the true one at an instant: bit k for class k. Where labels are in doubt,
/// several.
using ClassSet = std::uint8_t;
constexpr ClassSet any_class = (1U << num_classes) - 1U;
[[nodiscard]] constexpr ClassSet only(std::size_t k) {
  return static_cast<ClassSet>(1U << k);
}

/// log of the sum over x. Empty or all -infinity: -infinity.
[[nodiscard]] double log_sum_exp(std::span<const double> x);

/// log of the sum over all paths of the exponential of their scores; over those paths only that
/// keep to `allowed`, where that is given.
/// @param emissions  [t][class], at least one
/// @param allowed    empty, or one set per emission
/// @return           -infinity when no path is allowed
[[nodiscard]] double log_partition(const Crf& crf, std::span<const Scores> emissions,
                                   std::span<const ClassSet> allowed = {});

/// Probability of each class at each instant, given all emissions: forward and backward.
/// @throws ContractViolation  when no path is allowed
[[nodiscard]] std::vector<Scores> marginals(const Crf& crf, std::span<const Scores> emissions,
                                            std::span<const ClassSet> allowed = {});

/// The likeliest path; among equals the one that is first where they last differ.
/// @throws ContractViolation  when no path is allowed
[[nodiscard]] std::vector<std::uint8_t> viterbi(const Crf& crf, std::span<const Scores> emissions);

/// log-likelihood of what is known of a path, and its derivatives with respect to everything:
/// log Z(allowed) - log Z. Derivatives at forbidden transitions are 0.
struct Likelihood {
  double value = 0.0;  ///< <= 0
  std::vector<Scores> emissions;
  Crf crf;
};
/// @throws ContractViolation  when no path is allowed
[[nodiscard]] Likelihood likelihood(const Crf& crf, std::span<const Scores> emissions,
                                    std::span<const ClassSet> allowed);

/// The chain followed as its emissions come: what is known at each instant of the present class,
/// without looking back or ahead. Fixed in size.
class CrfFilter {
 public:
  /// Probability of each class now: the forward pass, normalised. The chain outlives no call.
  /// @throws ContractViolation  when no path is allowed
  const Scores& step(const Crf& crf, const Scores& emission);
  /// Begins anew.
  void reset() { started_ = false; }

 private:
  bool started_ = false;
  Scores now_{};
};

}  // namespace saca::intent
