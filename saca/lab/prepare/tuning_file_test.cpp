#include "saca/lab/prepare/tuning_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "saca/base/core/file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"

namespace saca::prepare::tuning_file_test {
namespace {

using manoeuvre::Tuning;
using testing::HasSubstr;

class TuningFile : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }

  Result<Tuning> read(const std::string& text) {
    EXPECT_EQ(write_file(path_, text), std::nullopt);
    return read_tuning(path_);
  }
  std::string complaint(const std::string& old_text, const std::string& new_text) {
    std::string text = text_;
    const std::size_t place = text.find(old_text);
    EXPECT_NE(place, std::string::npos) << old_text;
    text.replace(place, old_text.size(), new_text);
    const auto tuning = read(text);
    return tuning.has_value() ? "accepted" : tuning.error().message;
  }

  const Tuning tuning_ = default_car().tuning;
  const std::string text_ = tuning_text(tuning_, "how\nit was found");
  const std::filesystem::path path_ =
      std::filesystem::path(testing::TempDir()) /
      ("saca_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
       ".tuning.toml");
};

TEST_F(TuningFile, ReadsWhatWasWrittenToTheLastDigit) {
  Tuning changed = tuning_;
  changed.drift.turning = 1.0 / 0.7;
  changed.swerve.lag = 0.1 / 3.0;
  const auto tuning = read(tuning_text(changed, ""));
  ASSERT_TRUE(tuning.has_value()) << tuning.error().message;
  for (const auto& number : manoeuvre::drift_numbers) {
    EXPECT_EQ(tuning.value().drift.*number.member, changed.drift.*number.member) << number.key;
  }
  for (const auto& number : manoeuvre::swerve_numbers) {
    EXPECT_EQ(tuning.value().swerve.*number.member, changed.swerve.*number.member) << number.key;
  }
  EXPECT_EQ(tuning.value().domain.slowest, changed.domain.slowest);
  EXPECT_EQ(tuning.value().domain.fastest, changed.domain.fastest);
}

TEST_F(TuningFile, BeginsWithItsComment) {
  EXPECT_TRUE(text_.starts_with("# how\n# it was found\n")) << text_.substr(0, 40);
}

TEST_F(TuningFile, IsRefusedWhenWrong) {
  EXPECT_THAT(complaint("turning = ", "turned = "), HasSubstr("turning"));
  EXPECT_THAT(complaint("[drift]", "[drift]\ncolour = 3"), HasSubstr("colour"));
  EXPECT_THAT(complaint("damping = ", "damping = 7 #"), HasSubstr("damping"));
  EXPECT_THAT(complaint("grip = [0.2", "grip = [0.25"), HasSubstr("want [0.2, 0.3"));
  EXPECT_THAT(complaint("slowest_mps = [", "slowest_mps = [5, "), HasSubstr("slowest_mps"));
  EXPECT_THAT(complaint("slowest_mps = [", "slowest_mps = [nan, "), HasSubstr("slowest_mps"));
  EXPECT_THAT(complaint("fastest_mps = [", "fastest_mps = [26, "), HasSubstr("fastest_mps"));
}

}  // namespace
}  // namespace saca::prepare::tuning_file_test
