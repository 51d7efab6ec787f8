#include "saca/lab/network_training/lessons.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <string>

#include "saca/lab/intention_scoring/forecast_file.h"

namespace saca::network_training::lessons_test {
namespace {

using testing::HasSubstr;

intention_scoring::Sequence sequence(const std::string& name, std::size_t num_frames) {
  intention_scoring::Sequence one;
  one.name = name;
  one.observations.resize(num_frames);
  one.labels.resize(num_frames);
  one.scored.resize(num_frames, true);
  return one;
}

intention_scoring::Forecasts forecasts(std::size_t num_frames, double maintains) {
  intention_scoring::Forecasts one;
  for (auto& head : one.at) {
    head.assign(num_frames, {maintains, 1.0 - maintains, 0.0, 0.0, 0.0, 0.0});
  }
  return one;
}

class LessonsTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_FALSE(intention_scoring::write_forecasts(
                     file_, {"trees", {"a", "c"}, {forecasts(3, 0.75), forecasts(2, 0.25)}})
                     .has_value());
  }
  void TearDown() override { std::filesystem::remove(file_); }

  std::filesystem::path file_ = std::filesystem::path(testing::TempDir()) / "saca_lessons.h5";
};

TEST_F(LessonsTest, AreOfEachSequenceThatTheFileTellsOf) {
  const std::vector<intention_scoring::Sequence> all{sequence("c", 2), sequence("b", 4),
                                                     sequence("a", 3)};
  const Lessons lessons = read_lessons(file_, all, {}).value();
  ASSERT_EQ(lessons.forecasts.size(), 3U);
  EXPECT_EQ(lessons.forecasts[0].at[1][1][0], 0.25);
  EXPECT_TRUE(lessons.forecasts[1].at[0].empty());
  EXPECT_EQ(lessons.forecasts[2].at[2][2][0], 0.75);
}

// The mistake that made distillation look better than it is.
TEST_F(LessonsTest, ATeacherThatHasSeenWhatIsHeldOutIsRefused) {
  const std::vector<intention_scoring::Sequence> training{sequence("a", 3)};
  const std::vector<intention_scoring::Sequence> held_out{sequence("b", 4), sequence("c", 2)};
  const auto refused = read_lessons(file_, training, held_out);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Error::Code::malformed);
  EXPECT_THAT(refused.error().message, HasSubstr("saca_lessons.h5"));
  EXPECT_THAT(refused.error().message, HasSubstr("got forecasts of c"));
  EXPECT_TRUE(read_lessons(file_, training, std::span(held_out).first(1)).has_value());
}

TEST_F(LessonsTest, WhoTellsOfNoneOrOfOtherFramesIsRefused) {
  const std::vector<intention_scoring::Sequence> others{sequence("b", 4)};
  EXPECT_THAT(read_lessons(file_, others, {}).error().message, HasSubstr("got none"));
  const std::vector<intention_scoring::Sequence> longer{sequence("a", 5)};
  EXPECT_THAT(read_lessons(file_, longer, {}).error().message, HasSubstr("saca_lessons.h5"));
  EXPECT_EQ(read_lessons("nowhere.h5", others, {}).error().code, Error::Code::unreadable);
}

}  // namespace
}  // namespace saca::network_training::lessons_test
