#pragma once

#include <cstddef>
#include <vector>

#include "saca/lab/intention_scoring/labels.h"
#include "saca/thinking/intent/motion.h"

namespace saca::intention_scoring {

/// A positive quantity's distribution: of its logarithm.
struct LogNormal {
  std::size_t num = 0;  ///< measured; with fewer than two the rest is 0
  double median = 0.0;
  double log_sd = 0.0;  ///< standard deviation of the natural logarithm
};
[[nodiscard]] LogNormal log_normal(const std::vector<double>& values);

/// How people really drive: intent::MotionLaw's numbers, measured.
struct MotionFit {
  LogNormal
      braking;     ///< mean deceleration from beyond the mark to its end, of each braking [m/s^2]
  LogNormal rise;  ///< from half the hardest deceleration of a braking to it, twice [s]
  LogNormal held;  ///< of one who brakes: mean deceleration of the next second over that of now
  LogNormal lane_change;  ///< a lane's width at the highest lateral speed, as a polynomial of fifth
                          ///< order would take [s]
  /// Of those who maintain, beyond doubt: by how far their way after 1 s and after 3 s differs from
  /// that at a constant speed; sd 0: nobody was measured.
  intent::OrnsteinUhlenbeck acceleration;
};

/// @param motions  smoothed or simulated, at steps of `frame_step`
/// @param lane_width  that lane changes are scaled to [m], > 0
[[nodiscard]] MotionFit motion_fit(const std::vector<TrueMotion>& motions, double lane_width);

}  // namespace saca::intention_scoring
