#include "saca/loop/thinking_thread.h"

#include <gtest/gtest.h>

#include <atomic>

#include "saca/intent/shipped_model.h"
#include "saca/loop/wreck_for_test.h"
#include "saca/manoeuvre/default_car.h"
#include "saca/reason/scripted_model.h"
#include "tests/support/meeting_clock.h"

namespace saca::loop::thinking_thread_test {
namespace {

// Two threads meet in two slots. What the thread sanitiser looks at on the machine's clock is
// RealPace.
TEST(ThinkingThread, ThinksAboutTheNewestSceneAndEndsWhenAsked) {
  const auto car = manoeuvre::default_car();
  const auto harm = outcome::read_harm("data/harm.toml").value();
  MeetingClock clock(2);  // this thread and the thinking one
  LatestSlot<TimedScene> scenes;
  LatestSlot<decide::PlanCache> plans;
  std::atomic<int> num_events{0};
  decide::ThinkingPlane plane(
      {.forecast = {.car = &car, .harm = &harm}, .clock = &clock}, {},
      {.publish = [&](const decide::PlanCache& cache, double) { plans.publish(cache); },
       .event = [&](const decide::Event&) { ++num_events; },
       .reasoning = [](std::int32_t, std::string_view) {}});

  const world::Scene scene = wreck_ahead(car, 80.0);

  decide::PlanCache received;
  bool any = false;
  {
    const ThinkingThread thread(plane, scenes, clock);
    const Clock::Time give_up = clock.now() + std::chrono::seconds(30);
    while (!any && clock.now() < give_up) {
      scenes.publish(
          {scene, intent::beliefs_at_sight(intent::shipped_model(), scene), clock.now()});
      any = plans.take(received);
      clock.wait_until(clock.now() + std::chrono::milliseconds(1));
    }
  }
  EXPECT_TRUE(any);
  EXPECT_TRUE(received.empty());  // without memory and model there is no plan, but a hand-over
  EXPECT_GT(num_events, 0);
  EXPECT_EQ(plane.previews().size(), 1U);
}

// Without an answer the question would last until the trigger, some seconds.
TEST(ThinkingThread, DoesNotWaitForAModelWhenItEnds) {
  const auto car = manoeuvre::default_car();
  const auto harm = outcome::read_harm("data/harm.toml").value();
  MeetingClock clock(2);  // this thread and the thinking one
  LatestSlot<TimedScene> scenes;
  std::atomic<bool> asked{false};
  reason::ScriptedModel model(
      [&](const std::string&) {
        asked = true;
        return reason::ScriptedReply{};  // never a word
      },
      clock);
  decide::ThinkingPlane plane(
      {.forecast = {.car = &car, .harm = &harm}, .model = &model, .clock = &clock}, {},
      {.publish = [](const decide::PlanCache&, double) {},
       .event = [](const decide::Event&) {},
       .reasoning = [](std::int32_t, std::string_view) {}});
  ThinkingThread thread(plane, scenes, clock);
  const world::Scene scene = wreck_ahead(car, 80.0);
  scenes.publish({scene, intent::beliefs_at_sight(intent::shipped_model(), scene), clock.now()});
  const Clock::Time give_up = clock.now() + std::chrono::seconds(30);
  while (!asked && clock.now() < give_up) {
    clock.wait_until(clock.now() + std::chrono::milliseconds(1));
  }
  ASSERT_TRUE(asked);
  EXPECT_EQ(thread.finish(), "");
  EXPECT_LT(clock.now(), model.last_deadline());
  EXPECT_EQ(plane.deadline_misses(), 0);
}

}  // namespace
}  // namespace saca::loop::thinking_thread_test
