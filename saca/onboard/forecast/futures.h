#pragma once

#include <array>
#include <optional>
#include <span>

#include "saca/onboard/atlas/atlas.h"
#include "saca/onboard/collision/outcome.h"

namespace saca::forecast {

/// What the atlas says that one plan leads to.
struct Future {
  manoeuvre::Plan plan;
  std::optional<atlas::AtlasLimit> outside;   ///< why nothing is said; the rest is meaningless
  std::optional<collision::Contact> contact;  ///< the first at the mean, as in Outcome
  double probability = 0.0;     ///< of contact with anybody there, or an edge that stops the ego
  double harm = 0.0;            ///< expected, of one first contact and edges that do not stop
  double harm_at_mean = 0.0;    ///< that of `contact`, those who exist likely enough counted so
  double collision_loss = 0.0;  ///< of `contact`, as in Outcome
  double clearance = collision::far_away;     ///< at the mean, as in Outcome [m]
  std::optional<collision::Nearest> nearest;  ///< likewise
  double end_time = 0.0;                      ///< at rest or lane recovered, whatever is struck [s]
};

using Futures = std::array<Future, manoeuvre::num_policies>;  ///< by PolicyId

/// From which of the starting speed's shares the target of 3 and 4 is chosen.
constexpr std::array target_shares{0.5, 0.0, 0.25, 0.75};

/// How far a scene and its tracks may be from the truth.
struct Uncertainty {
  atlas::AtlasBounds bounds;  ///< of the start state
  /// How far each actor may be from its track, over time. None at all, or nothing said of an actor:
  /// as its position_sd and velocity_sd have it, the same along as across.
  std::span<const world::SpreadOverTime> spreads;
};

/// What policies that brake may choose from.
struct BrakingChoices {
  /// Targets of 3 and 4: each 0, or a share of the starting speed that the atlas' grid spans; the
  /// first of equals is taken.
  std::span<const double> shares = target_shares;
  /// Of 0 beside all of the grip, likewise.
  std::span<const double> strengths = manoeuvre::braking_strengths;
};

/// One plan, read from the atlas against the others' tracks. Allocates nothing, never throws: what
/// cannot be judged says so in `outside`.
///
/// @param tracks  one per actor of the scene, in its order; before its track starts an actor is
///                not there. Its position_sd, velocity_sd and existence say how far to trust it.
///                Only its first and last pose are made sure to be finite; poses between them that
///                are not touch nobody
///
/// The scene's grip is believed and, but for grip_sd, true. Left out: whoever is struck second
/// (`collision_sequence` has it), what others do when the ego moves otherwise (give the tracks that
/// they take), and that errors last: each instant is judged alone.
[[nodiscard]] Future future(const atlas::Atlas& atlas, const manoeuvre::Plan& plan,
                            const world::Scene& scene, std::span<const world::Track> tracks,
                            const collision::HarmModel& harm,
                            const Uncertainty& uncertainty = {}) noexcept;

/// Is `a` better than `b`? As `better`: class of harm, milder policy, clearance; what is outside
/// comes last.
[[nodiscard]] bool better(const Future& a, const Future& b) noexcept;

/// All eight. 3 and 4 brake to whichever of the shares of the present speed is best, 0 by whichever
/// strength is.
[[nodiscard]] Futures futures(const atlas::Atlas& atlas, const world::Scene& scene,
                              std::span<const world::Track> tracks,
                              const collision::HarmModel& harm, const BrakingChoices& choices = {},
                              const Uncertainty& uncertainty = {}) noexcept;

}  // namespace saca::forecast
