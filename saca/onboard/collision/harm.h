#pragma once

#include <array>

#include "saca/base/world/road.h"
#include "saca/base/world/scene.h"
#include "saca/onboard/collision/collision_impulse.h"
#include "saca/onboard/collision/face.h"

namespace saca::collision {

/// Probability 1 / (1 + exp(-(intercept + slope x))).
struct RiskCurve {
  double intercept = 0.0;  ///< [-]
  double slope = 0.0;      ///< per unit of x, here [s/m], > 0
};

/// @param x  [m/s]
[[nodiscard]] double probability(const RiskCurve& curve, double x);

/// What of the probability is due to x: (P(x) - P(0)) / (1 - P(0)); 0 at x = 0.
/// @param x  [m/s], >= 0
[[nodiscard]] double attributable(const RiskCurve& curve, double x);

/// Risks of somebody outside a vehicle over the closing speed.
struct UnprotectedRisk {
  RiskCurve severe;  ///< MAIS 3 or worse, the killed among them
  RiskCurve killed;
};

constexpr std::size_t num_actor_kinds = 7;
constexpr std::size_t num_beyond = 4;

/// How contact becomes harm: data/harm.toml, which says where each number comes from.
struct HarmModel {
  double severe_weight = 0.0;  ///< of one expected MAIS 3+ [-], >= 0
  double killed_weight = 0.0;  ///< of one expected death, on top [-], >= 0
  RiskCurve occupant;          ///< MAIS 3+ over delta-v, struck in front
  double side = 0.0;           ///< added to the intercept when struck there [-]
  double rear = 0.0;           ///< likewise
  double killed_share = 0.0;   ///< of occupants MAIS 3+, in [0, 1]
  UnprotectedRisk pedestrian;
  UnprotectedRisk cyclist;
  UnprotectedRisk motorcyclist;
  double ego_people = 0.0;                       ///< in the ego, >= 0
  std::array<double, num_actor_kinds> people{};  ///< by ActorKind, >= 0
  ImpactLaw law;                                 ///< between vehicles; people do not rebound
  double depth = 0.0;                            ///< of `touch` [m], > 0
  std::array<double, num_beyond> speed_share{};  ///< stopped, by Beyond; barrier: 1, not used
};

/// What impacts do to one person, as probabilities in [0, 1].
struct Injury {
  double severe = 0.0;  ///< MAIS 3 or worse, the killed among them
  double killed = 0.0;
};

/// By either of two impacts, taken as independent: 1 - (1 - p)(1 - q), severe and killed apart.
[[nodiscard]] Injury combined(const Injury& first, const Injury& second);

/// Weighted harm of one person.
[[nodiscard]] double weighted(const HarmModel& model, const Injury& injury);

/// What an impact does to one occupant of a vehicle.
/// @param delta_v  [m/s], >= 0; 0 does nothing
[[nodiscard]] Injury occupant_injury(const HarmModel& model, Face struck, double delta_v);

/// What an impact does to one person outside a vehicle: by the curves, but never less, weighted,
/// than to an occupant struck in the side who suffers the closing speed as delta-v.
/// @param kind           pedestrian, bicycle or motorcycle
/// @param closing_speed  [m/s], >= 0; 0 does nothing
[[nodiscard]] Injury unprotected_injury(const HarmModel& model, world::ActorKind kind,
                                        double closing_speed);

/// Weighted harm of one occupant of a vehicle by one impact.
[[nodiscard]] double occupant_harm(const HarmModel& model, Face struck, double delta_v);

/// Is somebody of this kind outside a vehicle?
[[nodiscard]] bool unprotected(world::ActorKind kind);

/// Weighted harm of one person outside a vehicle by one impact.
[[nodiscard]] double unprotected_harm(const HarmModel& model, world::ActorKind kind,
                                      double closing_speed);

}  // namespace saca::collision
