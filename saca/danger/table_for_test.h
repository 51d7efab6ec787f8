#pragma once

#include "saca/reach/avoidance.h"
#include "saca/reach/coarse_table_for_test.h"
#include "saca/reach/danger.h"
#include "saca/world/footprint.h"

namespace saca::danger {

/// A small car before a square at rest: for which of two inputs is better rather than for metres.
struct SquareAtRest {
  reach::Avoidance limits{.grip = 0.9, .tightest_curvature = 0.235, .drive_share = 0.48};
  world::Footprint ego{.length = 2.0, .width = 2.0};
  world::Footprint square{.length = 2.0, .width = 2.0};
  reach::DangerModel model{limits, ego, {reach::coarse_table(limits, ego, square)}};
};

}  // namespace saca::danger
