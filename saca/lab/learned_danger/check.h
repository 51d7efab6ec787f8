#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "saca/base/world/footprint.h"
#include "saca/lab/learned_danger/acting.h"
#include "saca/lab/learned_danger/margins.h"
#include "saca/lab/learned_danger/network.h"
#include "saca/onboard/manoeuvre/car.h"

namespace saca::learned_danger {

/// One situation, what V_h was told of it, and what came of it.
struct CheckedCase {
  double speed = 0.0;  ///< of the ego at the start [m/s]
  double grip = 0.0;
  std::size_t num_obstacles = 1;
  bool is_straight = false;  ///< straight_evasion is enough at the start
  double told = 0.0;         ///< V_h at the start, by the network [m]
  double told_alone = 0.0;   ///< the highest of the obstacles, each by itself [m]
  double acted = 0.0;        ///< highest h when driven by `evasion` [m]
  double best = 0.0;         ///< least of the highest h of all drives that were tried, that one
                             ///< included: V is at most that [m]
  /// Each obstacle by itself is evaded by some drive, all together by none.
  bool is_pincer = false;
};

/// A situation that no data set has, and what comes of it: the full vehicle is driven by
/// `evasion`, by the best arc looked for anew at each look, for each obstacle, and by ten demands
/// and sequences of them that drivers and controllers give. One in two starts within 2 m of the
/// boundary as arcs see it.
/// @param body  of the ego, about its centre of mass
[[nodiscard]] CheckedCase checked(const manoeuvre::Car& car, const world::Footprint& body,
                                  const Network& network, std::uint64_t seed);

/// What a margin is counted from: one situation, what V_h was told of it, and what came of it.
struct MarginSample {
  std::size_t bin = 0;          ///< bin_of
  double told = 0.0;            ///< V_h at the start, by the network [m]
  std::optional<double> acted;  ///< highest h when driven by `evasion` [m]; nullopt: it was not
};

/// A situation as `checked` has them, driven by `evasion` alone, and only if it is told safe.
/// @param wanted  by bin: what lies in others is not driven
[[nodiscard]] MarginSample driven_by_evasion(const manoeuvre::Car& car,
                                             const world::Footprint& body, const Network& network,
                                             std::uint64_t seed,
                                             const std::array<bool, num_bins>& wanted);

/// What the network is worth where what V tells, with each bin's margin added, is taken for true:
/// safe is less than 0.
struct CheckFigures {
  Share hit_given_told_safe;     ///< driven by `evasion`, of what is told safe
  Share hit_given_just_safe;     ///< likewise, of what is told safe by 1 m at most
  Share told_safe_given_hit;     ///< of what no drive evades
  Share false_alarms;            ///< told unsafe, of what some drive evades
  Share agreeing_near;           ///< sign, where the best is within 2 m of the boundary
  double mean_error_near = 0.0;  ///< of V without margin from the best, there: size [m]
  double bias_near = 0.0;        ///< with its sign: > 0 too careful [m]
  double p99_error_near = 0.0;   ///< size [m]
  double lost_near = 0.0;        ///< mean by which `evasion` comes nearer than the best, there [m]
  Share pincers;                 ///< of situations with several obstacles
  Share told_of_pincers;         ///< told unsafe, of pincers
  Share told_alone_of_pincers;   ///< likewise by the highest of single values
};
/// @param margin  of a situation [m]
[[nodiscard]] CheckFigures figures_of(const std::vector<CheckedCase>& all,
                                      const std::function<double(const CheckedCase&)>& margin);

}  // namespace saca::learned_danger
