#include "saca/base/core/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

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

TEST_F(File, WaitsForNoPipeAndReadsNoDevice) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(read_file(folder_ / "pipe").error().message,
              HasSubstr("pipe: is a pipe, want a file"));
  EXPECT_THAT(read_file("/dev/zero").error().message, HasSubstr("is a device"));
  const auto take = [](std::string_view /*bytes*/) {};
  EXPECT_THAT(read_file(folder_ / "pipe", take)->message, HasSubstr("is a pipe"));
}

TEST_F(File, ReadsNoMoreThanWasWanted) {
  ASSERT_EQ(write_file(folder_ / "x", "12345"), std::nullopt);
  EXPECT_EQ(read_file(folder_ / "x", 5).value(), "12345");
  EXPECT_THAT(read_file(folder_ / "x", 4).error().message,
              HasSubstr("x: want at most 4 bytes, got 5"));
  fs::resize_file(folder_ / "x",
                  std::uintmax_t{10} << 30U);  // a hole: on the disk there is nothing
  EXPECT_THAT(read_file(folder_ / "x").error().message,
              HasSubstr("x: want at most 67108864 bytes, got 10737418240"));
  EXPECT_THAT(read_file("/proc/self/status", 10).error().message,  // which tells no size
              HasSubstr("want at most 10 bytes, got"));
}

// By links: should this ever fail, the machine keeps its devices.
TEST_F(File, ADeviceIsWrittenInto) {
  fs::create_symlink("/dev/null", folder_ / "null");
  EXPECT_EQ(write_file(folder_ / "null", "text"), std::nullopt);
  EXPECT_TRUE(fs::is_character_file(folder_ / "null"));
  fs::create_symlink("/dev/full", folder_ / "full");
  const auto full = write_file(folder_ / "full", "text");
  ASSERT_TRUE(full.has_value());
  EXPECT_EQ(full->code, Error::Code::unwritable);
  EXPECT_THAT(full->message, HasSubstr("full: cannot be written: No space left"));
  EXPECT_TRUE(fs::is_character_file(folder_ / "full"));
}

TEST_F(File, APipeIsNotReplaced) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  const auto problem = write_file(folder_ / "pipe", "text");
  ASSERT_TRUE(problem.has_value());
  EXPECT_EQ(problem->code, Error::Code::unwritable);
  EXPECT_THAT(problem->message, HasSubstr("pipe: is a pipe, want a file"));
  EXPECT_TRUE(fs::is_fifo(folder_ / "pipe"));
}

TEST_F(File, ALinkStaysAndWhatItLeadsToIsReplaced) {
  ASSERT_EQ(write_file(folder_ / "x", "old"), std::nullopt);
  fs::create_symlink("x", folder_ / "link");
  ASSERT_EQ(write_file(folder_ / "link", "new"), std::nullopt);
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(read_file(folder_ / "x").value(), "new");
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

TEST_F(File, CouldBeWrittenWhereFoldersCanBeMadeAndNothingIsLeft) {
  for (const char* path : {"x", "a/b/c/x"}) {
    EXPECT_EQ(why_unwritable(folder_ / path), std::nullopt) << path;
  }
  EXPECT_EQ(why_unwritable("/dev/null"), std::nullopt);
  EXPECT_TRUE(fs::is_empty(folder_));
  ASSERT_EQ(write_file(folder_ / "x", "old"), std::nullopt);
  EXPECT_EQ(why_unwritable(folder_ / "x"), std::nullopt);
  EXPECT_EQ(read_file(folder_ / "x").value(), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}), 1);
}

TEST_F(File, CouldNotBeWrittenBelowAFileOrInPlaceOfAFolder) {
  ASSERT_EQ(write_file(folder_ / "x", "old"), std::nullopt);
  fs::create_directories(folder_ / "there");
  for (const fs::path& path : {folder_ / "x" / "y", folder_ / "x" / "y" / "z", folder_ / "there",
                               fs::path("/proc/no/x"), fs::path("/proc/x")}) {
    const auto problem = why_unwritable(path);
    ASSERT_TRUE(problem.has_value()) << path;
    EXPECT_EQ(problem->code, Error::Code::unwritable);
    EXPECT_THAT(problem->message, HasSubstr(path.parent_path().string()));
    EXPECT_TRUE(write_file(path, "text").has_value()) << path;
  }
  EXPECT_EQ(read_file(folder_ / "x").value(), "old");
}

}  // namespace
}  // namespace saca::file_test
