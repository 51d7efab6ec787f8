#include "saca/lab/encounter/encounter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <algorithm>
#include <filesystem>

#include "saca/lab/encounter/wreck_for_test.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/atlas/atlas_for_test.h"
#include "saca/thinking/arbitration/forecaster.h"
#include "saca/thinking/intent/shipped_model.h"
#include "saca/thinking/language_model/scripted_model.h"
#include "saca/thinking/memory/experience.h"
#include "tests/support/meeting_clock.h"

namespace saca::encounter::encounter_test {
namespace {

using arbitration::EventKind;
using manoeuvre::PolicyId;
using reflex::Source;

/// Always the same policy, by 10 prompt tokens and 5 reply tokens.
language_model::ScriptedReply says(PolicyId policy) {
  return {.lines = {{.text = "because",
                     .answer = language_model::Answer::Kind::first,
                     .policy = policy}},
          .prompt_tokens = 10,
          .reply_tokens = 5};
}

class EncounterTest : public testing::Test {
 protected:
  Result<Record> play(const scenario::Scenario& scenario,
                      language_model::LanguageModel* model = nullptr,
                      memory::Store* memory = nullptr, std::optional<manoeuvre::Plan> forced = {}) {
    return run({.scenario = &scenario,
                .car = &car_,
                .harm = &harm_,
                .intent = &intent_,
                .pace = runtime::Pace::lockstep,
                .costs = {.preview = 0.05, .prompt_token = 0.001, .reply_token = 0.01},
                .model = model,
                .memory = memory,
                .forced = forced,
                .clock = &clock_},
               quiet_);
  }
  static bool has(const Record& record, EventKind kind) {
    return std::any_of(record.events.begin(), record.events.end(),
                       [&](const arbitration::Event& event) { return event.kind == kind; });
  }

