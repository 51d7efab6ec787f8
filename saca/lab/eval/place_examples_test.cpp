#include "saca/lab/eval/place_examples.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "saca/lab/eval/scenes_for_test.h"

namespace saca::eval::place_examples_test {
namespace {

/// Way that the car of `car_that_brakes` has made: 20 m/s, braking at 6 m/s2 from 2 s on, to rest
/// within 3.33 s.
double way(double time) {
  const double braking = std::clamp(time - 2.0, 0.0, 20.0 / 6.0);
  return 20.0 * std::min(time, 2.0 + 20.0 / 6.0) - 3.0 * braking * braking;
}

// Seen exactly for 6 s: what comes 3 s later is known of the looks at 0, 0.1, ... 2.9 s at least.
TEST(PlaceExamples, HoldWhatIsSeenAndWhatComes) {
  const scenario::Scenario scenario = car_that_brakes();
  const manoeuvre::Car car = prepare::default_car();
  const collision::HarmModel harm = shipped_harm();
  const encounter::Stage stage{&scenario, &car, &harm, &intent::shipped_model(), {}, {}};
  const auto sequences = place_examples(stage).value();
  ASSERT_EQ(sequences.size(), 1U);
  const std::vector<PlaceExample>& sequence = sequences[0];
  ASSERT_EQ(sequence.size(), 60U);  // until 5.9 s
  for (std::size_t n = 0; n < sequence.size(); ++n) {
    const PlaceExample& one = sequence[n];
    const double t = 0.1 * static_cast<double>(n);
    EXPECT_EQ(one.known, n < 30U) << t;
    if (!one.known) {
      continue;
    }
    EXPECT_NEAR(one.speed, t <= 2.0 ? 20.0 : 20.0 - 6.0 * (t - 2.0), 0.05);
    EXPECT_NEAR(one.features[static_cast<std::size_t>(intent::Feature::speed)], one.speed / 30.0,
                1e-6);
    for (std::size_t k = 0; k < forecast_times.size(); ++k) {
      EXPECT_NEAR(one.places[k].x, way(t + forecast_times[k]) - way(t), 0.05) << t;
      EXPECT_NEAR(one.places[k].y, 0.0, 1e-6);
    }
  }
}

TEST(PlaceExamples, AreOfVehiclesOnly) {
  scenario::Scenario scenario = car_that_brakes();
  scenario.actors[0].kind = world::ActorKind::pedestrian;
  std::get<scenario::Script>(scenario.actors[0].motion).speed = 5.0;
  const manoeuvre::Car car = prepare::default_car();
  const collision::HarmModel harm = shipped_harm();
  const encounter::Stage stage{&scenario, &car, &harm, &intent::shipped_model(), {}, {}};
  EXPECT_TRUE(place_examples(stage).value().empty());
}

}  // namespace
}  // namespace saca::eval::place_examples_test
