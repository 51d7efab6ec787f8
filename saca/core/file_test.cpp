#include "saca/core/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

namespace saca::file_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class File : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(testing::TempDir()) /
        ("saca_file_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(File, ComesBackAsItWasWritten) {
  const std::string bytes("a\0b\n", 4);
  ASSERT_EQ(write_file(folder_ / "x", bytes), std::nullopt);
  EXPECT_EQ(read_file(folder_ / "x").value(), bytes);
}

TEST_F(File, ReplacesTheOldOneAndLeavesNothingElse) {
  ASSERT_EQ(write_file(folder_ / "x", "old and longer"), std::nullopt);
  ASSERT_EQ(write_file(folder_ / "x", "new"), std::nullopt);
  EXPECT_EQ(read_file(folder_ / "x").value(), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}), 1);
}

TEST_F(File, SaysWhichFileIsMissing) {
  const auto result = read_file(folder_ / "missing.toml");
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, Error::Code::unreadable);
  EXPECT_THAT(result.error().message, HasSubstr("missing.toml"));
}

TEST_F(File, RefusesAFolder) {
  EXPECT_THAT(read_file(folder_).error().message, HasSubstr("is a folder"));
}

TEST_F(File, AFailedReplacementLeavesTheOldAndNoDraft) {
  // A folder stands where the file should go: the last step, renaming, fails.
  fs::create_directories(folder_ / "x" / "inside");
  const auto problem = write_file(folder_ / "x", "text");
  ASSERT_TRUE(problem.has_value());
  EXPECT_EQ(problem->code, Error::Code::unwritable);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}), 1);
}

TEST_F(File, SaysWhyItCannotBeCreated) {
  const auto problem = write_file(folder_ / "no" / "folder" / "x", "text");
  ASSERT_TRUE(problem.has_value());
  EXPECT_THAT(problem->message, HasSubstr("No such file"));
}

TEST_F(File, IsHandedOnInParts) {
  std::string whole((std::size_t{5} << 19) + 7, 'a');  // two and a half parts
  whole[std::size_t{1} << 20] = 'b';
  const std::string_view parts = whole;
  ASSERT_FALSE(write_file(folder_ / "x", {parts.substr(0, 9), parts.substr(9)}).has_value());
  std::string joined;
  std::size_t longest = 0;
  const auto take = [&](std::string_view bytes) {
    joined += bytes;
    longest = std::max(longest, bytes.size());
  };
  EXPECT_FALSE(read_file(folder_ / "x", take).has_value());
  EXPECT_EQ(joined, whole);
  EXPECT_EQ(longest, std::size_t{1} << 20);
  EXPECT_TRUE(read_file(folder_ / "y", take).has_value());
}

}  // namespace
}  // namespace saca::file_test
