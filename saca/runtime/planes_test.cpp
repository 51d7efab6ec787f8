#include "saca/runtime/planes.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/atlas/atlas_for_test.h"
#include "saca/thinking/intent/shipped_model.h"
#include "saca/thinking/language_model/scripted_model.h"
#include "tests/support/meeting_clock.h"
#include "tests/support/scenes.h"

namespace saca::runtime::planes_test {
namespace {

using manoeuvre::PolicyId;

/// 20 m/s on a wet road towards a wreck: braking at T1 is not enough, changing lanes is.
class PlanesTest : public testing::Test {
 protected:
  [[nodiscard]] static world::Scene at(double time) {
    world::Scene scene = test::ego_at(20.0);
    scene.time = time;
    scene.grip = 0.5;
    scene.ego.X_WB.p.x = 20.0 * time;
    scene.road.left_edge = 5.25;
    scene.road.right_edge = -5.25;
    scene.actors.push_back(test::car(1, {90.0, 0.0}));
    return scene;
  }
  [[nodiscard]] PlanesSetup setup(language_model::LanguageModel* model, reflex::Guard guard) {
    return {.forecast = {&car_, &harm_},
            .costs = {.preview = 0.05, .prompt_token = 0.001, .reply_token = 0.01},
            .model = model,
            .guard = guard,
            .clock = &clock_};
  }
  /// The decision at the trigger.
  [[nodiscard]] reflex::Decision decided(language_model::LanguageModel* model,
                                         reflex::Guard guard) {
    return decided(setup(model, guard));
  }
  [[nodiscard]] static reflex::Decision decided(const PlanesSetup& setup) {
    Planes planes(setup, {}, 500);
    return met(planes);
  }
  /// Drives up to the trigger, the scenes' time beginning at `start` [s].
  static reflex::Decision met(Planes& planes, double start = 0.0) {
    for (int k = 0; k < 450; ++k) {
      world::Scene scene = at(0.01 * k);
      scene.time += start;
      const auto beliefs = intent::beliefs_at_sight(intent::shipped_model(), scene);
      if (planes.step(scene, beliefs, Clock::Time{0}, false).triggered) {
        break;
      }
    }
    return planes.decision().value();
  }
  /// The texts of all events of the thinking plane.
  static std::string thoughts(const Planes& planes) {
    std::string texts;
    for (const arbitration::Event& event : planes.thinking_events()) {
      texts += event.text + "\n";
    }
    return texts;
  }
  static language_model::ScriptedReply says(PolicyId policy) {
    return {.lines = {{.text = "because",
                       .answer = language_model::Answer::Kind::first,
                       .policy = policy}},
            .prompt_tokens = 10,
            .reply_tokens = 5};
  }

