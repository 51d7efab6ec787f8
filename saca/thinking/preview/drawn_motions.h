#pragma once

#include <cstddef>
#include <vector>

#include "saca/base/world/scene.h"
#include "saca/thinking/intent/motion.h"
#include "saca/thinking/intent/observer.h"
#include "saca/thinking/preview/expected_harm.h"
#include "saca/thinking/preview/situation.h"

namespace saca::preview {

/// Draws from all that is not known of how the others move on from a scene, all alike likely.
///
/// In each draw everybody moves in one of the ways that are likely of it (intent::likely_motions),
/// and is off by an error along its line and one across, each of the forecast's spread
/// (intent::Forecast) and kept from now on: errors of perception and manners of driving are not
/// separated. Nobody's errors and ways depend on another's.
///
/// Each road user's draws are a Latin hypercube of way, error along and error across that depends
/// on its name and `count` only: forecasts of one instant and the next differ by what has changed,
/// not by chance, and plans that are held against the same draws are compared in pairs. The points
/// of the hypercube lie as those of a lattice, which leaves fewer gaps than a random one: few draws
/// have to stand for all.
///
/// @param beliefs  one per actor of the scene
/// @param count    >= 1
/// @throws ContractViolation  if beliefs and actors differ in number, or count is 0
///
/// Source: M. D. McKay, R. J. Beckman, W. J. Conover, A comparison of three methods for selecting
/// values of input variables, Technometrics 21, 1979 (the hypercube); H. Niederreiter, Random
/// number generation and quasi-Monte Carlo methods, 1992, chapter 3 (multiples of irrational
/// numbers), with those of M. Roberts, The unreasonable effectiveness of quasirandom sequences,
/// 2018.
[[nodiscard]] std::vector<JointMotion> drawn_motions(const world::Scene& scene,
                                                     const intent::Beliefs& beliefs,
                                                     const intent::MotionLaw& law,
                                                     std::size_t count);

/// Draws of where the others of a situation may be from its trigger on, all alike likely: each
/// moves along its track and is off by an error along and one across, of the situation's spread,
/// which it keeps. Nothing else is drawn: intentions are those of the situation. The hypercube, of
/// two dimensions, is likewise.
/// @param count  >= 1
/// @throws ContractViolation  if the situation lacks a track or a spread, or count is 0
[[nodiscard]] std::vector<JointMotion> drawn_motions(const Situation& situation, std::size_t count);

}  // namespace saca::preview
