#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "saca/base/world/footprint.h"
#include "saca/lab/learned_danger/net_inputs.h"
#include "saca/lab/learned_danger/transitions.h"

namespace saca::learned_danger {

/// Transitions beside so many obstacles as the networks see them: what V_h and Q_h are learnt from.
/// All of h is as it is told (net_inputs.h).
struct Experience {
  std::size_t num_obstacles = 1;
  /// Of states, rows of num_obstacles x num_net_inputs: those of a situation follow one another,
  /// the last is the state that it ended in.
  std::vector<float> inputs;
  std::vector<float> h_at;  ///< of each obstacle at these states: rows of num_obstacles [m]

  /// Of each transition: the rows of x and of x'.
  std::vector<std::uint32_t> row;
  std::vector<std::uint32_t> next_row;
  std::vector<float> actions;  ///< rows of 2
  std::vector<float> h;        ///< deepest from x to x' [m]
  std::vector<float> settled;  ///< 1: nothing can happen after x' any more
  /// The deepest from x until the situation is settled, at most to the horizon, as it was driven
  /// [m]: V(x) and Q(x, u) are at most that. Infinity where the drive ended before.
  std::vector<float> reached;

  static constexpr float end_not_seen = std::numeric_limits<float>::infinity();
  [[nodiscard]] std::size_t size() const { return row.size(); }
  [[nodiscard]] std::size_t num_states() const { return h_at.size() / num_obstacles; }
};

/// Adds the transitions of situations with as many obstacles as `all` is of.
/// @param body   of the ego, about its centre of mass
/// @param shape  of the obstacles
void add_experience(Experience& all, const Transitions& transitions, const world::Footprint& body,
                    world::Shape shape = world::Shape::box);

/// Keeps what led on with one and the same input for so long, or until all was settled, as one
/// transition: one begins at each look from which on that was so.
/// @param looks  >= 1
void keep_held(Experience& all, int looks);

}  // namespace saca::learned_danger
