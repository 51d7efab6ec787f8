#include "saca/lab/cases/opened_examples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "saca/base/core/file.h"
#include "saca/lab/cases/cases_for_test.h"
#include "saca/lab/installation/here_for_test.h"

namespace saca::cases::opened_examples_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class OpenedExamplesTest : public testing::Test {
 protected:
  const installation::Installation here_ = installation::here_for_test();
  const fs::path folder_ = fs::path(testing::TempDir()) / "opened_examples";
  ExampleOptions examples_{.file = (folder_ / "cases.jsonl").string(), .memory = "", .cues = ""};
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    const std::vector<CrashCase> cases{case_by_hand()};
    ASSERT_EQ(write_file(examples_.file, crash_cases_text(cases)), std::nullopt);
  }
  void TearDown() override { fs::remove_all(folder_); }
};

TEST_F(OpenedExamplesTest, AreOfTheFileAndTheCar) {
  const auto opened = open_examples(here_, examples_);
  ASSERT_TRUE(opened.has_value()) << opened.error().message;
  EXPECT_EQ(opened.value().source.cases.size(), 1U);
  EXPECT_EQ(opened.value().source.tools.forecast.car, &opened.value().planes->inputs.car);
  examples_.file = "nowhere.jsonl";
  EXPECT_THAT(open_examples(here_, examples_).error().message, HasSubstr("nowhere.jsonl"));
}

TEST_F(OpenedExamplesTest, SetsAreWrittenWithTheirCard) {
  const ExportRequest request{
      .examples = examples_, .output = (folder_ / "sets").string(), .threads = 1};
  const auto sets = export_sets(here_, request);
  ASSERT_TRUE(sets.has_value()) << sets.error().message;
  ASSERT_TRUE(sets.value().has_value());
  int examples = 0;
  for (const auto& [set, tally] : sets.value()->tallies) {
    examples += tally.examples;
  }
  EXPECT_EQ(examples + static_cast<int>(sets.value()->problems.size()), 2);  // its twin, too
  EXPECT_TRUE(fs::exists(folder_ / "sets/train.jsonl"));
  EXPECT_THAT(command_text(request), HasSubstr("--format local"));
}

TEST_F(OpenedExamplesTest, AModelThatCannotBeAskedIsTold) {
  EvalRequest request{.examples = examples_,
                      .model = "off",
                      .set = "train",
                      .output = (folder_ / "replies.jsonl").string()};
  int asked = 0;  // one of the sets has the case, and there is no model
  for (const char* const set : {"train", "calibration", "test"}) {
    request.set = set;
    const auto replies = evaluate_model(here_, request);
    ASSERT_FALSE(replies.has_value());
    const bool of_the_model = replies.error().message.find("--llm") != std::string::npos;
    asked += of_the_model ? 1 : 0;
    EXPECT_TRUE(of_the_model || replies.error().message.find("cases.jsonl") != std::string::npos);
  }
  EXPECT_EQ(asked, 1);
  request.unconstrained = true;
  EXPECT_THAT(command_text(request), HasSubstr("--unconstrained"));
}

}  // namespace
}  // namespace saca::cases::opened_examples_test
