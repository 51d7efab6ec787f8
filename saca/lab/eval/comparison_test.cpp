#include "saca/lab/eval/comparison.h"

#include <gmock/gmock.h>

#include <stdexcept>

#include "saca/lab/eval/methods.h"
#include "saca/lab/eval/scenes_for_test.h"
#include "saca/lab/learned_danger/networks_for_test.h"
#include "saca/lab/scenario/chance.h"
#include "saca/thinking/intent/shipped_model.h"
#include "saca/thinking/language_model/scripted_model.h"

namespace saca::eval::comparison_test {
namespace {

using encounter::Action;
using encounter::View;
using manoeuvre::PolicyId;
using Methods = std::vector<std::unique_ptr<encounter::Method>>;

/// Begins plans at times.
class Scripted final : public encounter::Method {
 public:
  explicit Scripted(std::vector<std::pair<double, manoeuvre::Plan>> script)
      : script_(std::move(script)) {}
  [[nodiscard]] std::optional<Action> step(const View& view) override {
    if (next_ < script_.size() && view.scene.time >= script_[next_].first - 1e-9) {
      return Action{.plan = script_[next_++].second};
    }
    return std::nullopt;
  }

 private:
  std::vector<std::pair<double, manoeuvre::Plan>> script_;
  std::size_t next_ = 0;
};

class Throwing final : public encounter::Method {
  [[nodiscard]] std::optional<Action> step(const View&) override {
    throw std::runtime_error("no idea");
  }
};

class ComparisonTest : public testing::Test {
 protected:
  /// What is left to chance is drawn, so that equal rows are no accident.
  explicit ComparisonTest(double distance = 60.0) : scenario_(standing_car(19.0, distance)) {
    scenario_.road.left_edge = 5.25;
    stage_ = {
        &scenario_, &car_, &harm_, &intent::shipped_model(), {}, scenario::draw_chance(3, 5, 0.0)};
  }
  Comparison run(const Methods& methods) {
    Hindsight hindsight(car_, harm_);
    return compare(stage_, methods, hindsight).value();
  }
  template <class... All>
  static Methods list(All... all) {
    Methods methods;
    (methods.push_back(std::move(all)), ...);
    return methods;
  }
  static std::unique_ptr<encounter::Method> scripted(double time, PolicyId policy) {
    return std::make_unique<Scripted>(
        std::vector<std::pair<double, manoeuvre::Plan>>{{time, {policy, std::nullopt}}});
  }
  std::unique_ptr<encounter::Method> method(std::string_view name, Hindsight& hindsight) {
    return make_method(name, {.saca = {.forecast = {&car_, &harm_}, .clock = &clock_},
                              .hindsight = &hindsight,
                              .intent = &intent::shipped_model(),
                              .danger = &danger_,
                              .experience = &experience_,
                              .imitators = &imitators_,
                              .untuned = &untuned_,
                              .seed = 1});
  }

