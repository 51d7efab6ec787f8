#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "saca/base/world/footprint.h"
#include "saca/base/world/track.h"

namespace saca::collision {

/// Bounds of all places that a body covers on its way along a track: one octagon for every few
/// poses, with sides along the axes of the world and at 45 degrees to them.
///
/// Nothing of the body ever lies outside, also between poses, where it moves straight and turns
/// evenly, and outside the track's times, where it rests at its first and last pose. So where the
/// octagons of two bodies are apart at all times, the bodies never meet, which takes a fraction of
/// the time that the exact search (approach.h) takes to find out.
class SweptBoxes {
 public:
  /// Poses are finite, there is at least one, and the step is > 0.
  SweptBoxes(const world::Footprint& footprint, const world::Track& X_WA);

  /// May the two bodies come as near to each other as `distance`, or nearer, from `start` to `end`?
  /// False is certain.
  /// @param start, end  of the tracks' time [s], start <= end
  /// @param distance    [m], >= 0
  friend bool may_come_near(const SweptBoxes& a, const SweptBoxes& b, double start, double end,
                            double distance);

 private:
  /// From the least to the largest coordinate of what it holds along each direction [m].
  struct Octagon {
    std::array<double, 4> low;
    std::array<double, 4> high;
  };

  [[nodiscard]] static bool are_near(const Octagon& a, const Octagon& b, double distance);
  [[nodiscard]] std::size_t part_at(double time) const;
  [[nodiscard]] double end_of(std::size_t part) const;

  double start_;                ///< of the first part [s]
  double span_;                 ///< of each part [s]
  std::vector<Octagon> parts_;  ///< in order of time; the first and the last have no end
  Octagon all_;                 ///< holds them
};

[[nodiscard]] bool may_come_near(const SweptBoxes& a, const SweptBoxes& b, double start, double end,
                                 double distance);

}  // namespace saca::collision
