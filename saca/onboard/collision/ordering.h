#pragma once

#include "saca/onboard/manoeuvre/plan.h"

namespace saca::collision {

struct Outcome;

/// How much a policy takes out of the driver's and the others' hands: a rank, not a quantity.
///
/// 0 no intervention: nobody is surprised. 1 AEB: the lane is kept, speed only falls, followers see
/// brake lights. 2 ES-B: the lane is left, speed falls. 3 AES: the lane is left at full speed.
/// 4 T-drift: the car slides and cannot be recovered at will.
[[nodiscard]] int severity(manoeuvre::PolicyId policy);

/// Is `a` the milder one? Left and right are equals.
[[nodiscard]] bool milder(manoeuvre::PolicyId a, manoeuvre::PolicyId b);

/// Width of the classes within which harms count as equal: a ten-thousandth of a severely injured
/// person, far below what the risk curves know.
constexpr double harm_tie = 1e-4;

/// Number of a harm's class, round(harm / harm_tie).
/// @throws ContractViolation  if harm is not a number >= 0
[[nodiscard]] double harm_class(double harm);

/// Is carrying out `policy_a`, which ends in `a`, better than `policy_b`, which ends in `b`?
///
/// The one comparison for decisions, best-in-hindsight and labels. In this order: the lower class
/// of harm, round(harm / harm_tie); the milder policy; the larger clearance, to the millimetre.
/// Classes rather than differences, so that the relation is a strict weak order: it can sort, and
/// the best of many does not depend on the order in which they come.
/// @throws ContractViolation  if a harm or a clearance is not a number >= 0
[[nodiscard]] bool better(const Outcome& a, manoeuvre::PolicyId policy_a, const Outcome& b,
                          manoeuvre::PolicyId policy_b);

}  // namespace saca::collision
