#include "saca/reason/reply.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace saca::reason {
namespace {

using manoeuvre::PolicyId;

constexpr const char* prompt =
    "velocity=(14.0, 0.0) m/s, grip=0.90\n"
    "truck1: 16.0 m ahead, 6.4 m left, TTC 1.3 s, risk 0.94\n"
    "0 AEB: hits truck1 with its front at 2.7 m/s, harm 0.0010\n"
    "7 NI: hits truck1 with its front at 15.9 m/s, harm 0.0500\n";

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

TEST(Faithful, CountsTheNumbersThatStandInThePrompt) {
  EXPECT_EQ(faithful_share("Truck at 16.0 m ahead, moving at 7.5 m/s.", prompt), 0.5);
  EXPECT_EQ(faithful_share("TTC is 1.3 s.", prompt), 1.0);
  EXPECT_EQ(faithful_share("TTC = 16/14 = 1.14", prompt), 2.0 / 3.0);
}

TEST(Faithful, ComparesByValueWithoutRounding) {
  EXPECT_EQ(faithful_share("at 14 m/s", prompt), 1.0);
  EXPECT_EQ(faithful_share("at 014.00 m/s", prompt), 1.0);
  EXPECT_EQ(faithful_share("at 14.01 m/s", prompt), 0.0);
  EXPECT_EQ(faithful_share("at 1.4 m/s", prompt), 0.0);
  EXPECT_EQ(faithful_share("at 140 m/s", prompt), 0.0);
}

TEST(Faithful, NamesLabelsAndChoicesAreNoNumbers) {
  EXPECT_EQ(faithful_share("1. truck1 comes.\n2) Policy 5 or action 6\n- 3 T-D-R\n"
                           "Response to user: 6",
                           prompt),
            std::nullopt);
  EXPECT_EQ(faithful_share("", prompt), std::nullopt);
}

// The 7 of the line "7 NI" numbers the line: it does not make every quoted 7 true.
TEST(Faithful, LabelsOfThePromptMakeNothingTrue) {
  EXPECT_EQ(faithful_share("It is 7 m away.", prompt), 0.0);
  EXPECT_EQ(faithful_share("It is 1 m away.", prompt), 0.0);  // only "truck1"
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
    (void)stated_policy("Response to user:" + text);
    const auto share = faithful_share(text, prompt);
    EXPECT_TRUE(!share || (*share >= 0.0 && *share <= 1.0)) << text;
    // What is quoted from a text is found in it.
    const auto own = faithful_share(text, text);
    EXPECT_TRUE(!own || *own == 1.0) << text;
  }
}

}  // namespace
}  // namespace saca::reason
