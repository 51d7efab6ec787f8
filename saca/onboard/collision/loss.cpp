#include "saca/onboard/collision/loss.h"

#include "saca/base/core/contract.h"

namespace saca::collision {

double collision_loss(Face ego_face, double relative_speed) {
  expects(relative_speed >= 0.0, "relative_speed >= 0");
  switch (ego_face) {
    case Face::front:
      return 0.35 * relative_speed;
    case Face::rear:
      return 0.21 * relative_speed;
    case Face::left:
    case Face::right:
      break;
  }
  return 0.41 * relative_speed;
}

double false_trigger_loss(manoeuvre::PolicyId policy) {
  using manoeuvre::PolicyId;
  if (policy == PolicyId::no_intervention) {
    return 0.0;
  }
  return manoeuvre::drifts(policy) ? 1.0 : 0.5;
}

}  // namespace saca::collision
