#include "saca/onboard/collision/outcome.h"

namespace saca::collision {

bool moves_at_end(const manoeuvre::EgoMotion& motion) {
  return norm(motion.v_B.back()) > at_rest;
}

}  // namespace saca::collision
