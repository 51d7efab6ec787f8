#include "saca/lab/eval/methods.h"

#include <gmock/gmock.h>

#include <set>

#include "saca/base/core/contract.h"
#include "saca/lab/eval/comparison.h"
#include "saca/lab/eval/scenes_for_test.h"
#include "saca/lab/learned_danger/networks_for_test.h"
#include "saca/lab/sim/stepper.h"
#include "saca/thinking/intent/shipped_model.h"
#include "saca/thinking/language_model/scripted_model.h"

namespace saca::eval::methods_test {
namespace {

using manoeuvre::PolicyId;

class MethodsTest : public testing::Test {
 protected:
  /// Of the methods whose names begin so.
  std::map<std::string, MethodRun, std::less<>> play(const scenario::Scenario& scenario,
                                                     std::string_view beginning = "",
                                                     bool shares_verdicts = false) {
    const encounter::Stage stage{&scenario, &car_, &harm_, &intent::shipped_model(), {}, {}};
    Hindsight hindsight(car_, harm_);
    MethodTools with = tools(hindsight);
    if (shares_verdicts) {
      with.saca = with_shared_verdicts(with.saca);
    }
    std::vector<std::unique_ptr<encounter::Method>> all;
    std::vector<std::string> names;
    for (const MethodInfo& info : methods()) {
      if (info.needs != Needs::nothing || !info.name.starts_with(beginning)) {
        continue;  // without memory and model they are what SACA is
      }
      names.emplace_back(info.name);
      all.push_back(make_method(info.name, with));
    }
    const Comparison told = compare(stage, all, hindsight).value();
    std::map<std::string, MethodRun, std::less<>> runs;
    for (std::size_t i = 0; i < all.size(); ++i) {
      runs[names[i]] = told.runs[i];
    }
    return runs;
  }

  MethodTools tools(Hindsight& hindsight) {
    return {.saca = {.forecast = {&car_, &harm_}, .clock = &clock_},
            .hindsight = &hindsight,
            .intent = &intent::shipped_model(),
            .seed = 7};
  }

