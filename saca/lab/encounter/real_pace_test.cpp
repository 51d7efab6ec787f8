// The whole loop in real time, both planes on their threads: run under the thread sanitiser.

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "saca/lab/encounter/encounter.h"
#include "saca/lab/encounter/wreck_for_test.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/thinking/intent/shipped_model.h"
#include "saca/thinking/language_model/scripted_model.h"
#include "tests/support/meeting_clock.h"

namespace saca::encounter::real_pace_test {
namespace {

using manoeuvre::PolicyId;

/// Writes its reasoning for 0.2 s, then says AES-L.
language_model::ScriptedReply slowly() {
  language_model::ScriptedReply reply;
  for (int word = 1; word <= 4; ++word) {
    reply.lines.push_back({.after = from_seconds(0.05 * word), .text = "left "});
  }
  reply.lines.back().answer = language_model::Answer::Kind::ended;
  reply.lines.back().policy = PolicyId::aes_left;
  return reply;
}

class Story : public Listener {
 public:
  void on_event(const arbitration::Event& event) override { events_.push_back(event); }
  void on_reasoning(std::int32_t, std::string_view text) override { reasoning_ += text; }
  std::vector<arbitration::Event> events_;
  std::string reasoning_;
};

/// Does not come back from its first event before the clock says so.
class BlockedStory final : public Story {
 public:
  BlockedStory(const Clock& clock, double until) : clock_(clock), until_(until) {}
  void on_event(const arbitration::Event& event) override {
    while (clock_.now() < from_seconds(until_)) {
      std::this_thread::yield();
    }
    Story::on_event(event);
  }

 private:
  const Clock& clock_;
  double until_;  // [s]
};

Record played(const scenario::Scenario& scenario, Clock& clock, Story& story) {
  const auto car = prepare::default_car();
  const auto harm = prepare::read_harm("data/harm.toml").value();
  language_model::ScriptedModel model(slowly(), clock);
  return run({.scenario = &scenario,
              .car = &car,
              .harm = &harm,
              .intent = &intent::shipped_model(),
              .pace = runtime::Pace::real,
              .model = &model,
              .clock = &clock},
             story)
      .value();
}

/// Each event of the record is told, and each plane tells its own in order.
void expect_a_true_story(const Story& story, const Record& record) {
  EXPECT_EQ(story.events_.size(), record.events.size());
  for (const arbitration::Plane plane :
       {arbitration::Plane::world, arbitration::Plane::reflex, arbitration::Plane::thinking}) {
    double last = -1.0;
    for (const arbitration::Event& event : story.events_) {
      if (event.plane == plane) {
        EXPECT_GE(event.time, last) << event.text;
        last = event.time;
      }
    }
  }
}

// On a clock that the threads share, so that a busy machine changes nothing.
TEST(RealPace, TheModelsPlanIsReadyInTimeAndCarriedOut) {
  const scenario::Scenario scenario =
      wreck_on_wet_road(80.0, 7.0);  // contact after 3.8 s, T1 at 2.5 s
  MeetingClock clock(3);             // this thread, the thinking one and the forecaster's
  Story story;
  const Record record = played(scenario, clock, story);
  ASSERT_TRUE(record.decision.has_value());
  EXPECT_EQ(record.decision->source, reflex::Source::model)
      << arbitration::decision_text(*record.decision);
  EXPECT_EQ(record.decision->plan.policy, PolicyId::aes_left);
  EXPECT_EQ(record.result.harm, 0.0);
  EXPECT_EQ(record.deadline_misses, 0);
  EXPECT_EQ(story.reasoning_.substr(0, 5), "left ");
  expect_a_true_story(story, record);
}

// The car ahead is slow and then drives away: verdicts are made, and nothing is decided. 10 s later
// a wreck comes up: the record has the verdicts of that encounter, in which it was decided.
TEST(RealPace, TheRecordHasTheVerdictsOfItsOwnEncounterOnly) {
  scenario::Scenario scenario = wreck_on_wet_road(310.0, 18.0);
  scenario.actors.push_back(
      {.id = 2,
       .footprint = {.length = 4.5, .width = 1.8},
       .mass = 1'500.0,
       .motion = scenario::Script{.start = {.s = 40.0},
                                  .speed = 12.0,
                                  .behaviour = scenario::Behaviour::accelerate,
                                  .acceleration = 3.0,
                                  .from = 0.5,
                                  .until_speed = 30.0}});
  MeetingClock clock(3);
  Story story;
  const Record record = played(scenario, clock, story);
  ASSERT_TRUE(record.decision.has_value());
  EXPECT_EQ(record.threat, "car1");
  EXPECT_LT(story.events_.front().time, 1.0) << "the first encounter";
  ASSERT_FALSE(record.verdicts.verdicts().empty());
  EXPECT_GT(record.verdicts.verdicts().front().received, record.decision->time - 5.0);
}

// From the first event on, which is T2, to half a second after the trigger, nobody hears anything.
// Were it waited for, the world's time would stand still, and so would this test.
TEST(RealPace, AListenerThatBlocksIsNotWaitedFor) {
  const scenario::Scenario scenario = wreck_on_wet_road(80.0, 7.0);
  MeetingClock clock(3);  // this thread, the thinking one and the forecaster's
  Story attentive;
  const Record usual = played(scenario, clock, attentive);
  MeetingClock anew(3);
  BlockedStory blocked(anew, usual.decision.value().time + 0.5);
  const Record record = played(scenario, anew, blocked);
  EXPECT_EQ(record.decision->time, usual.decision->time);
  EXPECT_EQ(record.decision->plan, usual.decision->plan);
  EXPECT_EQ(record.result.harm, 0.0);
  EXPECT_EQ(record.events.size(), usual.events.size());
  expect_a_true_story(blocked, record);
  EXPECT_EQ(blocked.reasoning_, attentive.reasoning_);
}

// On the machine's clock: what the planes share is theirs alone, which the thread sanitiser sees.
// How far thinking gets in time is the machine's affair; that there is a decision is not.
TEST(RealPace, BothPlanesRunOnTheMachinesTime) {
  const scenario::Scenario scenario = wreck_on_wet_road(45.0, 1.5);  // T1 at 0.7 s
  SteadyClock clock;
  Story story;
  const Clock::Time start = clock.now();
  const Record record = played(scenario, clock, story);
  EXPECT_TRUE(record.decision.has_value());
  EXPECT_GE(to_seconds(clock.now() - start),
            record.frames.back().scene.time);  // not faster than real
  expect_a_true_story(story, record);
}

}  // namespace
}  // namespace saca::encounter::real_pace_test
