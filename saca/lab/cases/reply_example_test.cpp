#include "saca/lab/cases/reply_example.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "saca/lab/eval/scenes_for_test.h"
#include "saca/thinking/language_model/reply.h"
#include "saca/thinking/language_model/truth.h"

namespace saca::cases::reply_example_test {
namespace {

using manoeuvre::index;
using manoeuvre::PolicyId;
using testing::HasSubstr;

class Examples : public testing::Test {
 protected:
  [[nodiscard]] std::optional<preview::Situation> of(const scenario::Scenario& scenario) const {
    const auto now = at_first_trigger({&scenario, &car_, &harm_, &intent::shipped_model(), {}, {}},
                                      {&car_, &harm_});
    EXPECT_TRUE(now.has_value());
    return now.value() ? std::optional(now.value()->situation) : std::nullopt;
  }

  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = eval::shipped_harm();
};

// Braking needs 49 m and has 28.6 m, to the right is a barrier: the left alone helps.
TEST_F(Examples, TellTheWayThatHelpsAndWhy) {
  const preview::Situation situation = of(eval::only_left_helps()).value();
  const ReplyExample example =
      reply_example({.record = "fars_1", .family = "rear_end"}, situation, std::nullopt, 1).value();
  EXPECT_EQ(manoeuvre::side(example.choice), 1);
  EXPECT_TRUE(example.admissible.test(index(example.choice)));
  EXPECT_FALSE(example.admissible.test(index(PolicyId::aeb)));
  EXPECT_GT(*example.forecast[index(PolicyId::aeb)], 0.01);
  EXPECT_EQ(language_model::stated_policy(example.reply), example.choice);
  EXPECT_TRUE(language_model::truth_of(example.reply, example.prompt, situation, example.choice)
                  .wrong.empty());
  EXPECT_EQ(example.set, set_of_record("fars_1"));
}

TEST_F(Examples, ChooseByWhatIsKnownToHappen) {
  const preview::Situation situation = of(eval::only_left_helps()).value();
  ReplyExample given{.record = "fars_1", .family = "rear_end"};
  given.known.fill(0.0);
  const ReplyExample first = reply_example(given, situation, std::nullopt, 1).value();
  ASSERT_GT(first.admissible.count(), 1U);
  given.known.fill(0.0);
  given.known[index(first.choice)] = 0.5;
  const ReplyExample other = reply_example(given, situation, std::nullopt, 1).value();
  EXPECT_NE(other.choice, first.choice);
  EXPECT_TRUE(other.admissible.test(index(other.choice)));
}

TEST_F(Examples, AreOfEncountersInWhichTheTriggerFires) {
  scenario::Scenario empty = eval::standing_car(20.0, 60.0);
  empty.actors.clear();
  EXPECT_FALSE(of(empty).has_value());
}

TEST_F(Examples, TellOfACase) {
  const preview::Situation situation = of(eval::only_left_helps()).value();
  memory::Case found;
  found.best = PolicyId::aes_left;
  const ReplyExample example = reply_example({.record = "fars_1", .family = "rear_end"}, situation,
                                             PromptCase{found, 0.83}, 1)
                                   .value();
  EXPECT_THAT(example.prompt, HasSubstr("A case 83 % alike"));
}

TEST_F(Examples, ComeBackFromTheirLine) {
  const preview::Situation situation = of(eval::only_left_helps()).value();
  ReplyExample given{.record = "fars_1", .family = "rear_end", .is_twin = true};
  given.known[0] = 0.25;
  const ReplyExample example = reply_example(given, situation, std::nullopt, 1).value();
  const nlohmann::json line = to_json(example);
  const auto read = reply_example_from_json(nlohmann::json::parse(line.dump()));
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(to_json(read.value()), line);
  EXPECT_EQ(read.value().admissible, example.admissible);
  given.by_table = given.known;
  const nlohmann::json with_table =
      to_json(reply_example(given, situation, std::nullopt, 1).value());
  EXPECT_EQ(to_json(reply_example_from_json(with_table).value()), with_table);
  EXPECT_TRUE(with_table.contains("by_table"));
  EXPECT_FALSE(line.contains("by_table"));
}

TEST_F(Examples, OfAnotherFormAreRefusedByKey) {
  const ReplyExample example{.record = "fars_1", .family = "rear_end"};
  const auto why = [&](const std::string& key, const nlohmann::json& value) {
    nlohmann::json line = to_json(example);
    line[key] = value;
    return reply_example_from_json(line).error().message;
  };
  EXPECT_THAT(why("set", "exam"), HasSubstr("set: want train, calibration or test, got \"exam\""));
  EXPECT_THAT(why("choice", 8), HasSubstr("choice"));
  EXPECT_THAT(why("admissible", {9}), HasSubstr("admissible: want policies from 0 to 7, got 9"));
  EXPECT_THAT(why("known", {0.1}), HasSubstr("known: want 8 harms, got 1"));
  EXPECT_THAT(why("known", {-1, 0, 0, 0, 0, 0, 0, 0}), HasSubstr("known: want harms >= 0"));
  EXPECT_THAT(why("more", 1), HasSubstr("more"));
}

// As OpenAI's guide to supervised fine-tuning has it: a list of messages with role and content, the
// assistant's the last.
TEST_F(Examples, AsAChat) {
  const ReplyExample example{.prompt = "what?", .reply = "this"};
  const nlohmann::json chat = chat_json(example, "be brief");
  ASSERT_EQ(chat.size(), 1U);
  const nlohmann::json expected{{{"role", "system"}, {"content", "be brief"}},
                                {{"role", "user"}, {"content", "what?"}},
                                {{"role", "assistant"}, {"content", "this"}}};
  EXPECT_EQ(chat["messages"], expected);
}

// Binomial: of 4,000 names, 70 % with a standard deviation of 29.
TEST(ExampleSets, AreOfTheirShares) {
  std::map<ExampleSet, int> counts;
  for (int i = 0; i < 4000; ++i) {
    ++counts[set_of_record("fars_2016_" + std::to_string(40001 + i))];
  }
  EXPECT_NEAR(counts[ExampleSet::train], 2800, 120);
  EXPECT_NEAR(counts[ExampleSet::calibration], 600, 100);
  EXPECT_NEAR(counts[ExampleSet::test], 600, 100);
}

}  // namespace
}  // namespace saca::cases::reply_example_test
