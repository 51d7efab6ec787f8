#include "saca/runtime/event_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "tests/support/count_allocations.h"
#include "tests/support/scenes.h"

namespace saca::runtime::event_log_test {
namespace {

using arbitration::Event;
using arbitration::EventKind;
using arbitration::Plane;
using manoeuvre::PolicyId;
using testing::ElementsAre;
using testing::HasSubstr;

Event thought(double time) {
  return {time, Plane::thinking, EventKind::memory, "memory is empty"};
}

reflex::Decision braking(double time) {
  return {.plan = manoeuvre::full_braking, .source = reflex::Source::arbiter, .time = time};
}

std::vector<Event> all(EventLog& log) {
  std::vector<Event> events;
  while (auto event = log.next()) {
    events.push_back(*std::move(event));
  }
  return events;
}

std::vector<EventKind> kinds(const std::vector<Event>& events) {
  std::vector<EventKind> found;
  for (const Event& event : events) {
    found.push_back(event.kind);
  }
  return found;
}

TEST(EventLog, IsEmptyAtFirst) {
  EventLog log(4);
  EXPECT_FALSE(log.next().has_value());
}

TEST(EventLog, SaysInWordsWhatWasDecided) {
  EventLog log(4);
  log.triggered(braking(2.5), test::car(3, {30.0, 0.0}), 1.29);
  const std::vector<Event> events = all(log);
  ASSERT_THAT(kinds(events), ElementsAre(EventKind::trigger, EventKind::match, EventKind::execute));
  EXPECT_EQ(events[0].text, "T1: 1.29 s to the conflict with car3");
  EXPECT_EQ(events[2].text, "policy 0 AEB (arbiter)");
  for (const Event& event : events) {
    EXPECT_EQ(event.time, 2.5);
    EXPECT_EQ(event.plane, Plane::reflex);
  }
}

TEST(EventLog, SaysWhatCannotBeDriven) {
  EventLog log(4);
  reflex::Decision drift = braking(2.5);
  drift.source = reflex::Source::fallback;
  drift.refused = {{PolicyId::t_drift_left, std::nullopt}, manoeuvre::Refusal::slippery};
  log.triggered(drift, test::car(3, {30.0, 0.0}), 1.29);
  const std::vector<Event> events = all(log);
  ASSERT_THAT(kinds(events), ElementsAre(EventKind::trigger, EventKind::fault, EventKind::execute));
  EXPECT_THAT(events[1].text, HasSubstr("T-D-L cannot be driven from here (grip)"));
  EXPECT_EQ(events[2].text, "policy 0 AEB (fallback)");
}

TEST(EventLog, SaysWhatCameAfterIt) {
  EventLog log(4);
  log.switched(3.0, {.plan = {PolicyId::aes_left, std::nullopt},
                     .reason = reflex::SwitchReason::better_by_far,
                     .harm = 0.0,
                     .harm_before = 0.2});
  log.remark(4.0, Remark::degraded);
  log.remark(9.0, Remark::encounter_over);
  const std::vector<Event> events = all(log);
  ASSERT_THAT(kinds(events), ElementsAre(EventKind::switched, EventKind::fault, EventKind::rest));
  EXPECT_THAT(events[0].text, HasSubstr("better by far"));
  EXPECT_THAT(events[1].text, HasSubstr("carried on"));
}

// Of seven that wait for a reader, five fit.
TEST(EventLog, TellsOnceHowManyDidNotFit) {
  EventLog log(5);
  for (int i = 0; i < 7; ++i) {
    log.thought(thought(i));
    log.remark(i, Remark::degraded);
  }
  const std::vector<Event> events = all(log);
  ASSERT_EQ(events.size(), 12U);
  EXPECT_THAT(events[10].text, HasSubstr("2 events"));
  EXPECT_EQ(events[10].plane, Plane::reflex);
  EXPECT_THAT(events[11].text, HasSubstr("2 events"));
  EXPECT_EQ(events[11].plane, Plane::thinking);
  EXPECT_FALSE(log.next().has_value());
  log.thought(thought(8.0));
  EXPECT_EQ(all(log).size(), 1U);
}

TEST(EventLog, TheDrivingThreadAllocatesNothing) {
  EventLog log(2);
  const reflex::Decision decision = braking(2.5);
  const world::Actor actor = test::car(3, {30.0, 0.0});
  const std::size_t before = num_allocations;
  for (int i = 0; i < 3; ++i) {
    log.triggered(decision, actor, 1.29);
    log.switched(3.0, {});
    log.remark(4.0, Remark::degraded);
  }
  EXPECT_EQ(num_allocations, before);
}

// Three threads: every event is read, in the order of its thread, or is counted.
TEST(EventLog, JoinsThreadsThatDoNotWait) {
  constexpr int num_events = 2'000;
  EventLog log(8);
  std::atomic<int> num_at_work = 2;
  std::vector<Event> events;
  {
    const std::jthread driving([&] {
      for (int i = 1; i <= num_events; ++i) {
        log.remark(i, Remark::degraded);
      }
      --num_at_work;
    });
    const std::jthread thinking([&] {
      for (int i = 1; i <= num_events; ++i) {
        log.thought(thought(i));
      }
      --num_at_work;
    });
    while (num_at_work > 0) {
      for (Event& event : all(log)) {
        events.push_back(std::move(event));
      }
    }
  }
  for (Event& event : all(log)) {
    events.push_back(std::move(event));
  }
  int num_told = 0;
  int num_not_told = 0;
  double last_driven = 0.0;
  double last_thought = 0.0;
  for (const Event& event : events) {
    if (event.text.find("not told") != std::string::npos) {
      num_not_told += std::stoi(event.text);
      continue;
    }
    double& last = event.plane == Plane::thinking ? last_thought : last_driven;
    EXPECT_GT(event.time, last);
    last = event.time;
    ++num_told;
  }
  EXPECT_EQ(num_told + num_not_told, 2 * num_events);
  EXPECT_GT(num_told, 0);
}

}  // namespace
}  // namespace saca::runtime::event_log_test
