#pragma once

#include <gtest/gtest.h>

#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/thinking/rollout/batch.h"
#include "tests/support/levels.h"

namespace saca::rollout {

/// A stop on one level, against the scalar model; skipped where the processor lacks the level.
inline void expect_stop_as_scalar(SimdLevel level) {
  if (!available(level)) {
    GTEST_SKIP() << "this processor has no " << test::name_of(level);
  }
  const manoeuvre::Car car = prepare::default_car();
  Drive one{.car = &car, .plan = {manoeuvre::PolicyId::aeb, {}}};
  one.ego.v_B = {20.0, 0.0};
  const manoeuvre::EgoMotion reference =
      manoeuvre::drive(car, one.plan, scene_of(one), one.grip, 6.0);
  const manoeuvre::EgoMotion motion = drive_all({&one, 1}, 6.0, 1, level)[0];
  EXPECT_TRUE(motion.ended);
  EXPECT_NEAR(motion.track.X_WA.back().p.x, reference.track.X_WA.back().p.x, 0.05);
}

}  // namespace saca::rollout
