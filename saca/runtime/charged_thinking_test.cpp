#include "saca/runtime/charged_thinking.h"

#include <gtest/gtest.h>

#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/runtime/wreck_for_test.h"
#include "saca/thinking/intent/shipped_model.h"

namespace saca::runtime::charged_thinking_test {
namespace {

reflex::PlanCache plans(std::size_t count) {
  reflex::PlanCache cache;
  while (cache.size() < count) {
    cache.push_back({});
  }
  return cache;
}

TEST(ChargedThinking, HoldsPlansBackUntilTheyAreReady) {
  ManualClock clock;
  ChargedThinking thinking(0.1, clock);
  EXPECT_FALSE(thinking.take(10.0).has_value());
  thinking.publish(plans(1), 1.0);
  thinking.publish(plans(2), 2.0);
  thinking.publish(plans(3), 3.0);
  EXPECT_FALSE(thinking.take(0.99).has_value());
  EXPECT_EQ(thinking.take(2.5).value().size(), 2U);  // the newest; what it replaced is gone
  EXPECT_FALSE(thinking.take(2.5).has_value());
  EXPECT_EQ(thinking.take(3.0).value().size(), 3U);
}

TEST(ChargedThinking, StartsNoRoundBeforeTheLastOneIsPaidFor) {
  const auto car = prepare::default_car();
  const auto harm = prepare::read_harm("data/harm.toml").value();
  ManualClock clock;
  ChargedThinking thinking(0.5, clock);
  arbitration::ThinkingPlane plane(
      {.forecast = {.car = &car, .harm = &harm}, .clock = &clock}, {},
      {.publish = [&](const reflex::PlanCache& cache,
                      double ready) { thinking.publish(cache, ready); },
       .event = [](const arbitration::Event&) {},
       .reasoning = [](std::int32_t, std::string_view) {}});
  world::Scene scene = wreck_ahead(car, 80.0);

  scene.time = 1.0;
  thinking.think(plane, scene, intent::beliefs_at_sight(intent::shipped_model(), scene));
  EXPECT_EQ(clock.now(), from_seconds(1.5));
  EXPECT_FALSE(thinking.take(1.49).has_value());
  scene.time = 1.3;
  thinking.think(plane, scene, intent::beliefs_at_sight(intent::shipped_model(), scene));
  EXPECT_EQ(clock.now(), from_seconds(1.5));  // still being charged
  EXPECT_TRUE(thinking.take(1.5).has_value());
  scene.time = 1.6;
  thinking.think(plane, scene, intent::beliefs_at_sight(intent::shipped_model(), scene));
  EXPECT_EQ(clock.now(), from_seconds(2.1));
}

}  // namespace
}  // namespace saca::runtime::charged_thinking_test
