#include "saca/thinking/arbitration/thinking_plane.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/intent/shipped_model.h"
#include "saca/thinking/language_model/scripted_model.h"
#include "tests/support/scenes.h"

namespace saca::arbitration::thinking_plane_test {
namespace {

using language_model::Answer;
using manoeuvre::PolicyId;
using world::Scene;

/// About each scene one policy, first and at the end.
language_model::ScriptedReply says(PolicyId policy, const char* reasoning = "because.") {
  return {.lines = {{.answer = Answer::Kind::first, .policy = policy, .probability = 0.86},
                    {.text = reasoning,
                     .answer = Answer::Kind::ended,
                     .policy = policy,
                     .probability = 0.86}},
          .reply_tokens = 2};
}

class Thinking : public testing::Test {
 protected:
  /// A wreck that fills the ego's lane, 70 m ahead at 20 m/s; one lane to the left, one to the
  /// right.
  static Scene wreck_ahead() {
    Scene scene = test::ego_at(20.0, manoeuvre::footprint(car()));
    scene.ego_mass = car().mass;
    scene.road.left_edge = 5.25;
    scene.road.right_edge = -5.25;
    scene.grip = 0.5;  // braking alone does not stop in 26 m
    scene.actors.push_back(test::car(1, {70.0, 0.0}));
    return scene;
  }
  /// A car at 6 m/s 62 m ahead in the ego's lane, and a wreck in the next, 160 m ahead.
  static Scene slow_car_and_wreck() {
    Scene scene = wreck_ahead();
    scene.grip = test::ego_at(20.0).grip;
    scene.actors[0] = test::car(1, {62.0, 0.0}, {6.0, 0.0});
    scene.actors.push_back(test::car(2, {160.0, 3.5}));
    return scene;
  }
  /// Of those two: the car goes on or brakes, the wreck stays.
  static intent::Beliefs car_may_brake() {
    intent::Beliefs beliefs;
    beliefs.push_back({});
    beliefs.push_back({});
    beliefs[0].at.fill({0.6, 0.0, 0.0, 0.4});
    beliefs[1].at.fill({1.0, 0.0, 0.0, 0.0});
    return beliefs;
  }
  static const manoeuvre::Car& car() {
    static const manoeuvre::Car it = prepare::default_car();
    return it;
  }

  ThinkingPlane plane(language_model::LanguageModel* model, memory::Store* memory = nullptr,
                      Asking asking = {},
                      reflex::Guard guard = reflex::Guard::never_worse_than_braking) {
    return {
        {.forecast = {.car = &car(), .harm = &harm_},
         .memory = memory,
         .model = model,
         .clock = &clock_,
         .guard = guard,
         .asking = asking},
        {},
        {.publish = [this](const reflex::PlanCache& plans, double) { published_.push_back(plans); },
         .event = [this](const Event& event) { events_.push_back(event); },
         .reasoning = [this](std::int32_t, std::string_view text) { text_ += text; }}};
  }
  bool think(ThinkingPlane& plane, const Scene& scene) {
    const intent::Beliefs beliefs = world::broken_rule(scene)
                                        ? intent::Beliefs()
                                        : intent::beliefs_at_sight(intent::shipped_model(), scene);
    return plane.think(scene, beliefs, clock_.now());
  }
  [[nodiscard]] std::size_t count(EventKind kind) const {
    return static_cast<std::size_t>(std::count_if(
        events_.begin(), events_.end(), [&](const Event& event) { return event.kind == kind; }));
  }

