#include "saca/lab/encounter/thinking_figures.h"

#include <gtest/gtest.h>

namespace saca::encounter::thinking_figures_test {
namespace {

using arbitration::Preview;
using manoeuvre::Plan;
using manoeuvre::PolicyId;
using reflex::Source;

constexpr Plan left{PolicyId::aes_left, std::nullopt};

Preview remembered(memory::Gate gate) {
  Preview one;
  one.nearest.emplace();
  one.gate = gate;
  return one;
}

Preview answered(language_model::Answer::Kind kind) {
  Preview one;
  one.reply.answers = {{.probability = {1.0}}, {.probability = {0.25, 0.75}, .kind = kind}};
  one.plan = left;
  one.source = Source::model;
  return one;
}

TEST(ThinkingFigures, CountWhatWasThought) {
  std::vector<Preview> all{remembered(memory::Gate::check), remembered(memory::Gate::reason),
                           answered(language_model::Answer::Kind::ended),
                           answered(language_model::Answer::Kind::forced), Preview{}};
  all[0].plan = left;
  all[0].source = Source::memory;
  all[2].truth =
      language_model::Truth{.num_checked = 3, .wrong = {{"it is wet", "it is dry", true}}};
  all[4].unheard = true;
  EXPECT_EQ(thinking_figures(all, std::nullopt), (ThinkingFigures{.forecasts = 5,
                                                                  .recalled = 1,
                                                                  .from_memory = 1,
                                                                  .from_model = 2,
                                                                  .asked = 3,
                                                                  .answered = 2,
                                                                  .ended = 1,
                                                                  .statements = 3,
                                                                  .false_statements = 1,
                                                                  .unfounded = 1,
                                                                  .answer = std::nullopt,
                                                                  .expected = std::nullopt}));
}

TEST(ThinkingFigures, KeepWhatTheVerdictExpected) {
  reflex::Verdict verdict;
  verdict.plans.push_back({.plan = manoeuvre::full_braking, .drivable = true, .harm = 0.3});
  verdict.plans.push_back({.plan = left, .drivable = true, .harm = 0.1});
  reflex::Decision decision{.plan = left, .verdict = verdict, .time = 4.5};
  EXPECT_EQ(thinking_figures({}, decision).expected, (ExpectedAtDecision{4.5, left, 0.1, 0.3, 1}));
  decision.verdict->plans[0].harm = 0.101;  // as good
  EXPECT_EQ(thinking_figures({}, decision).expected->num_admissible, 2);
  decision.plan.policy = PolicyId::t_drift_left;  // nothing is said of it
  EXPECT_EQ(thinking_figures({}, decision).expected, std::nullopt);
  decision.verdict.reset();
  EXPECT_EQ(thinking_figures({}, decision).expected, std::nullopt);
  EXPECT_EQ(thinking_figures({}, std::nullopt).expected, std::nullopt);
}

TEST(ThinkingFigures, KeepTheAnswerAboutTheForecastThatCame) {
  std::vector<Preview> all{Preview{}, answered(language_model::Answer::Kind::ended)};
  all[0].number = 7;  // those before are forgotten
  all[1].number = 8;
  EXPECT_EQ(thinking_figures(all, reflex::Decision{.preview = 8}).answer->at(1), 0.75);
  EXPECT_EQ(thinking_figures(all, reflex::Decision{.preview = 7}).answer, std::nullopt);
  EXPECT_EQ(thinking_figures(all, reflex::Decision{.preview = 1}).answer, std::nullopt);
  EXPECT_EQ(thinking_figures(all, reflex::Decision{}).answer, std::nullopt);
}

TEST(ReasonOf, TellsWhyThereWasNoPlan) {
  const reflex::Decision none;
  EXPECT_EQ(reason_of(none, {}), "nothing was forecast before T1");
  std::vector<Preview> all(1);
  EXPECT_EQ(reason_of(none, all), "no plan is cached");
  all.push_back(remembered(memory::Gate::reason));
  EXPECT_EQ(reason_of(none, all), "no case in memory is alike");
  all[0].unheard = true;
  EXPECT_EQ(reason_of(none, all), "the model gave no answer in time");
  all[1].check = arbitration::Check{.passed = false};
  EXPECT_EQ(reason_of(none, all), "what was proposed did not pass its check");
  all[0].plan = left;
  EXPECT_EQ(reason_of(none, all), "the plan was not ready at T1");
}

TEST(ReasonOf, TellsWhatBecameOfAPlan) {
  EXPECT_EQ(reason_of({.source = Source::memory, .similarity = 0.95}, {}), "a cached plan matches");
  EXPECT_EQ(reason_of({.similarity = 0.5}, {}), "no cached plan matches above 90 %");
  EXPECT_EQ(reason_of({.similarity = 0.95, .not_admissible = true}, {}),
            "the plan that matches is not admissible");
  EXPECT_EQ(reason_of({.source = Source::arbiter, .similarity = 0.95}, {}),
            "doing nothing is as good as the plan that matches");
  EXPECT_EQ(reason_of({.source = Source::arbiter, .similarity = 0.5}, {}),
            "no cached plan matches above 90 %");
}

}  // namespace
}  // namespace saca::encounter::thinking_figures_test
