#include "saca/thinking/language_model/reply.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace saca::language_model::reply_test {
namespace {

using manoeuvre::PolicyId;

TEST(LikeliestPolicy, OfEqualsIsTheFirst) {
  Answer answer;
  answer.probability = {0.1, 0.3, 0.0, 0.0, 0.2, 0.3, 0.1, 0.0};
  EXPECT_EQ(likeliest_policy(answer), PolicyId::aes_left);
  answer.probability = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0};
  EXPECT_EQ(likeliest_policy(answer), PolicyId::no_intervention);
}

TEST(StatedPolicy, IsTheLastOneNamed) {
  EXPECT_EQ(stated_policy("Scenario Analysis\n1. x\nResponse to user: 6"), PolicyId::t_drift_right);
  EXPECT_EQ(stated_policy("Response to user: 6\nResponse to user:0\n"), PolicyId::aeb);
  EXPECT_EQ(stated_policy("Response to user:  3."), PolicyId::es_b_left);
}

TEST(StatedPolicy, IsNoneWithoutOneDigitOfEight) {
  for (const char* text :
       {"", "6", "Response to user:", "Response to user: ", "Response to user: 8",
        "Response to user: 12", "Response to user: -1", "Response to user: six",
        "Response to user: 1.5", "Response to user: 3rd", "response to user: 3"}) {
    EXPECT_EQ(stated_policy(text), std::nullopt) << text;
  }
}

TEST(StatedSoFar, LooksPastAnAnswerThatIsOnlyBegun) {
  EXPECT_EQ(stated_so_far("Response to user: 6\nResponse to user:"), PolicyId::t_drift_right);
  EXPECT_EQ(stated_so_far("Response to user: 6\nResponse to user:  "), PolicyId::t_drift_right);
  EXPECT_EQ(stated_so_far("Response to user: 6\nResponse to us"), PolicyId::t_drift_right);
  EXPECT_EQ(stated_so_far("Response to user: 6\nResponse to user: 0"), PolicyId::aeb);
  EXPECT_EQ(stated_so_far("Response to user: 6\nResponse to user: 9"), std::nullopt);
  EXPECT_EQ(stated_so_far("Response to user: "), std::nullopt);
  EXPECT_EQ(stated_so_far(""), std::nullopt);
}

TEST(AnswerKind, NamesAreReadBack) {
  for (const auto kind : {Answer::Kind::first, Answer::Kind::ended, Answer::Kind::forced}) {
    EXPECT_EQ(answer_kind_from(name(kind)), kind);
  }
  EXPECT_EQ(name(Answer::Kind::ended), "ended");
  EXPECT_EQ(answer_kind_from("free"), std::nullopt);
}

std::string finished(const std::string& text, Answer::Kind kind) {
  return std::string(finished_part({.reasoning = text, .answers = {{}, {.kind = kind}}}));
}

TEST(FinishedPart, IsTheWholeSentencesOfWhatWasCut) {
  const std::string text = "1. truck1 is 16.0 m ahead. AEB is clear by 0.";
  EXPECT_EQ(finished(text, Answer::Kind::ended), text);
  EXPECT_EQ(finished(text, Answer::Kind::forced), "1. truck1 is 16.0 m ahead.");
  EXPECT_EQ(finished(text, Answer::Kind::first), "1. truck1 is 16.0 m ahead.");
  EXPECT_EQ(finished("So.\n2. AEB", Answer::Kind::forced), "So.\n");
  EXPECT_EQ(finished("harm 0.0125. AEB", Answer::Kind::forced), "");
  EXPECT_EQ(finished("It is so.", Answer::Kind::forced), "It is so.");
  EXPECT_EQ(finished("", Answer::Kind::forced), "");
  EXPECT_EQ(finished_part({.reasoning = "It is", .answers = {}}), "");
}

TEST(Reply, AnythingCanBeRead) {
  std::mt19937 random(7);
  const std::string alphabet = "0123456789.. :-\n\rRespontus ABN\xff\xc3policy";
  std::uniform_int_distribution<std::size_t> letter(0, alphabet.size() - 1);
  std::uniform_int_distribution<int> length(0, 60);
  for (int i = 0; i < 5000; ++i) {
    std::string text;
    for (int k = length(random); k > 0; --k) {
      text += alphabet[letter(random)];
    }
    const auto stated = stated_policy("Response to user:" + text);
    // Whatever else stands there, only a digit of eight is an answer.
    EXPECT_TRUE(!stated ||
                text.find(static_cast<char>('0' + manoeuvre::index(*stated))) != std::string::npos)
        << text;
  }
}

}  // namespace
}  // namespace saca::language_model::reply_test