  ManualClock clock_;
  collision::HarmModel harm_ = prepare::read_harm("data/harm.toml").value();
  std::vector<reflex::PlanCache> published_;
  std::vector<Event> events_;
  std::string text_;
};

TEST_F(Thinking, StaysSilentWhereNothingThreatens) {
  language_model::ScriptedModel model(says(PolicyId::aeb), clock_);
  ThinkingPlane thinking = plane(&model);
  Scene empty = wreck_ahead();
  empty.actors.clear();
  EXPECT_FALSE(think(thinking, empty));
  EXPECT_EQ(model.num_asked(), 0);
  EXPECT_TRUE(events_.empty());
}

TEST_F(Thinking, CachesWhatTheModelChoosesAndTheRolloutConfirms) {
  language_model::ScriptedModel model(says(PolicyId::aes_left), clock_);
  ThinkingPlane thinking = plane(&model);
  EXPECT_TRUE(think(thinking, wreck_ahead()));
  ASSERT_EQ(thinking.previews().size(), 1U);
  const Preview& preview = thinking.previews()[0];
  ASSERT_TRUE(preview.check->passed) << preview.check->text;
  EXPECT_EQ(preview.plan->policy, PolicyId::aes_left);
  EXPECT_EQ(preview.reply.answers.size(), 2U);
  ASSERT_EQ(published_.back().size(), 1U);
  EXPECT_EQ(published_.back()[0].plan.policy, PolicyId::aes_left);
  EXPECT_FALSE(published_.back()[0].worse_than_aeb);
  EXPECT_EQ(text_, "because.");
}

// From 10 m/s 13 m are more than full braking needs; who follows closely needs them. Algorithm 1 of
// the paper has one strength, in what it is told, too.
TEST_F(Thinking, BrakesByAStrengthButNotByThePapersRule) {
  Scene scene = test::ego_at(10.0, manoeuvre::footprint(car()));
  scene.ego_mass = car().mass;
  scene.actors.push_back(test::car(1, {35.0, 0.0}));
  scene.actors[0].kind = world::ActorKind::obstacle;
  scene.actors.push_back(test::car(2, {-8.5, 0.0}, {10.0, 0.0}));
  ThinkingPlane guarded = plane(nullptr);
  ThinkingPlane published = plane(nullptr, nullptr, {}, reflex::Guard::none);
  ASSERT_TRUE(think(guarded, scene) && think(published, scene));
  ASSERT_FALSE(guarded.previews().empty());
  EXPECT_TRUE(guarded.previews()[0].situation.facts[0].plan.strength.has_value());
  for (const Preview& preview : published.previews()) {
    EXPECT_EQ(preview.situation.facts[0].plan, manoeuvre::full_braking);
  }
}

// An hour of following somebody closely: what has passed is forgotten, what is at hand is not, and
// a number never stands for two forecasts.
TEST_F(Thinking, ForgetsWhatHasLongPassed) {
  language_model::ScriptedModel model(says(PolicyId::aes_left), clock_);
  ThinkingPlane thinking = plane(&model);
  std::int32_t last = -1;
  for (int minute = 0; minute < 60; ++minute) {
    clock_.wait_until(from_seconds(60.0 * minute));
    Scene scene = wreck_ahead();
    scene.time = 60.0 * minute;
    ASSERT_TRUE(think(thinking, scene));
    ASSERT_EQ(thinking.previews().size(), 1U) << minute;
    EXPECT_GT(thinking.previews()[0].number, last);
    last = thinking.previews()[0].number;
    ASSERT_EQ(published_.back().size(), 1U) << minute;
    EXPECT_EQ(published_.back()[0].preview, last);
    EXPECT_EQ(find_preview(thinking.previews(), last), &thinking.previews()[0]);
    EXPECT_EQ(find_preview(thinking.previews(), last - 1), nullptr);
    // Half a minute later the same forecast is still known.
    scene.time += 0.5 * ThinkingPlane::remembered;
    ASSERT_TRUE(think(thinking, scene));
    EXPECT_EQ(thinking.previews().back().number, last);
  }
}

// A minute after its trigger nobody is ahead any more: the plan for it is not kept for whoever
// comes.
TEST_F(Thinking, WithdrawsPlansForWhatHasLongPassed) {
  language_model::ScriptedModel model(says(PolicyId::aes_left), clock_);
  ThinkingPlane thinking = plane(&model);
  think(thinking, wreck_ahead());
  ASSERT_EQ(published_.back().size(), 1U);
  Scene empty = wreck_ahead();
  empty.actors.clear();
  empty.time = 60.0;
  EXPECT_FALSE(think(thinking, empty));
  EXPECT_TRUE(published_.back().empty());
  EXPECT_TRUE(thinking.previews().empty());
}

// With its reasons it would be withdrawn (below); there are none.
TEST_F(Thinking, WithoutReasoningTheFirstAnswerStands) {
  const language_model::ScriptedReply reply{
      .lines = {{.answer = Answer::Kind::first, .policy = PolicyId::aes_left},
                {.text = "1. AES-R is clear by 17.5 m.",
                 .answer = Answer::Kind::ended,
                 .policy = PolicyId::aes_right}},
      .reply_tokens = 9};
  language_model::ScriptedModel model(reply, clock_);
  ThinkingPlane thinking = plane(&model, nullptr, {.reasoning = false});
  think(thinking, wreck_ahead());
  const Preview& preview = thinking.previews()[0];
  EXPECT_EQ(preview.plan->policy, PolicyId::aes_left);
  EXPECT_EQ(preview.reply.answers.size(), 1U);
  EXPECT_EQ(preview.reply.reasoning, "");
  EXPECT_EQ(preview.truth, std::nullopt);
  EXPECT_FALSE(preview.unheard);
}

TEST_F(Thinking, WithoutFactsTheManoeuvresAreNotInThePrompt) {
  for (const bool facts : {true, false}) {
    language_model::ScriptedModel model(says(PolicyId::aes_left), clock_);
    ThinkingPlane thinking = plane(&model, nullptr, {.facts = facts});
    think(thinking, wreck_ahead());
    EXPECT_EQ(thinking.previews()[0].prompt.find("Least harm:") != std::string::npos, facts);
    EXPECT_EQ(model.last_scenes(), std::vector{thinking.previews()[0].prompt});
  }
}

// To the right nobody is either: the best forecast is one of the two, and it is the left one that
// ties go to.
TEST_F(Thinking, WithdrawsWhatRestsOnAFalseReasonAndIsNotTheBest) {
  language_model::ScriptedModel model(says(PolicyId::aes_right, "1. AES-R is clear by 17.5 m."),
                                      clock_);
  ThinkingPlane thinking = plane(&model);
  think(thinking, wreck_ahead());
  const Preview& preview = thinking.previews()[0];
  ASSERT_TRUE(preview.truth.has_value());
  EXPECT_TRUE(preview.truth->is_choice_unfounded());
  EXPECT_FALSE(preview.plan.has_value());
  EXPECT_FALSE(preview.check->passed);
  EXPECT_NE(preview.check->text.find("the reasons are false"), std::string::npos);
  ASSERT_GE(published_.size(), 2U);
  EXPECT_EQ(published_[published_.size() - 2].size(), 1U);  // the first answer held until then
  EXPECT_TRUE(published_.back().empty());
}

TEST_F(Thinking, KeepsWhatRestsOnAFalseReasonAndIsTheBest) {
  const PolicyId best = [&] {
    ThinkingPlane without_model = plane(nullptr);
    think(without_model, wreck_ahead());
    return preview::best_by_forecast(without_model.previews()[0].situation.facts);
  }();
  const std::string reasoning = "Policy " + std::to_string(manoeuvre::index(best)) + " is blocked.";
  language_model::ScriptedModel model(says(best, reasoning.c_str()), clock_);
  ThinkingPlane thinking = plane(&model);
  think(thinking, wreck_ahead());
  EXPECT_TRUE(thinking.previews()[0].truth->is_choice_unfounded());
  EXPECT_EQ(thinking.previews()[0].plan->policy, best);
}

TEST_F(Thinking, KeepsWhatIsReasonedTruly) {
  language_model::ScriptedModel model(says(PolicyId::aes_right, "1. AES-R is clear."), clock_);
  ThinkingPlane thinking = plane(&model);
  think(thinking, wreck_ahead());
  EXPECT_EQ(thinking.previews()[0].truth->score(), 1.0);
  EXPECT_EQ(thinking.previews()[0].plan->policy, PolicyId::aes_right);
}

TEST_F(Thinking, NeverCachesWhatFailsTheCheck) {
  language_model::ScriptedModel model(says(PolicyId::no_intervention),
                                      clock_);  // drives into the wreck at 20 m/s
  ThinkingPlane thinking = plane(&model);
  think(thinking, wreck_ahead());
  EXPECT_FALSE(thinking.previews()[0].check->passed);
  EXPECT_FALSE(thinking.previews()[0].plan.has_value());
  EXPECT_TRUE(published_.back().empty());
}

TEST_F(Thinking, NeverCachesWhatCannotBeDriven) {
  language_model::ScriptedModel model(says(PolicyId::t_drift_right), clock_);
  ThinkingPlane thinking = plane(&model);
  world::Scene scene = wreck_ahead();
  scene.grip = 0.15;
  think(thinking, scene);
  EXPECT_FALSE(thinking.previews()[0].situation.facts[6].drivable());
  EXPECT_FALSE(thinking.previews()[0].plan.has_value());
}

TEST_F(Thinking, ASilentModelLeavesNothingBehindButARecord) {
  language_model::ScriptedModel model(language_model::ScriptedReply{}, clock_);
  ThinkingPlane thinking = plane(&model);
  EXPECT_TRUE(think(thinking, wreck_ahead()));
  EXPECT_EQ(thinking.deadline_misses(), 1);
  EXPECT_EQ(count(EventKind::fault), 1U);
  EXPECT_TRUE(published_.back().empty());
}

TEST_F(Thinking, AsksAgainAfterTheModelFailed) {
  language_model::ScriptedModel model(
      language_model::ScriptedReply{.error = Error{Error::Code::unreadable, "it died"}}, clock_);
  ThinkingPlane thinking = plane(&model);
  think(thinking, wreck_ahead());
  think(thinking, wreck_ahead());
  EXPECT_EQ(model.num_asked(), 2);
  EXPECT_EQ(thinking.previews().size(), 1U);
}

// What was too short once is too short again; a trigger that has moved away leaves more.
TEST_F(Thinking, IsAskedAgainAfterADeadlineOnlyWhereThereIsMoreTime) {
  language_model::ScriptedModel model(language_model::ScriptedReply{}, clock_);
  ThinkingPlane thinking = plane(&model);
  think(thinking, wreck_ahead());
  think(thinking, wreck_ahead());  // as long before the trigger as the first
  EXPECT_EQ(model.num_asked(), 1);
  Scene farther = wreck_ahead();
  farther.actors[0].X_WA.p.x += 10.0;  // half a second more
  think(thinking, farther);
  EXPECT_EQ(model.num_asked(), 2);
}

// Two forecasts, the car ahead goes on or it brakes, are asked about in the time to the trigger of
// the latter, which comes sooner. The former has no answer then, and more time left than that.
TEST_F(Thinking, AsksAgainAboutAForecastThatHasNoAnswerAmongOthersThatHave) {
  language_model::ScriptedModel model(
      [](const std::string& prompt) {
        return prompt.find(", brake 0.") != std::string::npos ? says(PolicyId::aes_left)
                                                              : language_model::ScriptedReply{};
      },
      clock_);
  ThinkingPlane thinking = plane(&model);
  Scene scene = slow_car_and_wreck();
  const intent::Beliefs beliefs = car_may_brake();
  const auto asks_about = [&] {
    const int before = model.num_asked();
    thinking.think(scene, beliefs, clock_.now());
    return model.num_asked() == before ? 0 : model.last_scenes().size();
  };
  ASSERT_EQ(asks_about(), 2U);
  EXPECT_EQ(thinking.deadline_misses(), 0);
  ASSERT_EQ(asks_about(), 1U);
  EXPECT_EQ(model.last_scenes()[0].find(", brake 0."), std::string::npos);
  EXPECT_EQ(asks_about(), 0U) << "as long before its trigger as the last time";
}

// Forecasts of one round that are alike are one, and the likeliest stands for both.
TEST_F(Thinking, OfLikeForecastsTheLikeliestCounts) {
  Scene scene = wreck_ahead();
  scene.actors[0].v_W = {0.5, 0.0};  // whether it brakes hardly makes a difference
  intent::Beliefs beliefs;
  beliefs.push_back({});
  beliefs[0].at.fill({0.6, 0.0, 0.0, 0.4});
  const preview::ForecastTools tools{.car = &car(), .harm = &harm_};
  const auto found = preview::situations(scene, beliefs, {}, tools);
  ASSERT_EQ(found.size(), 2U);
  const double alike = match::similarity(found[0].scene_at_trigger, found[1].scene_at_trigger);
  ThinkingPlane thinking = plane(nullptr);
  ASSERT_TRUE(thinking.think(scene, beliefs, clock_.now()));
  ASSERT_EQ(thinking.previews().size(), 1U) << alike;
  EXPECT_EQ(thinking.previews()[0].newest_scene.time, found[0].scene_at_trigger.time);
}

// A forecast that nobody answered has had its trigger: the next one is asked about all the same.
TEST_F(Thinking, WhatHasPassedDoesNotKeepOthersFromBeingAskedAbout) {
  language_model::ScriptedModel model(
      language_model::ScriptedReply{.error = Error{Error::Code::unreadable, "it died"}}, clock_);
  ThinkingPlane thinking = plane(&model);
  Scene scene = wreck_ahead();
  think(thinking, scene);
  ASSERT_EQ(model.num_asked(), 1);
  // The same 10 s later, and somebody else's trigger comes sooner: both are asked about.
  clock_.wait_until(std::chrono::seconds(10));
  scene.time = 10.0;
  think(thinking, scene);
  EXPECT_EQ(model.num_asked(), 2);
  EXPECT_NEAR(std::chrono::duration<double>(model.last_deadline()).count(),
              10.0 + (70.0 - 4.5) / 20.0 - 1.3 - 0.05, 0.011);
}

// A second wreck stands in the lane to the left, so far ahead that the swerve is over before; then
// nearer: the swerve that was chosen is withdrawn, and the model is asked with the facts as they
// are.
TEST_F(Thinking, AsksAnewAndWithdrawsThePlanWhereTheFactsHaveChanged) {
  language_model::ScriptedModel model(says(PolicyId::aes_left), clock_);
  ThinkingPlane thinking = plane(&model);
  Scene free = wreck_ahead();
  free.actors.push_back(test::car(2, {130.0, 3.5}));
  think(thinking, free);
  ASSERT_EQ(thinking.previews()[0].plan->policy, PolicyId::aes_left);
  const std::string first = model.last_scenes()[0];
  Scene blocked = wreck_ahead();
  blocked.actors.push_back(test::car(2, {110.0, 3.5}));
  think(thinking, blocked);
  ASSERT_EQ(thinking.previews().size(), 1U);
  EXPECT_EQ(model.num_asked(), 2);
  EXPECT_NE(model.last_scenes()[0], first);
  EXPECT_EQ(thinking.previews()[0].plan, std::nullopt);  // it says the same again: it fails
  EXPECT_TRUE(published_.back().empty());
}

/// Nothing for a second, then the same as `says`.
language_model::ScriptedReply writes_for_a_second(PolicyId policy) {
  language_model::ScriptedReply reply = says(policy);
  for (int k = 1; k <= 10; ++k) {
    reply.lines.insert(reply.lines.begin() + k - 1,
                       {.after = std::chrono::milliseconds(100 * k), .text = "so "});
  }
  reply.lines[10].after = reply.lines[11].after = std::chrono::seconds(1);
  return reply;
}

// As above, but the second wreck turns out to be nearer while the model writes: what it writes is
// about facts that hold no more. It is asked anew in the next round.
TEST_F(Thinking, WithdrawsAQuestionWhoseFactsHaveChanged) {
  language_model::ScriptedModel model(writes_for_a_second(PolicyId::aes_left), clock_);
  ThinkingPlane thinking = plane(&model);
  Scene free = wreck_ahead();
  free.actors.push_back(test::car(2, {130.0, 3.5}));
  Scene blocked = wreck_ahead();
  blocked.actors.push_back(test::car(2, {110.0, 3.5}));
  const auto beliefs = intent::beliefs_at_sight(intent::shipped_model(), free);
  const auto asked = [&](const Scene& newest) {
    int looks = 0;
    thinking.think(free, beliefs, clock_.now(), {}, [&]() -> std::optional<NewerScene> {
      ++looks;
      return NewerScene{newest, beliefs};
    });
    return looks;
  };
  EXPECT_EQ(asked(blocked), 1);
  EXPECT_EQ(to_seconds(clock_.now()), ThinkingPlane::looked_again);
  EXPECT_EQ(model.num_asked(), 1);
  EXPECT_EQ(thinking.previews()[0].plan, std::nullopt);
  EXPECT_EQ(thinking.deadline_misses(), 0);
  // The same facts as when it was asked: it comes to its end.
  EXPECT_EQ(asked(free), 2);
  EXPECT_EQ(model.num_asked(), 2);
  ASSERT_TRUE(thinking.previews()[0].plan.has_value());
  EXPECT_EQ(thinking.previews()[0].plan->policy, PolicyId::aes_left);
}

// An answer is there before the question is withdrawn, and it rests on what is not so: the swerve
// is not the best any more, and there is no such wreck as it names.
TEST_F(Thinking, WhatWasSaidBeforeAQuestionIsWithdrawnIsJudgedToo) {
  for (const bool lies : {false, true}) {
    SCOPED_TRACE(lies);
    events_.clear();
    language_model::ScriptedReply reply = writes_for_a_second(PolicyId::aes_left);
    reply.lines.insert(
        reply.lines.begin(),
        {.text = lies ? "Evading to the left hits car2 with harm 0.9, so I choose it. " : "",
         .answer = Answer::Kind::first,
         .policy = PolicyId::aes_left});
    language_model::ScriptedModel model(reply, clock_);
    ThinkingPlane thinking = plane(&model);
    Scene free = wreck_ahead();
    free.time = to_seconds(clock_.now());
    free.actors.push_back(test::car(2, {130.0, 3.5}));
    Scene blocked = free;
    blocked.actors[1].X_WA.p.x = 110.0;
    const auto beliefs = intent::beliefs_at_sight(intent::shipped_model(), free);
    thinking.think(free, beliefs, clock_.now(), {}, [&] {
      return std::optional(NewerScene{blocked, beliefs});
    });
    EXPECT_EQ(count(EventKind::ask), 2U) << "asked and withdrawn";
    EXPECT_EQ(count(EventKind::first_answer), 1U);
    const Preview& preview = thinking.previews()[0];
    ASSERT_TRUE(preview.truth.has_value());
    EXPECT_EQ(preview.truth->is_choice_unfounded(), lies);
  }
}

TEST_F(Thinking, WithdrawsAQuestionOfAnEncounterThatIsOver) {
  language_model::ScriptedModel model(writes_for_a_second(PolicyId::aes_left), clock_);
  ThinkingPlane thinking = plane(&model);
  const Scene scene = wreck_ahead();
  const auto beliefs = intent::beliefs_at_sight(intent::shipped_model(), scene);
  thinking.think(scene, beliefs, clock_.now(), {}, [&] {
    return std::optional(NewerScene{scene, beliefs, /*encounter_is_over=*/true});
  });
  EXPECT_EQ(to_seconds(clock_.now()), ThinkingPlane::looked_again);
  EXPECT_EQ(count(EventKind::answer), 0U);
  EXPECT_EQ(thinking.deadline_misses(), 0);
}

// Two forecasts are asked about: the car goes on, or it brakes. What stands to the left turns out
// to be nearer. With the car 36 m nearer, too, an answer in the time that is left to one of them
// could come, to both it could not: what is being said counts.
TEST_F(Thinking, WithdrawsNoQuestionWhoseOtherForecastsCannotBeAskedAnew) {
  const auto num_withdrawn = [&](double earlier) {
    events_.clear();
    language_model::ScriptedReply reply = writes_for_a_second(PolicyId::aes_left);
    reply.lines.insert(reply.lines.begin() + 4, {.after = std::chrono::milliseconds(450),
                                                 .answer = Answer::Kind::first,
                                                 .policy = PolicyId::aes_left});
    language_model::ScriptedModel model(reply, clock_);
    ThinkingPlane thinking = plane(&model);
    Scene scene = slow_car_and_wreck();
    const intent::Beliefs beliefs = car_may_brake();
    scene.time = to_seconds(clock_.now());
    thinking.think(scene, beliefs, clock_.now(), {}, [&] {
      Scene now = scene;
      now.time = to_seconds(clock_.now());
      now.actors[0].X_WA.p.x -= earlier;
      now.actors[1].X_WA.p.x = 125.0 - 20.0 * earlier / 14.0;  // where it was by then
      return std::optional(NewerScene{now, beliefs});
    });
    EXPECT_EQ(model.last_scenes().size(), 2U);
    return std::count_if(events_.begin(), events_.end(), [](const Event& event) {
      return event.text.find("withdrawn") != std::string::npos;
    });
  };
  EXPECT_EQ(num_withdrawn(0.0), 1);
  EXPECT_EQ(num_withdrawn(36.0), 0);
}

// The trigger comes sooner than forecast, 0.1 s after the newest scene: there is no time to ask
// anew, and what is under way goes on.
TEST_F(Thinking, WithdrawsNoQuestionThatCannotBeAskedAnew) {
  language_model::ScriptedModel model(writes_for_a_second(PolicyId::aes_left), clock_);
  ThinkingPlane thinking = plane(&model);
  Scene free = wreck_ahead();
  free.actors.push_back(test::car(2, {130.0, 3.5}));
  const auto beliefs = intent::beliefs_at_sight(intent::shipped_model(), free);
  int looks = 0;
  thinking.think(free, beliefs, clock_.now(), {}, [&]() -> std::optional<NewerScene> {
    ++looks;
    Scene blocked = free;
    blocked.time = to_seconds(clock_.now());
    blocked.actors[0].X_WA.p.x = 4.5 + 20.0 * (1.3 + 0.1);
    blocked.actors[1].X_WA.p.x = blocked.actors[0].X_WA.p.x + 40.0;
    return NewerScene{blocked, beliefs};
  });
  EXPECT_EQ(looks, 2);
  EXPECT_EQ(count(EventKind::first_answer), 1U);
  EXPECT_EQ(count(EventKind::answer), 1U);
}

// An answer to one forecast takes a second: with 0.4 s left none is asked for.
TEST_F(Thinking, IsNotAskedWhereNoAnswerHasEverComeSoSoon) {
  language_model::ScriptedReply slow = says(PolicyId::aes_left);
  slow.lines[0].after = slow.lines[1].after = std::chrono::seconds(1);
  language_model::ScriptedModel model(slow, clock_);
  ThinkingPlane thinking = plane(&model);
  think(thinking, wreck_ahead());
  ASSERT_EQ(model.num_asked(), 1);
  Scene other = wreck_ahead();  // of another kind, so that it is another forecast
  other.time = to_seconds(clock_.now());
  other.actors[0].kind = world::ActorKind::motorcycle;
  other.actors[0].X_WA.p.x = 38.5;  // 34 m: 0.4 s before the trigger
  think(thinking, other);
  ASSERT_EQ(thinking.previews().size(), 2U);
  EXPECT_EQ(model.num_asked(), 1);
  other.actors[0].X_WA.p.x = 70.0;
  think(thinking, other);
  EXPECT_EQ(model.num_asked(), 2);
}

TEST_F(Thinking, TheDeadlineIsTheTrigger) {
  language_model::ScriptedModel model(says(PolicyId::aeb), clock_);
  ThinkingPlane thinking = plane(&model);
  think(thinking, wreck_ahead());
  const double deadline = std::chrono::duration<double>(model.last_deadline()).count();
  // 70 m less half a wreck and the ego's front, at 20 m/s, less T1 and the margin of 50 ms.
  EXPECT_NEAR(deadline, (70.0 - 4.5) / 20.0 - 1.3 - 0.05, 0.011);
}

TEST_F(Thinking, DoesNotAskTwiceAboutTheSameSituation) {
  language_model::ScriptedModel model(says(PolicyId::aes_left), clock_);
  ThinkingPlane thinking = plane(&model);
  Scene scene = wreck_ahead();
  for (int k = 0; k < 5; ++k) {
    think(thinking, scene);
    scene.time += 0.1;
    scene.ego.X_WB.p.x += 2.0;
    clock_.advance(std::chrono::milliseconds(100));
  }
  EXPECT_EQ(model.num_asked(), 1);
  EXPECT_EQ(thinking.previews().size(), 1U);
  EXPECT_EQ(published_.back().size(), 1U);
}

TEST_F(Thinking, IsNotAskedWhenItWouldBeTooLate) {
  language_model::ScriptedModel model(says(PolicyId::aes_left), clock_);
  ThinkingPlane thinking = plane(&model);
  Scene scene = wreck_ahead();
  scene.actors[0].X_WA.p.x = 31.0;  // 26.5 m, 1.33 s
  think(thinking, scene);
  EXPECT_EQ(model.num_asked(), 0);
}

TEST_F(Thinking, UsesAKnownCaseWithoutAsking) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / "saca_thinking.sqlite";
  std::filesystem::remove(file);
  auto opened = memory::Store::open(file);
  ASSERT_TRUE(opened.has_value());
  memory::Store store = std::move(opened).value();
  language_model::ScriptedModel model(says(PolicyId::aeb), clock_);
  {
    ThinkingPlane before = plane(&model, &store);  // to learn what the trigger looks like
    think(before, wreck_ahead());
    ASSERT_EQ(model.num_asked(), 1);
    ASSERT_TRUE(store
                    .add({.scene = before.previews()[0].situation.scene_at_trigger,
                          .plan = {PolicyId::aeb, std::nullopt},
                          .best = PolicyId::aes_left,
                          .review = "",
                          .source = "test"})
                    .has_value());
  }
  ThinkingPlane thinking = plane(&model, &store);
  think(thinking, wreck_ahead());
  EXPECT_EQ(model.num_asked(), 1);
  EXPECT_EQ(thinking.previews()[0].gate, memory::Gate::cache);
  EXPECT_EQ(thinking.previews()[0].source, reflex::Source::memory);
  EXPECT_EQ(published_.back()[0].plan.policy, PolicyId::aes_left);
  std::filesystem::remove(file);
}

TEST_F(Thinking, RefusesABrokenScene) {
  ThinkingPlane thinking = plane(nullptr);
  Scene broken = wreck_ahead();
  broken.grip = std::nan("");
  EXPECT_FALSE(think(thinking, broken));
}

}  // namespace
}  // namespace saca::arbitration::thinking_plane_test