  SteadyClock clock_;
  Silence quiet_;
  manoeuvre::Car car_ = prepare::default_car();
  const intent::Model& intent_ = intent::shipped_model();
  collision::HarmModel harm_ = prepare::read_harm("data/harm.toml").value();
};

TEST_F(EncounterTest, AskedToBrakeItBrakesAtT1) {
  const auto scenario = wreck_on_wet_road();
  const auto played = play(scenario, nullptr, nullptr, manoeuvre::Plan{PolicyId::aeb, {}});
  ASSERT_TRUE(played.has_value()) << played.error().message;
  const Record& record = played.value();
  ASSERT_TRUE(record.decision.has_value());
  EXPECT_EQ(record.decision->plan.policy, PolicyId::aeb);
  // 90 m to centre, 4.5 m of halves and front, at 20 m/s: contact at 4.275 s, T1 1.3 s before.
  EXPECT_NEAR(record.decision->time, 4.275 - 1.3, 0.025);
  ASSERT_TRUE(record.result.contact.has_value());  // 26 m are there, 42.7 m needed
  EXPECT_GT(record.result.harm, 0.0);
  EXPECT_TRUE(has(record, EventKind::contact));
  // 20^2 - 2 * 4.9 * 26 m is left of v^2: about 12 m/s, more for the brakes' delay.
  EXPECT_NEAR(record.result.contact->relative_speed, 12.7, 0.8);
}

// Half of the grip of 0.5 is 2.45 m/s2: 20^2 - 2 * 2.45 * 26 m is left of v^2.
TEST_F(EncounterTest, AskedToBrakeByAStrengthItDoes) {
  const auto scenario = wreck_on_wet_road();
  const manoeuvre::Plan half{PolicyId::aeb, {}, 0.5};
  const Record record = play(scenario, nullptr, nullptr, half).value();
  EXPECT_EQ(record.decision->plan, half);
  ASSERT_TRUE(record.result.contact.has_value());
  EXPECT_NEAR(record.result.contact->relative_speed, 16.7, 0.6);
}

// Braking hits the wreck, and the lanes beside are free.
TEST_F(EncounterTest, WithoutModelAndMemoryTheVerdictDecides) {
  const auto scenario = wreck_on_wet_road();
  const Record record = play(scenario).value();
  ASSERT_TRUE(record.decision.has_value());
  EXPECT_EQ(record.decision->source, Source::arbiter);
  EXPECT_TRUE(manoeuvre::changes_lane(record.decision->plan.policy));
  EXPECT_EQ(record.result.harm, 0.0);
  EXPECT_FALSE(record.result.contact.has_value());
}

// 90 m to a wreck, and no room beside it: what stops from 20 m/s on grip 0.5 needs some 43 m, and
// at T1 there are 26. Who sees it coming brakes in time, and no sooner than it costs to wait.
TEST_F(EncounterTest, ItBrakesBeforeT1WhereThatIsTooLate) {
  scenario::Scenario scenario = wreck_on_wet_road();
  scenario.road.left_edge = 1.75;
  scenario.road.right_edge = -1.75;
  const Record record = play(scenario).value();
  ASSERT_TRUE(record.decision.has_value());
  EXPECT_TRUE(record.decision->waiting_cost.has_value());
  EXPECT_EQ(record.decision->plan.policy, PolicyId::aeb);
  // 85.5 m are there at first; 43 to 48 m when it brakes
  EXPECT_GT(record.decision->time, (85.5 - 48.0) / 20.0);
  EXPECT_LT(record.decision->time, (85.5 - 42.0) / 20.0);
  EXPECT_FALSE(record.result.contact.has_value());
  EXPECT_EQ(record.result.harm, 0.0);
}

// What is decided by is replayed in runtime/replay_test.cpp.
TEST_F(EncounterTest, TheTapeHoldsEveryLookFromTheFirstOn) {
  const auto scenario = wreck_on_wet_road(150.0);  // nothing threatens within T2 yet
  EXPECT_FALSE(play(scenario).value().tape.has_value());
  const Record record = run({.scenario = &scenario,
                             .car = &car_,
                             .harm = &harm_,
                             .intent = &intent_,
                             .seed = 3,
                             .tapes = true,
                             .clock = &clock_},
                            quiet_)
                            .value();
  ASSERT_TRUE(record.tape.has_value());
  EXPECT_EQ(record.tape->header.scenario, "wreck");
  EXPECT_EQ(record.tape->header.car, "compact_rwd_ev");
  EXPECT_EQ(record.tape->header.seed, 3U);
  EXPECT_EQ(record.tape->content.dropped + record.tape->content.lost, 0U);
  const auto& steps = record.tape->content.steps;
  ASSERT_FALSE(steps.empty());
  EXPECT_EQ(steps.front().scene.time, 0.0);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    EXPECT_NEAR(steps[k].scene.time, 0.01 * static_cast<double>(k), 1e-9);
    if (steps[k].decision) {
      EXPECT_EQ(steps[k].decision->time, record.decision->time);
    }
  }
  EXPECT_EQ(std::count_if(steps.begin(), steps.end(),
                          [](const runtime::TapeStep& step) { return step.decision.has_value(); }),
            1);
}

// The record has the verdicts that the tape has, and the scene by which it was decided: judged
// again, it gives the same expected harms bit by bit.
TEST_F(EncounterTest, TheVerdictsOfTheRecordAreThoseOfTheTape) {
  scenario::Scenario scenario = wreck_on_wet_road();
  scenario.road.left_edge = 1.75;  // braking is all that there is
  scenario.road.right_edge = -1.75;
  const Record record = run({.scenario = &scenario,
                             .car = &car_,
                             .harm = &harm_,
                             .intent = &intent_,
                             .tapes = true,
                             .clock = &clock_},
                            quiet_)
                            .value();
  ASSERT_TRUE(record.decision && record.decision->verdict);
  std::vector<reflex::Verdict> taped;
  std::vector<double> received;
  for (const runtime::TapeStep& step : record.tape->content.steps) {
    if (step.verdict) {
      taped.push_back(step.verdict->verdict);
      received.push_back(step.scene.time);
    }
  }
  const auto& noted = record.verdicts.verdicts();
  ASSERT_EQ(noted.size(), taped.size());
  ASSERT_GT(noted.size(), 5U);
  for (std::size_t k = 0; k < noted.size(); ++k) {
    EXPECT_FALSE(noted[k].by_atlas);
    EXPECT_EQ(noted[k].received, received[k]);
    EXPECT_EQ(runtime::verdict_json(noted[k].verdict), runtime::verdict_json(taped[k]));
    EXPECT_EQ(noted[k].under_way.has_value(), noted[k].verdict.time > record.decision->time);
  }
  const auto& judged = record.verdicts.judged();
  ASSERT_EQ(judged.size(), 1U + record.switches.size());
  EXPECT_EQ(judged[0].begun, record.decision->time);
  const arbitration::Forecaster forecaster({.car = &car_, .harm = &harm_});
  EXPECT_EQ(runtime::verdict_json(forecaster.judge(judged[0].scene, judged[0].beliefs)),
            runtime::verdict_json(*record.decision->verdict));
}

// Without the forecaster in time, the reflex plane's own verdict stands in the record as such.
TEST_F(EncounterTest, AVerdictByTheAtlasIsInTheRecord) {
  scenario::Scenario scenario = wreck_on_wet_road();
  scenario.grip = 0.85;
  scenario.ego = scenario::EgoStart{.pose = {}, .speed = 12.8};
  std::get<scenario::Script>(scenario.actors[0].motion).start.s = 65.0;
  const Record record = run({.scenario = &scenario,
                             .car = &car_,
                             .harm = &harm_,
                             .intent = &intent_,
                             .atlas = &atlas::small_atlas(),
                             .costs = {.verdict = 0.3},  // older than 0.1 s when it is ready
                             .clock = &clock_},
                            quiet_)
                            .value();
  ASSERT_TRUE(record.decision && record.decision->by_atlas);
  const auto& noted = record.verdicts.verdicts();
  const auto own = std::find_if(noted.begin(), noted.end(),
                                [](const NotedVerdict& one) { return one.by_atlas; });
  ASSERT_NE(own, noted.end());
  EXPECT_EQ(runtime::verdict_json(own->verdict), runtime::verdict_json(*record.decision->verdict));
  ASSERT_FALSE(record.verdicts.judged().empty());
  EXPECT_TRUE(record.verdicts.judged()[0].by_atlas);
  EXPECT_EQ(record.verdicts.judged()[0].scene.time, record.decision->time);
}

TEST_F(EncounterTest, ACheckedAnswerIsCarriedOut) {
  language_model::ScriptedModel model(says(PolicyId::aes_left), clock_);
  const auto scenario = wreck_on_wet_road();
  const Record record = play(scenario, &model).value();
  EXPECT_EQ(record.decision->plan.policy, PolicyId::aes_left);
  EXPECT_EQ(record.decision->source, Source::model);
  EXPECT_GT(record.decision->similarity.value(), 0.9);
  EXPECT_FALSE(record.result.contact.has_value());
  EXPECT_EQ(record.result.harm, 0.0);
  EXPECT_TRUE(has(record, EventKind::rest));
  EXPECT_EQ(record.previews[static_cast<std::size_t>(*record.decision->preview)].plan->policy,
            PolicyId::aes_left);
}

// 12.8 m/s on grip 0.85, less what drag takes, lies in the small atlas all the way.
TEST_F(EncounterTest, WithAnAtlasForecastsAndTheLastCheckAreReadFromIt) {
  scenario::Scenario scenario = wreck_on_wet_road();
  scenario.grip = 0.85;
  scenario.ego = scenario::EgoStart{.pose = {}, .speed = 12.8};
  std::get<scenario::Script>(scenario.actors[0].motion).start.s = 65.0;
  scenario::ScenarioActor follower = scenario.actors[0];  // because of whom braking is not the best
  follower.id = 2;
  follower.motion = scenario::Script{
      .start = {.s = -8.5}, .speed = 12.8, .behaviour = scenario::Behaviour::constant_velocity};
  scenario.actors.push_back(follower);
  language_model::ScriptedModel model(says(PolicyId::aes_left), clock_);
  const atlas::Atlas& atlas = atlas::small_atlas();
  const auto play_with_atlas = [&] {
    return run({.scenario = &scenario,
                .car = &car_,
                .harm = &harm_,
                .intent = &intent_,
                .atlas = &atlas,
                .pace = runtime::Pace::lockstep,
                .costs = {.preview = 0.05, .prompt_token = 0.001, .reply_token = 0.01},
                .model = &model,
                .clock = &clock_},
               quiet_)
        .value();
  };
  const Record record = play_with_atlas();
  ASSERT_FALSE(record.previews.empty());
  for (const preview::PolicyFacts& fact : record.previews[0].situation.facts) {
    EXPECT_FALSE(std::holds_alternative<preview::RolledOutcome>(fact.end))
        << name(fact.plan.policy);
  }
  ASSERT_TRUE(record.decision.has_value());
  EXPECT_EQ(record.decision->plan.policy, PolicyId::aes_left);
  const auto harm_of = [](const Record& one, PolicyId policy) {
    return find_plan(one.decision->verdict.value(), {policy, std::nullopt})->harm;
  };
  EXPECT_LT(harm_of(record, PolicyId::aes_left), harm_of(record, PolicyId::aeb));
  const Record again = play_with_atlas();
  EXPECT_EQ(harm_of(again, PolicyId::aeb), harm_of(record, PolicyId::aeb));
  EXPECT_EQ(again.result.clearance, record.result.clearance);
}

TEST_F(EncounterTest, ABadAnswerFailsTheCheckAndIsNotCarriedOut) {
  language_model::ScriptedModel model(says(PolicyId::no_intervention), clock_);
  const auto scenario = wreck_on_wet_road();
  const Record record = play(scenario, &model).value();
  EXPECT_NE(record.decision->plan.policy, PolicyId::no_intervention);
  EXPECT_EQ(record.decision->source, Source::arbiter);
  EXPECT_FALSE(record.previews[0].check->passed);
}

TEST_F(EncounterTest, MemoryLearnsWhatWouldHaveBeenBest) {
  const auto file = std::filesystem::path(testing::TempDir()) / "saca_encounter.sqlite";
  std::filesystem::remove(file);
  memory::Store store = memory::Store::open(file).value();
  const auto scenario = wreck_on_wet_road();
  const Record first = play(scenario, nullptr, &store).value();
  EXPECT_EQ(first.decision->source, Source::arbiter);
  ASSERT_TRUE(first.stored.has_value());
  // What every policy was told to end in and did: braking hits the wreck, the best does not.
  const memory::Case learnt = store.find(*first.stored).value().value();
  for (const auto* harms : {&learnt.told, &learnt.happened}) {
    ASSERT_TRUE(harms->has_value());
    EXPECT_GT((*harms)->at(manoeuvre::index(PolicyId::aeb)).value(), 0.01);
    EXPECT_EQ((*harms)->at(manoeuvre::index(*first.best)).value(), 0.0);
  }
  EXPECT_EQ(learnt.origin, memory::Origin::simulation);
  EXPECT_EQ(learnt.scene.time, first.decision->time);
  ASSERT_EQ(learnt.intentions.size(), 1U);
  EXPECT_EQ(learnt.intentions[0][0], 1.0) << "a wreck maintains";
  ASSERT_EQ(learnt.risks.size(), 1U);
  EXPECT_GT(learnt.risks[0], 0.0);
  ASSERT_FALSE(learnt.made_with.empty());
  EXPECT_EQ(learnt.made_with[0].what, "car");
  const Record second = play(scenario, nullptr, &store).value();
  EXPECT_EQ(second.decision->source, Source::memory);
  EXPECT_TRUE(memory::as_good_as_best(learnt).test(manoeuvre::index(second.decision->plan.policy)));
  EXPECT_LE(second.result.harm, first.result.harm);
  std::filesystem::remove(file);
}

// Somebody removes the memory's file, or holds it, while the encounter lasts: it is decided all the
// same, and the record says what was not learnt.
TEST_F(EncounterTest, AMemoryThatVanishesOrIsHeldIsToldAndNotWaitedFor) {
  const auto scenario = wreck_on_wet_road();
  for (const bool vanishes : {true, false}) {
    const auto file = std::filesystem::path(testing::TempDir()) / "saca_lost.sqlite";
    std::filesystem::remove(file);
    memory::Store store = memory::Store::open(file).value();
    sqlite3* other = nullptr;
    if (vanishes) {
      std::filesystem::remove(file);
    } else {
      ASSERT_EQ(sqlite3_open(file.c_str(), &other), SQLITE_OK);
      ASSERT_EQ(sqlite3_exec(other, "BEGIN EXCLUSIVE", nullptr, nullptr, nullptr), SQLITE_OK);
    }
    const Record record = play(scenario, nullptr, &store).value();
    EXPECT_EQ(record.decision->source, Source::arbiter);
    EXPECT_EQ(record.result.harm, 0.0);
    EXPECT_FALSE(record.stored.has_value());
    ASSERT_TRUE(record.not_stored.has_value());
    EXPECT_THAT(record.not_stored->message, testing::HasSubstr("saca_lost.sqlite"));
    EXPECT_TRUE(has(record, EventKind::fault));
    sqlite3_close(other);
    if (!vanishes) {  // let go, it learns again
      EXPECT_TRUE(play(scenario, nullptr, &store).value().stored.has_value());
    }
    std::filesystem::remove(file);
  }
}

TEST_F(EncounterTest, TheUserCanAskForAPolicy) {
  language_model::ScriptedModel model(says(PolicyId::aes_left), clock_);
  const auto scenario = wreck_on_wet_road();
  const Record record =
      play(scenario, &model, nullptr, manoeuvre::Plan{PolicyId::es_b_right, {}}).value();
  EXPECT_EQ(record.decision->plan.policy, PolicyId::es_b_right);
  EXPECT_EQ(record.decision->source, Source::forced);
  EXPECT_TRUE(record.decision->plan.target_speed.has_value());
}

TEST_F(EncounterTest, WhatCannotBeDrivenBecomesBraking) {
  auto scenario = wreck_on_wet_road();
  scenario.grip = 0.15;
  const Record record =
      play(scenario, nullptr, nullptr, manoeuvre::Plan{PolicyId::t_drift_left, {}}).value();
  EXPECT_EQ(record.decision->plan.policy, PolicyId::aeb);
  EXPECT_EQ(record.decision->source, Source::fallback);
  EXPECT_TRUE(has(record, EventKind::fault));
  const auto& events = record.events;
  EXPECT_TRUE(std::any_of(events.begin(), events.end(), [](const arbitration::Event& event) {
    return event.kind == EventKind::fault &&
           event.text.find("T-D-L cannot be driven from here (grip)") != event.text.npos;
  }));
}

// Nothing is done about two that are not there, one after the other: at 20 m/s the first, 90 m
// ahead, is passed after 4.8 s, and the second is not within 5.5 s before 9.8 s. The avoider
// decides twice; the record keeps what it decided first, and tells the rest.
TEST_F(EncounterTest, OfTwoEncountersTheFirstIsInTheRecordAndTheSecondIsTold) {
  scenario::Scenario scenario = wreck_on_wet_road(90.0, 18.0);
  scenario.actors[0].ghost = true;
  scenario.actors.push_back(scenario.actors[0]);
  scenario.actors[1].id = 2;
  std::get<scenario::Script>(scenario.actors[1].motion).start.s = 310.0;
  const Record record = play(scenario, nullptr, nullptr, manoeuvre::doing_nothing).value();
  std::vector<double> triggers;
  for (const arbitration::Event& event : record.events) {
    if (event.kind == EventKind::trigger) {
      triggers.push_back(event.time);
    }
  }
  ASSERT_EQ(triggers.size(), 2U);
  EXPECT_NEAR(triggers[1] - triggers[0], (310.0 - 90.0) / 20.0, 0.1);
  EXPECT_EQ(record.decision->time, triggers[0]);
  EXPECT_EQ(record.threat, "car1");
  ASSERT_FALSE(record.previews.empty());
  for (const arbitration::Preview& preview : record.previews) {
    EXPECT_NEAR(preview.newest_scene.time, triggers[0], 1.0);
  }
  EXPECT_EQ(record.result.harm, 0.0);
}

// An observer has watched since the beginning when SACA wakes.
TEST_F(EncounterTest, IntentionsAreNotedFromTheFirstLookOnButNotOfObstacles) {
  scenario::Scenario scenario = wreck_on_wet_road();
  scenario.actors[0].kind = world::ActorKind::obstacle;
  scenario.actors.push_back(
      {.id = 3,
       .footprint = {.length = 4.5, .width = 1.8},
       .mass = 1'500.0,
       .motion = scenario::Script{.start = {.s = 60.0, .d = 3.5}, .speed = 20.0}});
  const Record record = play(scenario).value();
  ASSERT_EQ(record.intentions.size(), 1U);
  const IntentionsSeen& seen = record.intentions[0];
  EXPECT_EQ(seen.id, 3);
  ASSERT_EQ(seen.times.size(), seen.beliefs.size());
  for (std::size_t k = 0; k < seen.times.size(); ++k) {
    EXPECT_NEAR(seen.times[k], 0.1 * static_cast<double>(k), 1e-9);
  }
  EXPECT_GT(seen.times.back(), record.decision->time);
}

TEST_F(EncounterTest, AnEmptyRoadIsLeftAlone) {
  scenario::Scenario scenario = wreck_on_wet_road();
  scenario.actors.clear();
  scenario.duration = 2.0;
  const Record record = play(scenario).value();
  EXPECT_FALSE(record.decision.has_value());
  EXPECT_TRUE(record.events.empty());
  EXPECT_TRUE(record.previews.empty());
}

TEST_F(EncounterTest, TheSameRunGivesTheSameRecordByteForByte) {
  language_model::ScriptedModel model(says(PolicyId::aes_left), clock_);
  const auto scenario = wreck_on_wet_road();
  encounter::Setup setup{.scenario = &scenario,
                         .car = &car_,
                         .harm = &harm_,
                         .intent = &intent_,
                         .model = &model,
                         .clock = &clock_};
  Record a = play(scenario, &model).value();
  Record b = play(scenario, &model).value();
  a.timing = {};  // measured in real time
  b.timing = {};
  EXPECT_EQ(record_json(setup, a), record_json(setup, b));
}

/// Notes whether anything is told before it happens, in real time.
class Foreknowledge final : public Listener {
 public:
  explicit Foreknowledge(const Clock& clock) : clock_(clock) {}
  void on_event(const arbitration::Event& event) override {
    if (event.plane != arbitration::Plane::thinking) {
      earliest_ = std::min(earliest_, to_seconds(clock_.now()) - event.time);
      ++num_;
    }
  }
  void on_reasoning(std::int32_t, std::string_view) override {}

