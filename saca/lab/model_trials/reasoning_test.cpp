#include "saca/lab/model_trials/reasoning.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "saca/base/core/file.h"
#include "saca/lab/installation/here_for_test.h"
#include "saca/thinking/language_model/replay_model.h"

namespace saca::model_trials::reasoning_test {
namespace {

using testing::HasSubstr;

class ReasoningTest : public testing::Test {
 protected:
  ReasoningTest() {
    language_model::RecordedReplies none{.model = "recorded", .replies = {}};
    EXPECT_EQ(write_file(replies_, language_model::json_text(none)), std::nullopt);
  }
  ~ReasoningTest() override { std::filesystem::remove(replies_); }

  const std::filesystem::path replies_ =
      std::filesystem::path(testing::TempDir()) / "reasoning_replies.json";
  SteadyClock clock_;
};

TEST_F(ReasoningTest, PointsToWhatItHolds) {
  const auto opened = open_reasoning(installation::here_for_test(), "intersection_t1",
                                     "replay:" + replies_.string(), clock_);
  ASSERT_TRUE(opened.has_value()) << opened.error().message;
  const Reasoning& all = *opened.value();
  EXPECT_EQ(all.tools.car, &all.inputs.car);
  EXPECT_EQ(all.tools.atlas, &all.atlas);
  EXPECT_EQ(all.tools.danger, &*all.danger);
  EXPECT_FALSE(all.asked.empty());
  EXPECT_NE(all.model, nullptr);
}

TEST_F(ReasoningTest, WithoutAModelThereIsNone) {
  EXPECT_THAT(
      open_reasoning(installation::here_for_test(), "one_way", "off", clock_).error().message,
      HasSubstr("--llm"));
}

}  // namespace
}  // namespace saca::model_trials::reasoning_test
