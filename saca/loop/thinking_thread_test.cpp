#include "saca/loop/thinking_thread.h"

#include <gtest/gtest.h>

#include <atomic>

#include "saca/manoeuvre/ego.h"
#include "saca/vehicle/parameters.h"

namespace saca::loop {
namespace {

// Two threads meet in two slots: run under the thread sanitiser.
TEST(ThinkingThread, ThinksAboutTheNewestSceneAndEndsWhenAsked) {
  const auto car = vehicle::read_vehicle("data/vehicles/compact_rwd_ev.toml").value();
  const auto harm = outcome::read_harm("data/harm.toml").value();
  SteadyClock clock;
  LatestSlot<TimedScene> scenes;
  LatestSlot<decide::PlanCache> plans;
  std::atomic<int> num_events{0};
  decide::ThinkingPlane plane(
      {.car = &car, .harm = &harm, .clock = &clock}, {},
      {.publish = [&](const decide::PlanCache& cache, double) { plans.publish(cache); },
       .event = [&](const decide::Event&) { ++num_events; },
       .reasoning = [](std::int32_t, std::string_view) {}});

  world::Scene scene;
  scene.ego.v_B = {20.0, 0.0};
  scene.ego_footprint = manoeuvre::footprint(car);
  scene.ego_mass = car.mass;
  world::Actor wreck{.id = 1, .footprint = {.length = 4.5, .width = 1.8}, .mass = 1'500.0};
  wreck.X_WA.p = {80.0, 0.0};
  scene.actors.push_back(wreck);

  decide::PlanCache received;
  bool any = false;
  {
    const ThinkingThread thread(plane, scenes, clock);
    const Clock::Time give_up = clock.now() + std::chrono::seconds(30);
    while (!any && clock.now() < give_up) {
      scenes.publish({scene, clock.now()});
      any = plans.take(received);
      clock.wait_until(clock.now() + std::chrono::milliseconds(1));
    }
  }
  EXPECT_TRUE(any);
  EXPECT_TRUE(received.empty());  // without memory and model there is no plan, but a hand-over
  EXPECT_GT(num_events, 0);
  EXPECT_EQ(plane.previews().size(), 1U);
}

}  // namespace
}  // namespace saca::loop
