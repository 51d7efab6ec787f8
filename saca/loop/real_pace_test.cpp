// The whole loop in real time, both planes on their threads: run under the thread sanitiser.

#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>

#include "saca/intent/shipped_model.h"
#include "saca/loop/encounter.h"
#include "saca/manoeuvre/default_car.h"
#include "saca/reason/scripted_model.h"

namespace saca::loop {
namespace {

using manoeuvre::PolicyId;

/// Writes its reasoning for 0.2 s, then says AES-L.
reason::ScriptedReply slowly() {
  reason::ScriptedReply reply;
  for (int word = 1; word <= 4; ++word) {
    reply.lines.push_back({.after = from_seconds(0.05 * word), .text = "left "});
  }
  reply.lines.back().answer = reason::Answer::Kind::ended;
  reply.lines.back().policy = PolicyId::aes_left;
  return reply;
}

/// Called by both threads.
class Story final : public Listener {
 public:
  void on_event(const decide::Event& event) override {
    const std::lock_guard guard(lock_);
    events_.push_back(event);
  }
  void on_reasoning(std::int32_t, std::string_view text) override {
    const std::lock_guard guard(lock_);
    reasoning_ += text;
  }
  std::vector<decide::Event> events_;
  std::string reasoning_;

 private:
  std::mutex lock_;
};

TEST(RealPace, TheModelsPlanIsReadyInTimeAndCarriedOut) {
  const auto car = manoeuvre::default_car();
  const auto harm = outcome::read_harm("data/harm.toml").value();
  const intent::Model& intent = intent::shipped_model();
  // A wreck on a wet road, 80 m ahead of the ego's centre at 20 m/s: contact after 3.8 s, so T1 at
  // 2.5 s. Braking is not enough.
  sim::Scenario scenario{
      .name = "wreck", .title = "A wreck", .car = "", .grip = 0.5, .duration = 7.0};
  scenario.road.left_edge = 5.25;
  scenario.road.right_edge = -5.25;
  scenario.ego = sim::EgoStart{.pose = {}, .speed = 20.0};
  scenario.actors.push_back({.id = 1,
                             .footprint = {.length = 4.5, .width = 1.8},
                             .mass = 1'500.0,
                             .motion = sim::Script{.start = {.s = 80.0}}});
  SteadyClock clock;
  reason::ScriptedModel model(slowly(), clock);
  Story story;
  const Clock::Time start = clock.now();
  const auto played = run({.scenario = &scenario,
                           .car = &car,
                           .harm = &harm,
                           .intent = &intent,
                           .pace = Pace::real,
                           .model = &model,
                           .clock = &clock},
                          story);
  ASSERT_TRUE(played.has_value()) << played.error().message;
  const Record& record = played.value();
  ASSERT_TRUE(record.decision.has_value());
  EXPECT_EQ(record.decision->source, decide::Source::model) << decision_text(*record.decision);
  EXPECT_EQ(record.decision->plan.policy, PolicyId::aes_left);
  EXPECT_EQ(record.result.harm, 0.0);
  EXPECT_EQ(record.deadline_misses, 0);
  EXPECT_GE(to_seconds(clock.now() - start),
            record.frames.back().scene.time);  // not faster than real
  EXPECT_EQ(story.reasoning_.substr(0, 5), "left ");
  EXPECT_EQ(story.events_.size(), record.events.size());
  EXPECT_TRUE(std::is_sorted(
      record.events.begin(), record.events.end(),
      [](const decide::Event& a, const decide::Event& b) { return a.time < b.time; }));
}

}  // namespace
}  // namespace saca::loop
