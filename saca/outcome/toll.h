#pragma once

#include <vector>

#include "saca/outcome/blow.h"

namespace saca::outcome {

/// Harm of a chain of blows, each of which follows from those before it.
class Toll {
 public:
  /// Both outlive the toll.
  Toll(const HarmModel& harm, const world::Scene& scene);

  /// The next blow of the chain. It comes only if all whom the ego has met so far are really there.
  void add(const Blow& blow);

  /// Expected, weighted.
  [[nodiscard]] double harm() const { return expected_; }

 private:
  [[nodiscard]] double harm_if_certain() const;

  const HarmModel& harm_;
  const world::Scene& scene_;
  Injury ego_;
  std::vector<Injury> others_;  ///< by actor
  std::vector<bool> met_;       ///< likewise
  double chance_ = 1.0;         ///< that the chain comes as far as the last blow
  double certain_ = 0.0;        ///< harm of the chain if it comes so far
  double expected_ = 0.0;
};

}  // namespace saca::outcome