  double earliest_ = 1e9;  // [s]
  int num_ = 0;

 private:
  const Clock& clock_;
};

// A model that would take ten seconds is asked about a wreck that is there in one and a half.
TEST_F(EncounterTest, AtRealPaceTheWorldDoesNotWait) {
  scenario::Scenario scenario = wreck_on_wet_road();
  auto& wreck = std::get<scenario::Script>(scenario.actors[0].motion);
  wreck.start.s = 36.0;  // triggers after a quarter of a second
  scenario.duration = 0.6;
  MeetingClock clock(3);  // this thread, the thinking one and the forecaster's
  language_model::ScriptedReply slow = says(PolicyId::aes_left);
  slow.lines[0].after = std::chrono::seconds(10);
  language_model::ScriptedModel model(slow, clock);
  Foreknowledge listener(clock);
  const auto played = run({.scenario = &scenario,
                           .car = &car_,
                           .harm = &harm_,
                           .intent = &intent_,
                           .pace = runtime::Pace::real,
                           .model = &model,
                           .clock = &clock},
                          listener);
  ASSERT_TRUE(played.has_value());
  ASSERT_TRUE(played.value().decision.has_value());
  EXPECT_EQ(played.value().decision->source, Source::arbiter);
  EXPECT_GE(listener.num_, 2);  // T2 and T1
  // The world's time is the clock's, to the look of 10 ms in which something happens.
  EXPECT_GE(listener.earliest_, -0.0101);
  EXPECT_NEAR(played.value().frames.back().scene.time, 0.6, 0.021);
  EXPECT_NEAR(to_seconds(clock.now()), 0.6, 0.0101);
}

/// A car that follows the ego with so much room between bumpers.
scenario::ScenarioActor following(double gap) {
  constexpr double speed = 20.0;
  scenario::Script script{
      .start = {.s = -2.45 - gap - 2.25}, .speed = speed, .behaviour = scenario::Behaviour::follow};
  script.law = drivers::content_with(drivers::usual_driver(speed), speed, gap);
  return {.id = 2, .footprint = {.length = 4.5, .width = 1.8}, .mass = 1'500.0, .motion = script};
}

// On dry road braking stops before the wreck; 5 m behind nobody reacts in time: the ego is hit from
// behind. It is known beforehand, in hindsight and in the run.
TEST_F(EncounterTest, BeingHitFromBehindCounts) {
  auto scenario = wreck_on_wet_road();
  scenario.grip = 0.9;
  std::get<scenario::Script>(scenario.actors[0].motion).start.s = 100.0;
  std::get<scenario::EgoStart>(scenario.ego).speed = 18.0;
  scenario.actors.push_back(following(5.0));
  std::get<scenario::Script>(scenario.actors[1].motion).speed = 18.0;
  const Record braked =
      play(scenario, nullptr, nullptr, manoeuvre::Plan{PolicyId::aeb, {}}).value();
  ASSERT_TRUE(braked.result.contact.has_value());
  EXPECT_EQ(braked.result.contact->ego_face, collision::Face::rear);
  const collision::Outcome& foreseen =
      (*braked.hindsight)[manoeuvre::index(PolicyId::aeb)].facts.outcome();
  EXPECT_NEAR(foreseen.contact->time, braked.result.contact->time, 0.05);
  EXPECT_NEAR(foreseen.contact->relative_speed, braked.result.contact->relative_speed, 0.2);
  EXPECT_NE(*braked.best, PolicyId::aeb);
  const Record swerved =
      play(scenario, nullptr, nullptr, manoeuvre::Plan{*braked.best, {}}).value();
  EXPECT_LT(swerved.result.harm, braked.result.harm);
}

// What is not there is braked for, and costs nothing but the braking.
TEST_F(EncounterTest, SacaActsOnWhatItPerceivesAndIsJudgedByTheTruth) {
  auto scenario = wreck_on_wet_road();
  scenario.actors[0].ghost = true;
  scenario.actors[0].existence = 0.8;
  scenario.perception.grip_believed = 0.7;
  const Record record =
      play(scenario, nullptr, nullptr, manoeuvre::Plan{PolicyId::aeb, {}}).value();
  ASSERT_TRUE(record.decision.has_value());
  EXPECT_TRUE(record.at_trigger->actors.empty());
  EXPECT_FALSE(record.result.contact.has_value());
  EXPECT_EQ(record.frames.back().perceived.actors.size(), 1U);
  EXPECT_EQ(record.frames.back().scene.actors.size(), 0U);
  EXPECT_EQ(record.frames.back().perceived.grip, 0.7);
  EXPECT_EQ(record.frames.back().scene.grip, 0.5);
  EXPECT_EQ(*record.best, PolicyId::no_intervention);
}

// Outside the domain of lane changes there is still the fallback.
TEST_F(EncounterTest, TooFastForASwerveItBrakes) {
  language_model::ScriptedModel model(says(PolicyId::aes_left), clock_);
  scenario::Scenario scenario = wreck_on_wet_road();
  std::get<scenario::EgoStart>(scenario.ego).speed = 35.0;
  const Record record = play(scenario, &model).value();
  EXPECT_EQ(record.decision->plan.policy, PolicyId::aeb);
  EXPECT_EQ(record.decision->source, Source::arbiter);
  EXPECT_LT(record.result.contact->relative_speed, 35.0);
}

}  // namespace
}  // namespace saca::encounter::encounter_test
