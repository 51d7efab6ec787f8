#pragma once

#include <cstddef>

namespace saca::model_host {

/// Tells from when on replies have to be brief, so that they are whole when their time is up: by
/// what a token of a reply, or of the question for its answer, took of late, however many were
/// evaluated together.
class ReplyPace {
 public:
  /// @param cost    of a step [s], >= 0
  /// @param tokens  that it evaluated, of all replies together, > 0
  void add(double cost, std::size_t tokens) {
    cost_ += cost;
    tokens_ += static_cast<double>(tokens);
  }

  /// Once for each ask: what this one takes counts more than what the last one took.
  void fade() {
    cost_ *= kept;
    tokens_ *= kept;
  }

  /// What so many tokens take, as they are written [s]; 0 before the first step.
  [[nodiscard]] double cost_of(std::size_t tokens) const {
    return tokens_ > 0.0 ? static_cast<double>(tokens) * cost_ / tokens_ : 0.0;
  }

  /// @param left    time for replies [s]
  /// @param tokens  that all of them still take if they are brief
  /// @param scenes  how many still reason
  /// @return        whether there is no time for a further statement each; false before the first
  ///                step
  [[nodiscard]] bool is_short(double left, std::size_t tokens, std::size_t scenes) const {
    return tokens_ > 0.0 && margin * cost_of(tokens + scenes * statement_tokens) > left;
  }

 private:
  static constexpr double kept = 0.5;
  static constexpr double margin = 1.25;               ///< steps differ in what they cost
  static constexpr std::size_t statement_tokens = 16;  ///< "truck1, 35 m ahead: AEB hits it."
  double cost_ = 0.0;
  double tokens_ = 0.0;
};

}  // namespace saca::model_host
