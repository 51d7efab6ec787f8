#include "saca/lab/paper_comparison/table_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "saca/lab/installation/here_for_test.h"

namespace saca::paper_comparison::table_run_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class TableRunTest : public testing::Test {
 protected:
  const installation::Installation here_ = installation::here_for_test();
  TableRequest request_{
      .count = 1, .threads = 1, .output = (fs::path(testing::TempDir()) / "table_run").string()};
  void SetUp() override {
    fs::remove_all(request_.output);
    fs::create_directories(request_.output);
  }
  void TearDown() override { fs::remove_all(request_.output); }
};

TEST_F(TableRunTest, LeavesRowsAndPageAndTellsTheFigures) {
  const eval::PaperTable* const table = eval::find_paper_table("table_3");
  ASSERT_NE(table, nullptr);
  const auto run = run_table(here_, *table, request_, {"aeb", "nothing"});
  ASSERT_TRUE(run.has_value()) << run.error().message;
  ASSERT_TRUE(run.value().has_value());
  EXPECT_EQ(run.value()->figures.few.size(), 2U);
  EXPECT_EQ(run.value()->failures, "");
  EXPECT_EQ(run.value()->made.at("meta.version"), "1.2.3");
  EXPECT_TRUE(fs::exists(fs::path(request_.output) / "table_3.h5"));
  EXPECT_TRUE(fs::exists(fs::path(request_.output) / "table_3.html"));
}

TEST_F(TableRunTest, AModelThatIsNotThereIsTold) {
  request_.thinking.model = "local:nowhere.gguf";
  EXPECT_THAT(time_replies(here_, request_).error().message, HasSubstr("make model"));
}

}  // namespace
}  // namespace saca::paper_comparison::table_run_test