  SteadyClock clock_;
  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = shipped_harm();
  memory::Experience experience_;
  learned_danger::Network danger_ =
      learned_danger::Network::from(learned_danger::networks_that_hand_on(), "weights").value();
  Imitators imitators_{
      {"imitation", Imitator::read("models/imitator/compact_rwd_ev.safetensors").value()},
      {"imitation_drivers", Imitator::read("models/imitator/drivers.safetensors").value()}};
  language_model::ScriptedModel untuned_{PolicyId::aeb, clock_};
  scenario::Scenario scenario_;
  encounter::Stage stage_;
};

TEST_F(ComparisonTest, SharedSimulationsGiveWhatEachAloneWouldMeet) {
  const auto script = [] {
    return list(scripted(2.0, PolicyId::aeb), scripted(1.9, PolicyId::aes_left),
                scripted(100.0, PolicyId::aeb), scripted(2.0, PolicyId::no_intervention),
                scripted(2.0, PolicyId::aeb));
  };
  const Comparison together = run(script());
  for (std::size_t i = 0; i < together.runs.size(); ++i) {
    Methods one;
    one.push_back(std::move(script()[i]));
    const MethodRun alone = run(one).runs[0];
    const MethodRun& shared = together.runs[i];
    EXPECT_EQ(shared.harm, alone.harm) << i;
    EXPECT_EQ(shared.clearance, alone.clearance) << i;
    EXPECT_EQ(shared.acted_at, alone.acted_at) << i;
    EXPECT_EQ(shared.plan, alone.plan) << i;
    EXPECT_EQ(shared.met, alone.met) << i;
    EXPECT_EQ(shared.impact_speed, alone.impact_speed) << i;
  }
  EXPECT_EQ(together.runs[0].harm, together.runs[4].harm);
}

TEST_F(ComparisonTest, DoingNothingMeetsTheCarAtFullSpeedAndIsNoIntervention) {
  const Comparison told =
      run(list(scripted(100.0, PolicyId::aeb), scripted(2.0, PolicyId::no_intervention)));
  EXPECT_EQ(told.threat, "car1");
  for (const MethodRun& run : told.runs) {
    EXPECT_EQ(run.met, "car1");
    EXPECT_NEAR(run.impact_speed, 19.0, 1.0);  // speed and wheel are drawn; drag takes a little
    EXPECT_FALSE(run.intervened());
    EXPECT_GT(run.harm, told.best_harm);
  }
}

// T1 = 1.3 s before 60 m at 19 m/s: (60 - 24.7) / 19.
TEST_F(ComparisonTest, TriesEveryPlanFromTheTriggerOn) {
  stage_.chance = {};
  const Comparison told = run(list(scripted(100.0, PolicyId::aeb)));
  ASSERT_TRUE(told.trigger.has_value());
  EXPECT_NEAR(*told.trigger, (60.0 - 1.3 * 19.0) / 19.0, 0.03);
  EXPECT_EQ(told.tried.size(), forecast::all_plans(19.0).size());
  double least = 1e9;
  for (const TriedPlan& tried : told.tried) {
    least = std::min(least, tried.harm.value_or(1e9));
  }
  EXPECT_NEAR(told.best_harm, least, 1e-4);  // a class of harm
}

// The oracle of the batch, and its choice carried out in the closed loop: the same physics by two
// integrators.
TEST_F(ComparisonTest, TheBestInHindsightIsAsGoodWhenItIsCarriedOut) {
  Hindsight hindsight(car_, harm_);
  Methods methods =
      list(method("oracle", hindsight), method("aeb", hindsight), method("nothing", hindsight));
  const Comparison told = compare(stage_, methods, hindsight).value();
  EXPECT_NEAR(told.runs[0].harm, told.best_harm, 0.003);
  EXPECT_EQ(told.runs[0].acted_at, told.trigger);
  EXPECT_EQ(told.runs[1].acted_at, told.trigger);
  EXPECT_LE(told.runs[0].harm, told.runs[1].harm + 0.003);
  EXPECT_GT(told.runs[2].harm, told.runs[0].harm);
}

TEST_F(ComparisonTest, ASecondPlanIsASwitchAndTheFirstIsKept) {
  Methods methods;
  methods.push_back(std::make_unique<Scripted>(std::vector<std::pair<double, manoeuvre::Plan>>{
      {1.0, {PolicyId::aeb, std::nullopt}}, {1.5, {PolicyId::no_intervention, std::nullopt}}}));
  const MethodRun run = ComparisonTest::run(methods).runs[0];
  EXPECT_EQ(run.plan->policy, PolicyId::aeb);
  EXPECT_NEAR(*run.acted_at, 1.0, 1e-9);
  EXPECT_EQ(run.switches, 1);
}

// What was done first, not what was decided first: doing nothing may become anything later.
TEST_F(ComparisonTest, ThePlanIsThatWithWhichItFirstIntervened) {
  Methods methods;
  methods.push_back(std::make_unique<Scripted>(std::vector<std::pair<double, manoeuvre::Plan>>{
      {1.0, manoeuvre::doing_nothing}, {1.3, {PolicyId::t_drift_left, std::nullopt}}}));
  const MethodRun run = ComparisonTest::run(methods).runs[0];
  EXPECT_EQ(run.plan->policy, PolicyId::t_drift_left);
  EXPECT_NEAR(*run.acted_at, 1.3, 1e-9);
  EXPECT_EQ(run.switches, 1);
}

// Who acts long before T1 leaves nobody to find it; what he is held against is the same.
TEST_F(ComparisonTest, WhatAllAreHeldAgainstDoesNotDependOnWhoTheyAre) {
  const Comparison alone = run(list(scripted(0.5, PolicyId::aes_left)));
  const Comparison beside =
      run(list(scripted(0.5, PolicyId::aes_left), scripted(100.0, PolicyId::aeb)));
  ASSERT_TRUE(beside.trigger.has_value());
  EXPECT_EQ(alone.trigger, beside.trigger);
  EXPECT_EQ(alone.threat, beside.threat);
  EXPECT_EQ(alone.woke, beside.woke);
  EXPECT_EQ(alone.tried.size(), beside.tried.size());
  EXPECT_EQ(alone.best, beside.best);
  EXPECT_EQ(alone.best_harm, beside.best_harm);
  EXPECT_EQ(alone.runs[0].harm, beside.runs[0].harm);
  EXPECT_EQ(alone.runs.size(), 1U);
}

// T1 never comes where nothing is near enough for it.
TEST_F(ComparisonTest, WhereT1NeverComesTheBestIsDoingNothing) {
  stage_.thresholds.trigger = -1.0;
  const Comparison told = run(list(scripted(100.0, PolicyId::aeb)));
  ASSERT_EQ(told.trigger, std::nullopt);
  ASSERT_GT(told.runs[0].harm, 0.0);
  EXPECT_EQ(told.best_harm, told.runs[0].harm);
  EXPECT_EQ(told.published_best_harm, told.runs[0].harm);
}

TEST_F(ComparisonTest, AMethodThatThrowsIsNotedAndTheOthersGoOn) {
  Methods methods = list(std::unique_ptr<encounter::Method>(std::make_unique<Throwing>()),
                         scripted(2.0, PolicyId::aeb));
  const Comparison told = run(methods);
  EXPECT_EQ(told.runs[0].fault, "no idea");
  EXPECT_FALSE(told.runs[0].intervened());
  EXPECT_EQ(told.runs[1].fault, "");
  EXPECT_TRUE(told.runs[1].intervened());
}

TEST_F(ComparisonTest, AnEncounterThatCannotBePlayedSaysWhy) {
  scenario_.actors[0].mass = -1.0;
  Hindsight hindsight(car_, harm_);
  const auto told = compare(stage_, list(scripted(2.0, PolicyId::aeb)), hindsight);
  ASSERT_FALSE(told.has_value());
  EXPECT_THAT(told.error().message, testing::HasSubstr("a scene must hold"));
}

TEST_F(ComparisonTest, OnAFreeRoadNothingTriggersAndNobodyIsHarmed) {
  scenario_.actors.clear();
  Hindsight hindsight(car_, harm_);
  Methods methods;
  std::vector<std::string_view> names;
  for (const MethodInfo& info : eval::methods()) {
    methods.push_back(method(info.name, hindsight));
  }
  const Comparison told = compare(stage_, methods, hindsight).value();
  EXPECT_EQ(told.trigger, std::nullopt);
  EXPECT_TRUE(told.tried.empty());
  for (const MethodRun& run : told.runs) {
    EXPECT_EQ(run.harm, 0.0);
    EXPECT_FALSE(run.intervened());
    EXPECT_EQ(run.fault, "");
  }
}

}  // namespace
}  // namespace saca::eval::comparison_test
