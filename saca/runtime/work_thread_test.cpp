#include "saca/runtime/work_thread.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

#include "saca/base/core/processor_time.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/runtime/wreck_for_test.h"
#include "saca/thinking/arbitration/thinking_plane.h"
#include "saca/thinking/intent/shipped_model.h"
#include "saca/thinking/language_model/scripted_model.h"
#include "tests/support/meeting_clock.h"

namespace saca::runtime::work_thread_test {
namespace {

constexpr Clock::Time breath = std::chrono::milliseconds(200);

WorkThread::Work thinking(arbitration::ThinkingPlane& plane) {
  return [&plane](const TimedScene& newest, const std::stop_token& stop) {
    plane.think(newest.scene, newest.beliefs, newest.at, stop);
  };
}

// Two threads meet in two slots. What the thread sanitiser looks at on the machine's clock is
// RealPace.
TEST(WorkThread, ThinksAboutTheNewestSceneAndEndsWhenAsked) {
  const auto car = prepare::default_car();
  const auto harm = prepare::read_harm("data/harm.toml").value();
  MeetingClock clock(2);  // this thread and the thinking one
  LatestSlot<TimedScene> scenes;
  LatestSlot<reflex::PlanCache> plans;
  std::atomic<int> num_events{0};
  arbitration::ThinkingPlane plane(
      {.forecast = {.car = &car, .harm = &harm}, .clock = &clock}, {},
      {.publish = [&](const reflex::PlanCache& cache, double) { plans.publish(cache); },
       .event = [&](const arbitration::Event&) { ++num_events; },
       .reasoning = [](std::int32_t, std::string_view) {}});

  const world::Scene scene = wreck_ahead(car, 80.0);

  reflex::PlanCache received;
  bool any = false;
  {
    const WorkThread thread(scenes, clock, breath, thinking(plane));
    const Clock::Time give_up = clock.now() + std::chrono::seconds(30);
    while (!any && clock.now() < give_up) {
      scenes.publish(
          {scene, intent::beliefs_at_sight(intent::shipped_model(), scene), clock.now(), {}});
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
TEST(WorkThread, DoesNotWaitForAModelWhenItEnds) {
  const auto car = prepare::default_car();
  const auto harm = prepare::read_harm("data/harm.toml").value();
  MeetingClock clock(2);  // this thread and the thinking one
  LatestSlot<TimedScene> scenes;
  std::atomic<bool> asked{false};
  language_model::ScriptedModel model(
      [&](const std::string&) {
        asked = true;
        return language_model::ScriptedReply{};  // never a word
      },
      clock);
  arbitration::ThinkingPlane plane(
      {.forecast = {.car = &car, .harm = &harm}, .model = &model, .clock = &clock}, {},
      {.publish = [](const reflex::PlanCache&, double) {},
       .event = [](const arbitration::Event&) {},
       .reasoning = [](std::int32_t, std::string_view) {}});
  WorkThread thread(scenes, clock, breath, thinking(plane));
  const world::Scene scene = wreck_ahead(car, 80.0);
  scenes.publish(
      {scene, intent::beliefs_at_sight(intent::shipped_model(), scene), clock.now(), {}});
  const Clock::Time give_up = clock.now() + std::chrono::seconds(30);
  while (!asked && clock.now() < give_up) {
    clock.wait_until(clock.now() + std::chrono::milliseconds(1));
  }
  ASSERT_TRUE(asked);
  EXPECT_EQ(thread.finish(), "");
  EXPECT_LT(clock.now(), model.last_deadline());
  EXPECT_EQ(plane.deadline_misses(), 0);
}

TEST(WorkThread, TellsItsProcessorTimeAndNotItsWaiting) {
  MeetingClock clock(2);  // this thread and the working one
  LatestSlot<TimedScene> scenes;
  constexpr double worked = 0.02;  // [s]
  std::atomic<bool> done{false};
  WorkThread thread(scenes, clock, breath, [&](const TimedScene&, const std::stop_token&) {
    const double begin = processor_seconds(CLOCK_THREAD_CPUTIME_ID);
    while (processor_seconds(CLOCK_THREAD_CPUTIME_ID) < begin + worked) {
    }
    done = true;
  });
  scenes.publish({});
  while (!done) {
    clock.wait_until(clock.now() + breath);
  }
  clock.wait_until(clock.now() + std::chrono::hours(1));
  EXPECT_EQ(thread.finish(), "");
  EXPECT_GE(thread.computed(), worked);
  EXPECT_LT(thread.computed(), 600.0);  // the hour was waited for
}

// Whatever is thrown in one round: it is told, and the next round is worked.
TEST(WorkThread, BeginsAnewAfterWhatIsNoException) {
  MeetingClock clock(2);  // this thread and the working one
  LatestSlot<TimedScene> scenes;
  std::atomic<int> num_rounds{0};
  WorkThread thread(scenes, clock, breath, [&](const TimedScene&, const std::stop_token&) {
    ++num_rounds;
    throw 7;  // NOLINT(hicpp-exception-baseclass): as others' code may
  });
  const Clock::Time give_up = clock.now() + std::chrono::seconds(30);
  while (num_rounds < 2 && clock.now() < give_up) {
    scenes.publish({});
    clock.wait_until(clock.now() + 2 * breath);
  }
  EXPECT_GE(num_rounds, 2);
  EXPECT_NE(thread.finish(), "");
}

TEST(WorkThread, BeginsAnewAfterAFault) {
  MeetingClock clock(2);  // this thread and the working one
  LatestSlot<TimedScene> scenes;
  std::atomic<int> num_rounds{0};
  WorkThread thread(scenes, clock, breath, [&](const TimedScene& newest, const std::stop_token&) {
    ++num_rounds;
    if (newest.scene.time < 1.0) {
      throw std::runtime_error("a number was missing");
    }
  });
  const Clock::Time give_up = clock.now() + std::chrono::seconds(30);
  for (double time = 0.5; num_rounds < 3 && clock.now() < give_up; time += 1.0) {
    TimedScene scene;
    scene.scene.time = time;
    scenes.publish(scene);
    clock.wait_until(clock.now() + 2 * breath);
  }
  EXPECT_GE(num_rounds, 3);
  EXPECT_EQ(thread.finish(), "a number was missing");
}

}  // namespace
}  // namespace saca::runtime::work_thread_test
