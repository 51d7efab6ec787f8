#pragma once

#include <algorithm>

namespace saca::model_host {

/// The largest cost of the last steps, forgotten slowly [s]: what the next step is planned with.
class RecentCost {
 public:
  /// @param cost  of a step [s], >= 0
  void add(double cost) { cost_ = std::max(cost, forgetting * cost_); }

  /// Once for each ask, whether or not a step follows: a cost that leaves no step any time would
  /// never be forgotten by steps alone.
  void fade() { cost_ *= forgetting; }

  /// 0 before the first step [s].
  [[nodiscard]] double get() const { return cost_; }

 private:
  static constexpr double forgetting = 0.8;  // half forgotten after three steps
  double cost_ = 0.0;
};

}  // namespace saca::model_host
