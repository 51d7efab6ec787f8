#pragma once

// Tapes for the tests of this module.

#include <gtest/gtest.h>

#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/collision/harm.h"
#include "saca/runtime/planes.h"
#include "saca/runtime/tape.h"
#include "saca/runtime/wreck_for_test.h"
#include "saca/thinking/intent/shipped_model.h"

namespace saca::runtime {

/// A car that drives towards a wreck at 20 m/s on a dry road, and what it decides with. It drives
/// on whatever is decided, and the wreck vanishes 0.4 s after the trigger.
struct TapedDrive {
  manoeuvre::Car car = prepare::default_car();
  collision::HarmModel harm = prepare::read_harm("data/harm.toml").value();
  SteadyClock steady;

  [[nodiscard]] PlanesSetup setup(Pace pace = Pace::lockstep, Clock* clock = nullptr) {
    return {.forecast = {&car, &harm},
            .pace = pace,
            .costs = {.preview = 0.05, .verdict = 0.03},
            .clock = clock == nullptr ? &steady : clock,
            .tape_size = 400 * Tape::step_size(1)};
  }

  /// From 3 s before the conflict on, for `num_steps` of 10 ms; at pace `real` on the setup's
  /// clock.
  [[nodiscard]] TapeContent driven(const PlanesSetup& setup, int num_steps = 330) const {
    Planes planes(setup, {}, 0);
    intent::Observer observer(intent::shipped_model());
    const Clock::Time start = setup.clock->now();
    std::optional<double> gone;
    for (int k = 0; k < num_steps; ++k) {
      world::Scene scene = wreck_ahead(car, 64.5);
      scene.time = 0.01 * k;
      scene.ego.X_WB.p.x = 0.2 * k;
      if (gone && scene.time > *gone) {
        scene.actors.clear();
      }
      const intent::Beliefs& beliefs = observer.look(scene);
      const Clock::Time at = start + from_seconds(scene.time);
      if (planes.step(scene, beliefs, at, false).triggered) {
        gone = scene.time + 0.4;
      }
      if (setup.pace == Pace::real) {
        setup.clock->wait_until(start + from_seconds(scene.time + 0.01));
      }
    }
    EXPECT_EQ(planes.finish(), "");
    return planes.tape().content();
  }
};

}  // namespace saca::runtime
