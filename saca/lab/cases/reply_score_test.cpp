#include "saca/lab/cases/reply_score.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/thinking/language_model/example_situation.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/scripted_model.h"

namespace saca::cases::reply_score_test {
namespace {

using manoeuvre::index;
using manoeuvre::PolicyId;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

eval::Probabilities sure_of(PolicyId policy) {
  eval::Probabilities answer{};
  answer.fill(0.01);
  answer.at(index(policy)) = 0.93;
  return answer;
}

/// AEB, ES-B-L and AES-L are admissible; AES-L is the best in truth, ES-B-R unforeseen better.
ExampleReply reply(PolicyId said) {
  ExampleReply one;
  one.example = {.record = "fars_1", .family = "rear_end"};
  one.example.forecast = {0.101, 0.1, 0.4, 0.1, 0.3, std::nullopt, std::nullopt, 0.9};
  one.example.known = {0.2, 0.05, 0.4, 0.1, 0.0, std::nullopt, std::nullopt, 0.9};
  for (const PolicyId policy : {PolicyId::aeb, PolicyId::aes_left, PolicyId::es_b_left}) {
    one.example.admissible.set(index(policy));
  }
  one.example.choice = PolicyId::aes_left;
  one.first = sure_of(PolicyId::aeb);
  one.last = sure_of(said);
  one.ended = true;
  one.tokens = 80;
  return one;
}

const ReplyChoice& of(const ReplyScore& score, std::string_view key) {
  for (const ReplyChoice& one : score.choices) {
    if (one.key == key) {
      return one;
    }
  }
  throw ContractViolation("no such choice");
}

TEST(ReplyScoreTest, EachWayToChooseIsWorthTheHarmThatItIsKnownToDo) {
  const std::vector<ExampleReply> replies(4, reply(PolicyId::aes_left));
  const ReplyScore score = reply_score(replies, 1);
  EXPECT_EQ(score.examples, 4);
  EXPECT_EQ(score.known, 4);
  const auto harm = [&](std::string_view key) { return of(score, key).harm.value; };
  EXPECT_DOUBLE_EQ(harm("model_at_once"), 0.2);
  EXPECT_DOUBLE_EQ(harm("model"), 0.05);
  EXPECT_DOUBLE_EQ(harm("forecast"), 0.1);  // of two with 0.1 the milder
  EXPECT_DOUBLE_EQ(harm("rule_within"), 0.2);
  EXPECT_DOUBLE_EQ(harm("mildest_within"), 0.2);
  EXPECT_DOUBLE_EQ(harm("expert"), 0.05);
  EXPECT_DOUBLE_EQ(harm("aeb"), 0.2);
  EXPECT_DOUBLE_EQ(harm("best_within"), 0.05);
  EXPECT_DOUBLE_EQ(of(score, "model").regret.value, 0.05);  // ES-B-R harms nobody
  EXPECT_DOUBLE_EQ(of(score, "model").best_within.value, 1.0);
  EXPECT_DOUBLE_EQ(of(score, "forecast").best_within.value, 0.0);
  EXPECT_DOUBLE_EQ(of(score, "model").above_rule.value, 0.05 - 0.2);
  EXPECT_EQ(of(score, "model").above_rule.n, 4);
}

TEST(ReplyScoreTest, WhoChoosesWhatCannotBeDrivenBrakes) {
  const std::vector<ExampleReply> replies{reply(PolicyId::t_drift_left)};
  const ReplyScore score = reply_score(replies, 1);
  EXPECT_DOUBLE_EQ(of(score, "model").harm.value, 0.2);
  EXPECT_DOUBLE_EQ(of(score, "model").admissible.value, 0.0);
  EXPECT_DOUBLE_EQ(of(score, "model_within").admissible.value, 1.0);
}

TEST(ReplyScoreTest, WithoutAnAnswerItBrakes) {
  ExampleReply silent = reply(PolicyId::aes_left);
  silent.first.reset();
  silent.last.reset();
  silent.ended = false;
  const ReplyScore score = reply_score(std::vector{silent}, 1);
  EXPECT_DOUBLE_EQ(of(score, "model").harm.value, 0.2);
  EXPECT_DOUBLE_EQ(of(score, "model_within").harm.value, 0.2);
  EXPECT_DOUBLE_EQ(score.ended, 0.0);
  EXPECT_FALSE(score.calibration);
}

TEST(ReplyScoreTest, InTwinsNothingIsToBeDone) {
  ExampleReply braking = reply(PolicyId::aeb);
  braking.example.is_twin = true;
  braking.example.known = {};
  ExampleReply must = braking;  // doing nothing is not admissible: not counted
  braking.example.admissible.set(index(PolicyId::no_intervention));
  ExampleReply resting = braking;
  resting.last = sure_of(PolicyId::no_intervention);
  const ReplyScore score = reply_score(std::vector{braking, resting, must}, 1);
  EXPECT_EQ(score.known, 0);
  EXPECT_EQ(score.needless.n, 2);
  EXPECT_DOUBLE_EQ(score.needless.value, 0.5);
}

TEST(ReplyScoreTest, TextsAreScoredByWhatTheySay) {
  ExampleReply honest = reply(PolicyId::aes_left);
  honest.reasoning =
      "Scenario Analysis\n1. AEB hits car1.\n2. So AES-L: AEB harms more.\nResponse to user:";
  honest.statements = 3;
  ExampleReply wrong = reply(PolicyId::aeb);
  wrong.reasoning = honest.reasoning;
  wrong.statements = 1;
  wrong.false_statements = 1;
  wrong.unfounded = true;
  wrong.tokens = 60;
  honest.shown = language_model::Explanation::From::model;
  honest.shown_at_last = honest.shown;
  wrong.shown_at_last = language_model::Explanation::From::model_in_part;  // in a further try
  const ReplyScore score = reply_score(std::vector{honest, wrong}, 1);
  EXPECT_DOUBLE_EQ(score.agrees, 0.5);
  EXPECT_DOUBLE_EQ(score.true_statements, 0.75);
  EXPECT_DOUBLE_EQ(score.true_replies, 0.5);
  EXPECT_DOUBLE_EQ(score.unfounded, 0.5);
  EXPECT_DOUBLE_EQ(score.statements, 2.0);
  EXPECT_DOUBLE_EQ(score.shown, 0.5);
  EXPECT_DOUBLE_EQ(score.shown_in_part, 0.0);
  EXPECT_DOUBLE_EQ(score.shown_at_last, 1.0);
  EXPECT_THAT(score.tokens, ElementsAre(60, 80));
}

// Right in three of four with 93 %: what is said is how often it is so at 75 %.
TEST(ReplyScoreTest, SaysByHowMuchAnswersAreTooSure) {
  std::vector<ExampleReply> replies(3, reply(PolicyId::aes_left));
  replies.push_back(reply(PolicyId::aeb));
  const ReplyScore score = reply_score(replies, 1);
  ASSERT_TRUE(score.calibration);
  EXPECT_GT(score.calibration->temperature, 1.2);
  EXPECT_LT(score.calibration->log_loss, score.calibration->log_loss_now);
}

TEST(ReplyScoreTest, NothingHasNoScore) {
  EXPECT_THROW((void)reply_score({}, 1), ContractViolation);
}

TEST(ExampleReplyTest, TellsWhatWasAnsweredAndHowTrueItIs) {
  const preview::Situation situation = language_model::example_situation();
  ReplyExample example{.record = "r", .family = "f"};
  example.prompt = "0 AEB: clear by 0.6 m, no harm\n";
  language_model::Reply given{.reasoning = "1. AEB hits truck1.\nResponse to user:",
                              .prompt_tokens = 300,
                              .reply_tokens = 12};
  given.answers.push_back({.probability = sure_of(PolicyId::aeb)});
  given.answers.push_back({.probability = sure_of(PolicyId::no_intervention),
                           .kind = language_model::Answer::Kind::ended});
  const ExampleReply one = example_reply(example, given, situation);
  EXPECT_EQ(one.first, sure_of(PolicyId::aeb));
  EXPECT_EQ(one.last, sure_of(PolicyId::no_intervention));
  EXPECT_TRUE(one.ended);
  EXPECT_EQ(one.statements, 1);
  EXPECT_EQ(one.false_statements, 1);
  const auto again = example_reply_from_json(to_json(one));
  ASSERT_TRUE(again.has_value()) << again.error().message;
  EXPECT_EQ(to_json(again.value()), to_json(one));
}

TEST(ExampleReplyTest, BadLinesAreNamed) {
  nlohmann::json good = to_json(reply(PolicyId::aeb));
  const auto problem = [&](const char* key, nlohmann::json value) {
    nlohmann::json bad = good;
    bad[key] = std::move(value);
    return example_reply_from_json(bad).error().message;
  };
  EXPECT_THAT(problem("schema", "saca.reply/1"), HasSubstr("saca.example_reply/2"));
  EXPECT_THAT(problem("first", {0.5}), HasSubstr("first"));
  EXPECT_THAT(problem("tokens", -1), HasSubstr("tokens"));
  EXPECT_THAT(problem("example", nlohmann::json::object()), HasSubstr("schema"));
  EXPECT_THAT(problem("extra", 1), HasSubstr("extra"));
  good["last"] = nullptr;
  EXPECT_TRUE(example_reply_from_json(good).has_value());
}

TEST(ReplyScoreTest, WhatDoesNotHoldIsTriedAgain) {
  ManualClock clock;
  language_model::ScriptedModel model(
      language_model::ScriptedReply{.lines = {{.text = language_model::example_reasons,
                                               .answer = language_model::Answer::Kind::ended}}},
      clock);
  const preview::Situation situation = language_model::example_situation();
  ExampleReply wrong = reply(PolicyId::aeb);
  wrong.example.prompt = language_model::scene_part(situation, std::nullopt, 0.0);
  ExampleReply silent = wrong;
  silent.last.reset();
  const auto anything = [](PolicyId) { return std::string(); };
  EXPECT_EQ(try_again(silent, situation, model, clock, anything), std::nullopt);
  EXPECT_EQ(model.num_asked(), 0);
  EXPECT_EQ(try_again(wrong, situation, model, clock, anything), std::nullopt);
  EXPECT_EQ(wrong.shown_at_last, language_model::Explanation::From::model);
  EXPECT_EQ(wrong.tries, 2);
  EXPECT_EQ(wrong.shown, language_model::Explanation::From::facts);
}

}  // namespace
}  // namespace saca::cases::reply_score_test