  SteadyClock clock_;
  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = shipped_harm();
};

TEST(Methods, NamesAreDifferentAndFound) {
  std::set<std::string_view> names;
  for (const MethodInfo& info : methods()) {
    EXPECT_TRUE(names.insert(info.name).second);
    EXPECT_EQ(find_method(info.name), &info);
    EXPECT_FALSE(info.what.empty());
  }
  EXPECT_EQ(find_method("magic"), nullptr);
  EXPECT_THROW((void)make_method("magic", {}), ContractViolation);
}

TEST_F(MethodsTest, WhoChoosesBySomethingNeedsIt) {
  Hindsight hindsight(car_, harm_);
  EXPECT_THROW((void)make_method("least_danger", tools(hindsight)), ContractViolation);
  const learned_danger::Network network =
      learned_danger::Network::from(learned_danger::networks_that_hand_on(), "weights").value();
  MethodTools with = tools(hindsight);
  with.danger = &network;
  EXPECT_NE(make_method("least_danger", with), nullptr);
  EXPECT_THROW((void)make_method("beliefs_and_experience", with), ContractViolation);
  const memory::Experience experience;
  with.experience = &experience;
  EXPECT_NE(make_method("beliefs_and_experience", with), nullptr);
  EXPECT_THROW((void)make_method("imitation", with), ContractViolation);
}

// A car brakes ahead.
scenario::Scenario braking_car() {
  scenario::Scenario scenario = standing_car(20.0, 60.0);
  scenario.actors[0].motion = scenario::Script{.start = {.s = 60.0},
                                               .speed = 20.0,
                                               .behaviour = scenario::Behaviour::brake,
                                               .acceleration = 6.0,
                                               .from = 0.5};
  return scenario;
}

TEST_F(MethodsTest, WhoIsUnawareKnowsNoIntentionsAndTellsTheModelOfNoRisks) {
  const scenario::Scenario scenario = braking_car();
  const encounter::Stage stage{&scenario, &car_, &harm_, &intent::shipped_model(), {}, {}};
  Hindsight hindsight(car_, harm_);
  std::vector<std::string> prompts;
  for (const char* const name : {"saca", "saca_no_reach", "saca_unaware", "saca_paper_unaware"}) {
    language_model::ScriptedModel model(PolicyId::aeb, clock_);
    MethodTools with = tools(hindsight);
    with.saca.model = &model;
    std::vector<std::unique_ptr<encounter::Method>> alone;
    alone.push_back(make_method(name, with));
    ASSERT_TRUE(compare(stage, alone, hindsight).has_value());
    ASSERT_GT(model.num_asked(), 0) << name;
    prompts.push_back(model.last_scenes().front());
  }
  EXPECT_THAT(prompts[0], testing::HasSubstr(", risk "));
  EXPECT_THAT(prompts[0], testing::Not(testing::HasSubstr("maintain 0.94")));
  EXPECT_THAT(prompts[1], testing::Not(testing::HasSubstr("maintain 0.94")));
  for (std::size_t i = 1; i < prompts.size(); ++i) {
    EXPECT_THAT(prompts[i], testing::Not(testing::HasSubstr(", risk "))) << i;
    EXPECT_EQ(prompts[i].find("maintain 0.94") != std::string::npos, i > 1)
        << i;  // not 1: preview::cautious
  }
}

TEST_F(MethodsTest, WhoAsksAModelWithoutFineTuningAsksNoOther) {
  const scenario::Scenario scenario = braking_car();
  const encounter::Stage stage{&scenario, &car_, &harm_, &intent::shipped_model(), {}, {}};
  Hindsight hindsight(car_, harm_);
  language_model::ScriptedModel tuned(PolicyId::aeb, clock_);
  language_model::ScriptedModel untuned(PolicyId::aeb, clock_);
  MethodTools with = tools(hindsight);
  with.saca.model = &tuned;
  EXPECT_THROW((void)make_method("saca_untuned", with), ContractViolation);
  with.untuned = &untuned;
  for (const char* const name : {"saca_untuned", "saca_paper_untuned"}) {
    std::vector<std::unique_ptr<encounter::Method>> alone;
    alone.push_back(make_method(name, with));
    const int before = untuned.num_asked();
    ASSERT_TRUE(compare(stage, alone, hindsight).has_value());
    EXPECT_GT(untuned.num_asked(), before) << name;
  }
  EXPECT_EQ(tuned.num_asked(), 0);
}

TEST_F(MethodsTest, WhereOnlyALaneChangeHelpsThoseThatForecastFindIt) {
  const auto runs = play(only_left_helps());
  for (const char* const name :
       {"oracle", "true_atlas", "true_rolled_out", "going_on_atlas", "beliefs_atlas",
        "beliefs_rolled_out", "beliefs_drawn", "saca", "beliefs_and_grip", "beliefs_and_followers",
        "beliefs_and_hidden", "first_forecast", "newest_forecast"}) {
    EXPECT_EQ(manoeuvre::side(runs.at(name).plan->policy), 1) << name;
    EXPECT_LT(runs.at(name).harm, runs.at("aeb").harm) << name;
  }
  EXPECT_EQ(runs.at("saca").source, "arbiter");  // nothing is cached
  EXPECT_EQ(runs.at("saca_paper").source, "fallback");
  EXPECT_EQ(runs.at("saca_paper").plan->policy, PolicyId::aeb);
  EXPECT_EQ(runs.at("saca_paper").harm, runs.at("aeb").harm);
  EXPECT_GT(runs.at("nothing").harm, runs.at("aeb").harm);
  // Rules that brake for what stands ahead do it before T1 at this speed.
  for (const char* const name : {"r157", "rss", "fsm"}) {
    EXPECT_LT(*runs.at(name).acted_at, *runs.at("aeb").acted_at) << name;
  }
}

// A wreck 1 s ahead that is not confirmed sets off no baseline that triggers as SACA does.
TEST_F(MethodsTest, WhoIsNotConfirmedSetsOffNobody) {
  const UnseenTruth truth;
  scenario::Scenario near_wreck = standing_car(20.0, 20.0);
  const world::Scene scene = sim::Stepper(near_wreck, truth.car).scene();
  for (const bool confirmed : {false, true}) {
    Hindsight hindsight(car_, harm_);
    const auto method = make_method("aeb", tools(hindsight));
    EXPECT_EQ(
        truth.step(*method, scene, confirmed ? reflex::all_actors : reflex::ActorSet()).has_value(),
        confirmed);
  }
}

TEST_F(MethodsTest, NobodyActsForWhoDrivesAway) {
  scenario::Scenario scenario = standing_car(15.0, 60.0);
  scenario.actors[0].motion = scenario::Script{
      .start = {.s = 80.0}, .speed = 20.0, .behaviour = scenario::Behaviour::constant_velocity};
  for (const auto& [name, run] : play(scenario)) {
    EXPECT_FALSE(run.intervened()) << name;
    EXPECT_EQ(run.fault, "") << name;
  }
}

TEST_F(MethodsTest, VerdictsAreSharedOnlyByWhoWouldWorkOutTheSame) {
  const scenario::Scenario scenario = braking_car();
  const auto shared = play(scenario, "saca", true);
  for (const auto& [name, run] : play(scenario, "saca")) {
    EXPECT_EQ(run.plan, shared.at(name).plan) << name;
    EXPECT_EQ(run.acted_at, shared.at(name).acted_at) << name;
    EXPECT_EQ(run.harm, shared.at(name).harm) << name;
  }
}

TEST_F(MethodsTest, ChanceIsTheSeeds) {
  const scenario::Scenario scenario = standing_car(15.0, 60.0);
  EXPECT_EQ(play(scenario).at("random").plan, play(scenario).at("random").plan);
}

}  // namespace
}  // namespace saca::eval::methods_test
