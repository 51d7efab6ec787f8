#pragma once

#include "saca/intent/motion.h"

namespace saca::intent {

/// What is known of intentions beforehand. What people intend is told by a rule, which has no
/// numbers of its own to learn; how they move then is here.
struct Model {
  MotionLaw motion;
};

}  // namespace saca::intent
