#pragma once

#include <limits>
#include <optional>

namespace saca::scenario {

/// How well the ego perceives the others and the road. As it stands, perfectly: what is perceived
/// is the truth.
struct PerceptionModel {
  double position_sd = 0.0;       ///< of an actor's position, on each axis [m], >= 0
  double velocity_sd = 0.0;       ///< likewise of its velocity [m/s], >= 0
  double heading_sd = 0.0;        ///< of its heading [rad], >= 0
  double correlation_time = 0.0;  ///< after which 1/e of an error is left [s], >= 0; 0: white
  double latency = 0.0;           ///< from measurement to use [s], in [0, 2]; whole looks count
  double dropout = 0.0;           ///< probability that a look misses an actor, in [0, 1]
  double range = std::numeric_limits<double>::infinity();  ///< of the sensors [m], > 0
  bool occlusion = false;     ///< actors hide whom the ego has no free line of sight to
  double confirmation = 0.0;  ///< for which one must be seen to be sure that it is there [s], >= 0
  double memory = 0.0;        ///< for which a lost actor is kept, ever less sure [s], >= 0
  std::optional<double> grip_believed;  ///< friction coefficient, in (0, 1.2]; nullopt: the true
  double grip_sd = 0.0;                 ///< what the ego thinks that belief is worth [-], >= 0

  bool operator==(const PerceptionModel&) const = default;
};

}  // namespace saca::scenario
