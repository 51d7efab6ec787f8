#include "saca/lab/eval/model_score.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/lab/eval/scenes_for_test.h"
#include "saca/thinking/language_model/scripted_model.h"

namespace saca::eval::model_score_test {
namespace {

using language_model::Answer;
using manoeuvre::PolicyId;

/// Sure of braking at once, of a lane change to the left after reasoning; without our facts sure of
/// doing nothing.
language_model::ScriptedReply wavering(const std::string& prompt) {
  const bool facts = prompt.find("Least harm:") != std::string::npos;
  const PolicyId last = facts ? PolicyId::aes_left : PolicyId::no_intervention;
  return {
      .lines = {
          {.answer = Answer::Kind::first, .policy = PolicyId::aeb},
          {.text = "because", .answer = Answer::Kind::ended, .policy = last, .probability = 0.79}}};
}

const MethodFigures& figures_of(const ModelScore& score, std::string_view key) {
  for (std::size_t i = 0; i < score.choices.size(); ++i) {
    if (scored_choices()[i].key == key) {
      return score.choices[i];
    }
  }
  throw std::runtime_error("no such choice");
}

TEST(ScoredChoices, AreMethods) {
  ASSERT_EQ(scored_methods().size(), scored_choices().size());
  for (const std::string& method : scored_methods()) {
    EXPECT_NE(find_method(method), nullptr) << method;
  }
}

// What only a lane change to the left avoids: what was carried out counts, not what was said.
TEST(ModelScore, IsOfWhatWasCarriedOut) {
  SteadyClock clock;
  const manoeuvre::Car car = prepare::default_car();
  const collision::HarmModel harm = shipped_harm();
  language_model::ScriptedModel model(&wavering, clock);
  const std::vector<SuiteRow> rows{run_encounter(
      {.number = 0, .family = "made", .scenario = only_left_helps(), .twin = {}},
      {.methods = scored_methods(), .exact = true},
      {.forecast = {&car, &harm}, .model = &model, .clock = &clock}, intent::shipped_model())};
  ASSERT_EQ(rows[0].fault, "");
  const ModelScore score = model_score(rows, 1);
  const auto harm_of = [&](const char* key) { return figures_of(score, key).harm.value; };
  EXPECT_EQ(harm_of("facts_at_once"), harm_of("always_aeb"));
  EXPECT_LT(harm_of("facts_reasoned"), harm_of("always_aeb"));
  EXPECT_EQ(harm_of("facts_checked"), harm_of("facts_reasoned"));
  EXPECT_EQ(harm_of("no_facts_at_once"), harm_of("always_aeb"));
  EXPECT_GT(harm_of("no_facts_reasoned"), harm_of("always_aeb"));  // it does nothing
  EXPECT_EQ(figures_of(score, "best_in_hindsight").right.value, 1.0);
  EXPECT_EQ(figures_of(score, "facts_at_once").thinking->statements, 0);
  EXPECT_EQ(figures_of(score, "facts_at_once").sources.at("model"), 1);

  // The left was given 0.79: sharper is better, as far as it goes.
  ASSERT_TRUE(score.calibration.has_value());
  EXPECT_EQ(score.calibration->count, 1);
  EXPECT_LT(score.calibration->temperature, 1.0);
  EXPECT_LT(score.calibration->log_loss, score.calibration->log_loss_now);
  EXPECT_LE(score.calibration->log_loss_now, -std::log(0.79) + 1e-9);  // others may be right, too
}

TEST(ModelScore, WantsSomethingThatWasPlayed) {
  SuiteRow row;
  row.fault = "it could not be played";
  EXPECT_THROW((void)model_score({&row, 1}, 1), ContractViolation);
}

}  // namespace
}  // namespace saca::eval::model_score_test
