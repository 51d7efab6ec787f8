#pragma once

#include <cstdint>
#include <vector>

#include "saca/danger/acting.h"
#include "saca/danger/network.h"
#include "saca/manoeuvre/car.h"
#include "saca/world/footprint.h"

namespace saca::danger {

/// One situation, what V_h was told of it, and what came of it.
struct Checked {
  double speed = 0.0;  ///< of the ego at the start [m/s]
  double grip = 0.0;
  double told = 0.0;   ///< V_h at the start, by the network [m]
  double acted = 0.0;  ///< highest h when driven by the network's own Q [m]
  double best = 0.0;   ///< least of the highest h of all drives that were tried, that one included:
                       ///< V is at most that [m]
};

/// A situation that no data set has, and what comes of it: the full vehicle is driven by Q, by the
/// best arc looked for anew at each look, and by ten demands and sequences of them that drivers and
/// controllers give. One in two starts within 2 m of the boundary as arcs see it.
/// @param body  of the ego, about its centre of mass
[[nodiscard]] Checked checked(const manoeuvre::Car& car, const world::Footprint& body,
                              const Network& network, std::uint64_t seed);

/// So many of all.
struct Share {
  int count = 0;
  int of = 0;
  [[nodiscard]] double value() const { return of > 0 ? static_cast<double>(count) / of : 0.0; }
};

/// Most that a share may be in truth, by what was counted, with this confidence over the draw; 1 of
/// nothing. Source: Clopper and Pearson, Biometrika 26 (1934).
[[nodiscard]] double upper_bound(const Share& share, double confidence);

/// The least margin [m], >= 0, with which nothing that is told safe was hit, driven by Q.
[[nodiscard]] double margin_of(const std::vector<Checked>& all);

/// What the network is worth where what V tells, with a margin [m] added, is taken for true: safe
/// is less than 0.
struct CheckFigures {
  Share hit_given_told_safe;     ///< driven by Q, of what is told safe
  Share told_safe_given_hit;     ///< of what no drive evades
  Share false_alarms;            ///< told unsafe, of what some drive evades
  Share agreeing_near;           ///< sign, where the best is within 2 m of the boundary
  double mean_error_near = 0.0;  ///< of V from the best, there: size [m]
  double bias_near = 0.0;        ///< with its sign: > 0 too careful [m]
  double p99_error_near = 0.0;   ///< size [m]
  double lost_near = 0.0;  ///< mean by which driving by Q comes nearer than the best, there [m]
};
[[nodiscard]] CheckFigures figures_of(const std::vector<Checked>& all, double margin);

}  // namespace saca::danger
