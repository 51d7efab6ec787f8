#include "saca/lab/long_work/output_file.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <string>

#include "saca/base/core/file.h"

namespace saca::long_work::output_file_test {
namespace {

class OutputFiles : public testing::Test {
 protected:
  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("output_file_") + testing::UnitTest::GetInstance()->current_test_info()->name());
  void SetUp() override { std::filesystem::remove_all(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
};

TEST_F(OutputFiles, AreWrittenWithTheFoldersThatTheyLieIn) {
  const std::filesystem::path file = folder_ / "some" / "where" / "figures.json";
  ASSERT_EQ(write_output(file, "{}"), std::nullopt);
  EXPECT_EQ(read_file(file).value(), "{}");
}

TEST_F(OutputFiles, CannotLieBelowAFile) {
  const std::filesystem::path file = folder_ / "file";
  ASSERT_EQ(write_output(file, "text"), std::nullopt);
  const auto problem = write_output(file / "below" / "figures.json", "{}");
  ASSERT_TRUE(problem.has_value());
  EXPECT_EQ(problem->code, Error::Code::unwritable);
  EXPECT_THAT(problem->message, testing::HasSubstr((file / "below").string()));
  EXPECT_EQ(read_file(file).value(), "text");
}

TEST_F(OutputFiles, OfWhichOneCannotBeWrittenAreRefusedBeforehandAndAnEmptyNameIsNone) {
  ASSERT_EQ(make_folder_of(folder_ / "x"), std::nullopt);
  EXPECT_EQ(why_outputs_unwritable({"", folder_ / "page.html"}), std::nullopt);
  const auto problem = why_outputs_unwritable({folder_ / "page.html", folder_});
  ASSERT_TRUE(problem.has_value());
  EXPECT_THAT(problem->message, testing::HasSubstr(folder_.string()));
}

}  // namespace
}  // namespace saca::long_work::output_file_test
