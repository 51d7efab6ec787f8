#pragma once

#include "saca/base/world/footprint.h"
#include "saca/thinking/danger/avoidance.h"
#include "saca/thinking/danger/coarse_table_for_test.h"
#include "saca/thinking/danger/danger.h"

namespace saca::learned_danger {

/// A small car before a square at rest: for which of two inputs is better rather than for metres.
struct SquareAtRest {
  danger::Avoidance limits{.grip = 0.9, .tightest_curvature = 0.235, .drive_share = 0.48};
  world::Footprint ego{.length = 2.0, .width = 2.0};
  world::Footprint square{.length = 2.0, .width = 2.0};
  danger::DangerModel model{limits, ego, {danger::coarse_table(limits, ego, square)}};
};

}  // namespace saca::learned_danger