  SteadyClock clock_;
  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = prepare::read_harm("data/harm.toml").value();
};

// Braking needs 42.7 m and hits the wreck; both other lanes are free.
TEST_F(PlanesTest, WithoutModelAndMemoryTheVerdictDecides) {
  const auto decision = decided(nullptr, reflex::Guard::never_worse_than_braking);
  EXPECT_TRUE(manoeuvre::changes_lane(decision.plan.policy)) << name(decision.plan.policy);
  EXPECT_EQ(decision.source, reflex::Source::arbiter);
  ASSERT_TRUE(decision.verdict.has_value());
  EXPECT_LE(decision.time - decision.verdict->time, reflex::verdict_expiry);
  EXPECT_FALSE(decision.by_atlas);
}

TEST_F(PlanesTest, ByThePapersRuleBrakingIsAllThereIsWithoutModelAndMemory) {
  const auto decision = decided(nullptr, reflex::Guard::none);
  EXPECT_EQ(decision.plan.policy, PolicyId::aeb);
  EXPECT_EQ(decision.source, reflex::Source::fallback);
}

TEST_F(PlanesTest, AGoodAnswerIsCarriedOutUnderEitherRule) {
  for (const auto guard : {reflex::Guard::never_worse_than_braking, reflex::Guard::none}) {
    language_model::ScriptedModel model(says(PolicyId::aes_left), clock_);
    const auto decision = decided(&model, guard);
    EXPECT_EQ(decision.plan.policy, PolicyId::aes_left);
    EXPECT_EQ(decision.source, reflex::Source::model);
  }
}

// Doing nothing drives into the wreck at 20 m/s; the paper's algorithm caches what the model says.
TEST_F(PlanesTest, ABadAnswerIsCarriedOutByThePapersRuleOnly) {
  language_model::ScriptedModel guarded(says(PolicyId::no_intervention), clock_);
  EXPECT_NE(decided(&guarded, reflex::Guard::never_worse_than_braking).plan.policy,
            PolicyId::no_intervention);
  language_model::ScriptedModel paper(says(PolicyId::no_intervention), clock_);
  const auto decision = decided(&paper, reflex::Guard::none);
  EXPECT_EQ(decision.plan.policy, PolicyId::no_intervention);
  EXPECT_EQ(decision.source, reflex::Source::model);
}

// A verdict that takes a second is of a scene that is gone: nobody waits for it.
TEST_F(PlanesTest, ASlowForecasterIsNotWaitedFor) {
  PlanesSetup slow = setup(nullptr, reflex::Guard::never_worse_than_braking);
  slow.costs.verdict = 1.0;
  const auto decision = decided(slow);
  EXPECT_EQ(decision.plan.policy, PolicyId::aeb);
  EXPECT_EQ(decision.source, reflex::Source::fallback);
  EXPECT_EQ(decision.time, decided(nullptr, reflex::Guard::never_worse_than_braking).time);
}

TEST_F(PlanesTest, WhatHasBegunAnewDecidesAgain) {
  Planes planes(setup(nullptr, reflex::Guard::never_worse_than_braking), {}, 1'000);
  int decisions = 0;
  for (int encounter = 0; encounter < 2; ++encounter) {
    for (int k = 0; k < 330; ++k) {
      world::Scene scene = at(0.01 * k);
      scene.time += 10.0 * encounter;
      const auto beliefs = intent::beliefs_at_sight(intent::shipped_model(), scene);
      decisions += planes.step(scene, beliefs, Clock::Time{0}, false).triggered ? 1 : 0;
    }
    EXPECT_FALSE(planes.previews().empty());
    planes.begin_anew();
    EXPECT_EQ(planes.decision(), std::nullopt);
  }
  EXPECT_EQ(decisions, 2);
}

struct ModelFault {
  const char* name;
  language_model::ScriptedReply reply;
  const char* told;
};

// Whatever the model does, the verdict decides as without it, what happened is told, and in the
// next encounter, in which the model answers, it is heard.
TEST_F(PlanesTest, AModelThatFailsIsToldAndHeardTheNextTime) {
  const auto without = decided(nullptr, reflex::Guard::never_worse_than_braking);
  const ModelFault faults[] = {
      {"hangs", {}, "model: script: no answer in time"},
      {"dies",
       {.error = Error{Error::Code::unreadable, "the model's process has ended"}},
       "model: the model's process has ended"},
      {"answers 9",
       {.error = Error{Error::Code::malformed, "want a policy from 0 to 7, got 9"}},
       "model: want a policy from 0 to 7, got 9"},
      {"lies",
       {.lines = {{.text = "1. AES-R is clear by 17.5 m.",
                   .answer = language_model::Answer::Kind::ended,
                   .policy = PolicyId::aes_right}},
        .reply_tokens = 9},
       "truth check failed"},
      {"drives into the wreck", says(PolicyId::no_intervention), "rollout check failed"},
  };
  ManualClock real;  // of the model that hangs: the world waits
  for (const ModelFault& fault : faults) {
    SCOPED_TRACE(fault.name);
    bool well = false;
    language_model::ScriptedModel model(
        [&](const std::string&) { return well ? says(PolicyId::aes_left) : fault.reply; }, real);
    PlanesSetup faulty = setup(&model, reflex::Guard::never_worse_than_braking);
    faulty.clock = &real;
    Planes planes(faulty, {}, 1'000);
    const reflex::Decision decision = met(planes);
    EXPECT_EQ(decision.plan, without.plan);
    EXPECT_EQ(decision.source, reflex::Source::arbiter);
    EXPECT_EQ(decision.time, without.time);
    EXPECT_THAT(thoughts(planes), testing::HasSubstr(fault.told));
    well = true;
    planes.begin_anew();
    EXPECT_EQ(met(planes, 10.0).source, reflex::Source::model);
  }
}

// A token of the prompt takes 1 ms: the last answer that counts is there at the deadline, and one
// that is there within the next millisecond is not heard.
TEST_F(PlanesTest, AnAnswerThatIsOneMillisecondLateIsNotHeard) {
  const auto answered_after = [&](int prompt_tokens) {
    language_model::ScriptedReply reply = says(PolicyId::aes_left);
    reply.prompt_tokens = prompt_tokens;
    language_model::ScriptedModel model(reply, clock_);
    Planes planes(setup(&model, reflex::Guard::never_worse_than_braking), {}, 500);
    const reflex::Decision decision = met(planes);
    return std::pair(decision, planes.previews().at(0).situation.scene_at_trigger.time);
  };
  constexpr double asked_at = 0.05;  // after the forecasts of the first round [s]
  constexpr double margin = 0.05;    // before the forecast trigger [s]
  const double trigger = answered_after(10).second;
  const int most = static_cast<int>(std::floor((trigger - margin - asked_at) / 0.001));
  EXPECT_EQ(answered_after(most).first.source, reflex::Source::model);
  EXPECT_EQ(answered_after(most + 1).first.source, reflex::Source::arbiter);
}

/// 12.5 m/s on a dry road towards a wreck, which the small atlas knows, at pace `real`, on time
/// that this thread, the thinking one and the forecaster's share.
class ForecasterFaults : public PlanesTest {
 protected:
  /// Drives up to the trigger.
  reflex::Decision met(Planes& planes) {
    const Clock::Time start = meeting_.now();
    for (int k = 0; k < 250; ++k) {
      const double time = 0.01 * k;
      world::Scene scene = test::ego_at(12.5, manoeuvre::footprint(car_));
      scene.time = to_seconds(start) + time;
      scene.grip = 0.85;
      scene.ego_mass = car_.mass;
      scene.ego.X_WB.p.x = 12.5 * time;
      scene.actors.push_back(test::car(1, {40.0, 0.0}));
      const auto beliefs = intent::beliefs_at_sight(intent::shipped_model(), scene);
      if (planes.step(scene, beliefs, meeting_.now(), false).triggered) {
        break;
      }
      meeting_.wait_until(start + from_seconds(time + 0.01));
    }
    return planes.decision().value();
  }
  /// Two encounters: in the first the forecaster does this with every scene before it makes a
  /// verdict, in the second it is well.
  /// @return  what Planes::finish says
  std::string expect_that_the_atlas_stands_in(const std::function<void()>& fault) {
    const arbitration::Forecaster forecaster({.car = &car_, .harm = &harm_});
    PlanesSetup faulty{.forecast = {.car = &car_, .harm = &harm_, .atlas = &atlas::small_atlas()},
                       .pace = Pace::real,
                       .judge =
                           [&](const auto&... seen) {
                             if (!well_) {
                               fault();
                             }
                             return forecaster.judge(seen...);
                           },
                       .clock = &meeting_};
    Planes planes(faulty, {}, 1'000);
    const reflex::Decision decision = met(planes);
    EXPECT_TRUE(decision.by_atlas);
    EXPECT_EQ(decision.plan.policy, PolicyId::aeb);
    EXPECT_THAT(arbitration::decision_text(decision), testing::HasSubstr("by the atlas"));
    well_ = true;
    meeting_.wait_until(meeting_.now() + from_seconds(1.0));  // what was begun comes to its end
    planes.begin_anew();
    const reflex::Decision next = met(planes);
    EXPECT_FALSE(next.by_atlas);
    EXPECT_TRUE(next.verdict.has_value());
    EXPECT_EQ(next.plan.policy, PolicyId::aeb);
    return planes.finish();
  }

  MeetingClock meeting_{3};
  std::atomic<bool> well_ = false;
};

TEST_F(ForecasterFaults, OneThatStandsStillIsNotWaitedFor) {
  const auto stands_still = [&] {
    while (!well_) {
      meeting_.wait_until(meeting_.now() + from_seconds(0.1));
    }
  };
  EXPECT_EQ(expect_that_the_atlas_stands_in(stands_still), "");
}

// A verdict takes 30 ms (data/thinking_costs.toml); ten times that is too old to be decided by.
TEST_F(ForecasterFaults, OneThatIsTenTimesTooSlowIsNotWaitedFor) {
  const auto is_slow = [&] { meeting_.wait_until(meeting_.now() + from_seconds(0.3)); };
  EXPECT_EQ(expect_that_the_atlas_stands_in(is_slow), "");
}

TEST_F(ForecasterFaults, WhatOneThrowsIsToldInTheEnd) {
  const auto throws = [] { throw std::runtime_error("a matrix is singular"); };
  EXPECT_EQ(expect_that_the_atlas_stands_in(throws), "forecaster: a matrix is singular");
}

// Asked in one encounter, answered in the next, which is just like it and 0.4 s nearer to its end:
// 20 ms before its trigger the plan is there, and it is not for it.
TEST_F(PlanesTest, PlansOfOneEncounterAreNotHandedOverInTheNext) {
  const auto guard = reflex::Guard::none;  // whatever is cached is carried out
  const double trigger = decided(nullptr, guard).time - 0.4;
  int num_asked = 0;
  language_model::ScriptedModel model(
      [&](const std::string&) {
        language_model::ScriptedReply reply = says(PolicyId::aes_left);
        reply.prompt_tokens = static_cast<int>(std::lround(1000.0 * (trigger - 0.02 - 0.05)));
        if (++num_asked > 1) {
          reply.error = Error{Error::Code::unreadable, "it is mute"};
        }
        return reply;
      },
      clock_);
  for (const bool anew : {false, true}) {
    num_asked = 0;
    Planes planes(setup(&model, guard), {}, 1000);
    const auto step = [&](world::Scene scene) {
      const auto beliefs = intent::beliefs_at_sight(intent::shipped_model(), scene);
      planes.step(scene, beliefs, Clock::Time{0}, false);
    };
    step(at(0.0));
    ASSERT_EQ(num_asked, 1);
    if (anew) {
      planes.begin_anew();
    }
    for (int k = 1; k < 400 && !planes.decision(); ++k) {
      world::Scene scene = at(0.01 * k + 0.4);
      scene.time = 0.01 * k;
      step(scene);
    }
    ASSERT_TRUE(planes.decision().has_value());
    EXPECT_EQ(planes.decision()->source, anew ? reflex::Source::fallback : reflex::Source::model);
  }
}

// Ten minutes into a drive another begins, whose time counts from 0: forecaster and model are there
// for it as for the first.
TEST_F(PlanesTest, ANewDriveIsThoughtAboutAsTheFirst) {
  language_model::ScriptedModel model(says(PolicyId::aes_left), clock_);
  Planes planes(setup(&model, reflex::Guard::never_worse_than_braking), {}, 1000);
  const reflex::Decision first = met(planes, 600.0);
  EXPECT_EQ(first.source, reflex::Source::model);
  ASSERT_TRUE(first.verdict.has_value());
  planes.begin_anew(Reset::drive);
  const reflex::Decision second = met(planes);
  EXPECT_EQ(second.source, reflex::Source::model);
  ASSERT_TRUE(second.verdict.has_value());
  EXPECT_NEAR(second.verdict->time, first.verdict->time - 600.0, 1e-6);
}

// The forecaster is at work on the last scene of an encounter when the next begins.
TEST_F(PlanesTest, AVerdictOfOneEncounterIsNotHandedOverInTheNext) {
  for (const bool anew : {false, true}) {
    MeetingClock meeting(3);
    PlanesSetup slow = setup(nullptr, reflex::Guard::never_worse_than_braking);
    slow.pace = Pace::real;
    slow.clock = &meeting;
    slow.judge = [&, forecaster = arbitration::Forecaster(slow.forecast)](const auto&... seen) {
      meeting.wait_until(meeting.now() + from_seconds(0.1));
      return forecaster.judge(seen...);
    };
    Planes planes(slow, {}, 10);
    const auto step = [&](double time) {
      const world::Scene scene = at(time);
      planes.step(scene, intent::beliefs_at_sight(intent::shipped_model(), scene), meeting.now(),
                  false);
    };
    step(0.0);
    meeting.wait_until(from_seconds(0.05));
    if (anew) {
      planes.begin_anew();
    }
    meeting.wait_until(from_seconds(0.2));
    step(0.2);
    EXPECT_EQ(planes.new_verdict().has_value(), !anew);
    EXPECT_EQ(planes.finish(), "");
  }
}

// It writes for two seconds. The encounter is over after 0.3 s; within half a second the question
// is withdrawn, and the model is asked about the next.
TEST_F(PlanesTest, AQuestionOfAnEncounterThatIsOverKeepsTheModelFromNobody) {
  MeetingClock meeting(3);
  language_model::ScriptedReply reply = says(PolicyId::aes_left);
  reply.lines[0].after = std::chrono::seconds(2);
  for (int k = 19; k > 0; --k) {
    reply.lines.insert(reply.lines.begin(),
                       {.after = std::chrono::milliseconds(100 * k), .text = "so "});
  }
  language_model::ScriptedModel model(reply, meeting);
  PlanesSetup real = setup(&model, reflex::Guard::never_worse_than_braking);
  real.pace = Pace::real;
  real.clock = &meeting;
  Planes planes(real, {}, 100);
  for (int k = 0; k < 110; ++k) {
    if (k == 30) {
      planes.begin_anew();
    }
    const world::Scene scene = at(0.01 * k);
    planes.step(scene, intent::beliefs_at_sight(intent::shipped_model(), scene), meeting.now(),
                false);
    meeting.wait_until(from_seconds(0.01 * (k + 1)));
  }
  EXPECT_EQ(planes.finish(), "");
  EXPECT_EQ(model.num_asked(), 2);
}

// It reads for a second, and what it says fails the check: until then it is busy, also with what
// comes up meanwhile.
TEST_F(PlanesTest, TheModelIsBusyUntilItHasAnsweredWhateverItsAnswerIsWorth) {
  language_model::ScriptedReply reply = says(PolicyId::no_intervention);
  reply.prompt_tokens = 1000;
  language_model::ScriptedModel model(reply, clock_);
  Planes planes(setup(&model, reflex::Guard::never_worse_than_braking), {}, 1000);
  const auto step = [&](const world::Scene& scene) {
    const auto beliefs = intent::beliefs_at_sight(intent::shipped_model(), scene);
    planes.step(scene, beliefs, Clock::Time{0}, false);
  };
  for (int k = 0; k < 150; ++k) {
    world::Scene scene = at(0.01 * k);
    if (k >= 30) {
      scene.actors[0].X_WA.p = scene.actors[0].X_WA.p + Vec2{10.0, 1.0};  // another forecast
      scene.actors[0].kind = world::ActorKind::truck;
    }
    step(scene);
  }
  ASSERT_EQ(model.num_asked(), 2);
  const auto& events = planes.thinking_events();
  EXPECT_TRUE(std::is_sorted(
      events.begin(), events.end(),
      [](const arbitration::Event& a, const arbitration::Event& b) { return a.time < b.time; }));
}

// One forecast after the other is forgotten in an encounter that does not end. What is kept of its
// story is bounded, and says how much is missing.
TEST_F(PlanesTest, TheStoryOfAnEndlessEncounterIsBounded) {
  std::size_t heard = 0;
  PlanesSetup small = setup(nullptr, reflex::Guard::none);
  small.most_events = 8;
  Planes::Listener counts;
  counts.event = [&](const arbitration::Event&) { ++heard; };
  Planes planes(small, counts, 100);
  for (int k = 0; k < 20; ++k) {
    world::Scene scene = at(0.0);
    scene.time = 60.0 * k;
    planes.step(scene, intent::beliefs_at_sight(intent::shipped_model(), scene), Clock::Time{0},
                false);
    const auto& kept = planes.thinking_events();
    ASSERT_LE(kept.size(), 8U);
    if (heard > 8) {
      EXPECT_EQ(kept.front().text, std::to_string(heard - (kept.size() - 1)) +
                                       " earlier events of this plane are left out");
    }
  }
  EXPECT_GT(heard, 20U);
  planes.begin_anew();
  const world::Scene scene = at(0.0);
  planes.step(scene, intent::beliefs_at_sight(intent::shipped_model(), scene), Clock::Time{0},
              false);
  EXPECT_EQ(thoughts(planes).find("left out"), std::string::npos);
}

TEST_F(PlanesTest, NothingIsToldOfTimesBeforeTheFirstStep) {
  const Planes planes(setup(nullptr, reflex::Guard::never_worse_than_braking), {}, 10);
  EXPECT_EQ(planes.timing().calls, 0U);
  EXPECT_EQ(planes.decision(), std::nullopt);
}

}  // namespace
}  // namespace saca::runtime::planes_test
