#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/base/world/footprint.h"
#include "saca/lab/learned_danger/net_inputs.h"
#include "saca/lab/learned_danger/transitions.h"
#include "saca/thinking/danger/avoidance.h"
#include "saca/thinking/danger/avoidance_case.h"
#include "saca/thinking/danger/grid.h"
#include "saca/thinking/danger/obstacle_frame.h"
#include "saca/thinking/danger/value_table.h"

/// The car of the exact tables (danger/avoidance.h) in place of the full vehicle: what learning and
/// its networks get wrong can be told here, because V_h is known.
namespace saca::learned_danger {

/// A point with course and speed beside one obstacle at rest, which lies at the origin along x.
struct PointMass {
  danger::Avoidance system;  ///< its obstacle_speed is 0
  world::Footprint ego;      ///< about the centre of mass
  world::Footprint obstacle;
};

/// A solved table of it.
struct ExactPointMass {
  PointMass problem;
  std::string text;  ///< the case's, as its file has it
  danger::View view = danger::View::ego;
  danger::ValueTable table;  ///< of the last snapshot

  /// V_h of x, y [m], course [rad] and speed [m/s]. Must not outlive this.
  [[nodiscard]] danger::ValueAt value() const { return danger::in_obstacle_frame(table, view); }
};
/// @return  Error::Code::unreadable, malformed or out_of_range, naming the file: no solved value,
/// or
///          not a whole one of an obstacle at rest
[[nodiscard]] Result<ExactPointMass> read_exact_point_mass(const std::filesystem::path& path);

/// What the networks see of it.
/// @param at  x, y [m], course [rad], speed [m/s]
[[nodiscard]] SeenByNet seen_by_net(const PointMass& problem, const danger::State& at);

/// Drives of the point mass, each one situation, in the ways in which the full vehicle is driven
/// (Mixture, Behaviour; evasions by what is least of V_h a moment ahead). One in two starts where
/// |V_h| < 2 m, the others anywhere that `exact` knows, apart from the obstacle. The car's limits
/// move what is demanded.
/// @param exact  V_h
[[nodiscard]] Transitions point_mass_transitions(const PointMass& problem,
                                                 const danger::ValueAt& exact, int drives,
                                                 std::uint64_t seed);

/// What each of the same inputs leads to from many states: of S states and A inputs.
struct Outcomes {
  std::size_t num_inputs = 0;      ///< A
  std::vector<float> states;       ///< (S x num_net_inputs)
  std::vector<float> h_at;         ///< (S), [m]
  std::vector<float> next_states;  ///< (S x A x num_net_inputs), `look_step` later
  std::vector<float> next_h;       ///< (S x A), there [m]
  std::vector<float> h;            ///< (S x A), the deepest on the way [m]
  std::vector<float> settled;      ///< (S x A), 1: nothing can happen after that
  [[nodiscard]] std::size_t num_states() const { return h_at.size(); }
};

/// From states of such drives: sixteen inputs all around the grip, and none. All of h is as it is
/// told (net_inputs.h).
[[nodiscard]] Outcomes point_mass_outcomes(const PointMass& problem, const danger::ValueAt& exact,
                                           int states, std::uint64_t seed);

/// How a value lies beside the exact one, where that is within 2 m of the boundary.
struct ValueErrors {
  std::size_t states = 0;
  double mean_size = 0.0;  ///< [m]
  double p99_size = 0.0;   ///< [m]
  double bias = 0.0;       ///< > 0: too careful [m]
  double same_sign = 0.0;  ///< share
};

/// Values of many states [m].
using Values = std::function<std::vector<double>(std::span<const danger::State>)>;

/// Over states drawn evenly from those that lie there, at up to `fastest` [m/s].
[[nodiscard]] ValueErrors value_errors(const PointMass& problem, const danger::ValueAt& exact,
                                       const Values& values, double fastest, int states,
                                       std::uint64_t seed);

}  // namespace saca::learned_danger
