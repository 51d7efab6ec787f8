#include "saca/lab/cases/model_replies.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "saca/lab/cases/cases_for_test.h"
#include "saca/thinking/language_model/scripted_model.h"

namespace saca::cases::model_replies_test {
namespace {

using language_model::ScriptedModel;
using language_model::ScriptedReply;
using manoeuvre::PolicyId;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<CrashCase> many_cases() {
  std::vector<CrashCase> cases;
  for (int i = 0; i < 40; ++i) {
    cases.push_back({});
    cases.back().record.name = "fars_" + std::to_string(i);
  }
  return cases;
}

TEST(ModelReplies, CasesAreDrawnByLotWhateverTheirOrder) {
  std::vector<CrashCase> cases = many_cases();
  const auto all = records_of(cases_by_lot(cases, ExampleSet::test, 0, "a.jsonl").value());
  EXPECT_TRUE(std::all_of(all.begin(), all.end(), [](const std::string& record) {
    return set_of_record(record) == ExampleSet::test;
  }));
  ASSERT_GT(all.size(), 2U);
  std::reverse(cases.begin(), cases.end());
  EXPECT_THAT(records_of(cases_by_lot(cases, ExampleSet::test, 2, "a.jsonl").value()),
              ElementsAre(all[0], all[1]));
  EXPECT_EQ(cases_by_lot({}, ExampleSet::train, 5, "a.jsonl").error().message,
            "a.jsonl: want cases of the train set, got none");
}

TEST(ModelReplies, AreToldInTheOrderOfTheFile) {
  std::vector<ExampleReply> replies(3);
  replies[0].example.record = "c";
  replies[1].example.record = "a";
  replies[2].example.record = "c";
  replies[2].example.is_twin = true;
  sort_as_in_file(replies, {"a", "b", "c"});
  EXPECT_EQ(replies[0].example.record, "a");
  EXPECT_FALSE(replies[1].example.is_twin);
  EXPECT_TRUE(replies[2].example.is_twin);
  EXPECT_THAT(replies_text(replies),
              testing::StartsWith("{\"replies\":3,\"schema\":\"saca.example_replies/2\"}\n"));
  EXPECT_EQ(replies_text({}), "{\"replies\":0,\"schema\":\"saca.example_replies/2\"}\n");
}

class Asking : public testing::Test {
 protected:
  Asking() {
    source_.cases = {case_by_hand()};
    source_.tools = shipped().tools();
    std::filesystem::remove_all(std::filesystem::path(work_.journal).parent_path());
  }

  ExampleSource source_;
  ManualClock clock_;
  ReplyWork work_{.journal = testing::TempDir() + "/model_replies/" +
                             testing::UnitTest::GetInstance()->current_test_info()->name() +
                             "/journal",
                  .title = "saca cases eval",
                  .display = long_work::ProgressDisplay::silent};
};

TEST_F(Asking, TakesWhatTheModelSaysAndAsksNoMoreThanOnce) {
  ScriptedModel model(PolicyId::aes_left, clock_);
  const auto all = model_replies(source_, model, clock_, work_).value().value();
  ASSERT_FALSE(all.items.empty());
  EXPECT_TRUE(all.problems.empty());
  EXPECT_GT(all.items[0].first->at(manoeuvre::index(PolicyId::aes_left)), 0.9);
  const int asked = model.num_asked();
  EXPECT_EQ(model_replies(source_, model, clock_, work_).value()->items.size(), all.items.size());
  EXPECT_EQ(model.num_asked(), asked) << "the journal knows it";
}

TEST_F(Asking, StopsWhereTheModelCannotBeReached) {
  ScriptedModel model(ScriptedReply{.error = Error{Error::Code::unreadable, "it is gone"}}, clock_);
  EXPECT_EQ(model_replies(source_, model, clock_, work_).error().message,
            "--llm: it is gone (in case fars_2016_40001; the same command goes on there)");
}

TEST_F(Asking, WhatIsNoAnswerIsAProblemOfTheCase) {
  ScriptedModel model(ScriptedReply{.error = Error{Error::Code::malformed, "no answer"}}, clock_);
  const auto all = model_replies(source_, model, clock_, work_).value().value();
  EXPECT_TRUE(all.items.empty());
  EXPECT_THAT(all.problems, ElementsAre("fars_2016_40001: no answer"));
}

// A model that answers nothing is not asked again: the grammars are those of the first question.
TEST_F(Asking, HoldsRepliesToWhatIsTrueUnlessToldNotTo) {
  ScriptedModel model(ScriptedReply{.error = Error{Error::Code::malformed, "no answer"}}, clock_);
  ASSERT_TRUE(model_replies(source_, model, clock_, work_).has_value());
  EXPECT_FALSE(model.last_grammars().empty());
  EXPECT_THAT(model.last_grammars(), testing::Each(testing::StartsWith("root ::= ")));
  std::filesystem::remove_all(work_.journal);
  work_.constrained = false;
  ASSERT_TRUE(model_replies(source_, model, clock_, work_).has_value());
  EXPECT_FALSE(model.last_grammars().empty());
  EXPECT_THAT(model.last_grammars(), testing::Each(std::string()));
}

}  // namespace
}  // namespace saca::cases::model_replies_test
