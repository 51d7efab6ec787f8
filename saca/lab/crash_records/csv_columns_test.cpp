#include "saca/lab/crash_records/csv_columns.h"

#include <gmock/gmock.h>

#include <array>

namespace saca::crash_records::csv_columns_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::array<CsvColumn, 3> wanted{{{"ST_CASE"}, {"YEAR", false}, {"NAME"}}};

struct Read {
  Result<CsvCount> count;
  std::vector<std::vector<std::string>> rows;
};

Read read(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  auto count =
      read_columns(text, "a.csv", wanted, [&](const CsvRow& row) -> std::optional<std::string> {
        if (row.fields[0].empty()) {
          return "want a number";
        }
        rows.emplace_back(row.fields.begin(), row.fields.end());
        return std::nullopt;
      });
  return {std::move(count), rows};
}

std::string complaint(const std::string& text) {
  const Read found = read(text);
  return found.count.has_value() ? "" : found.count.error().message;
}

TEST(CsvColumns, AreFoundByNameInAnyOrderAndCase) {
  const Read found = read("name,OTHER,st_case\nx,1,7\r\n\"a, b\",2, 8 \n");
  ASSERT_TRUE(found.count.has_value()) << found.count.error().message;
  EXPECT_EQ(found.count.value().rows, 2U);
  EXPECT_THAT(found.rows, ElementsAre(ElementsAre("7", "", "x"), ElementsAre("8", "", "a, b")));
}

TEST(CsvColumns, LeaveQuotesBackslashesAndByteOrderMarksAlone) {
  const Read found = read("\xEF\xBB\xBFST_CASE,NAME\n1,\"say \"\"no\"\", now\"\n2,a\\b\n");
  ASSERT_TRUE(found.count.has_value()) << found.count.error().message;
  ASSERT_EQ(found.rows.size(), 2U);
  EXPECT_EQ(found.rows[0][2], "say no, now");
  EXPECT_EQ(found.rows[1][2], "a\\b");
}

TEST(CsvColumns, PassOverBrokenRowsAndTellOfTheFirst) {
  const Read found = read("ST_CASE,NAME\n1,x\n2\n,y\n3,z\n");
  ASSERT_TRUE(found.count.has_value());
  EXPECT_EQ(found.count.value().rows, 2U);
  EXPECT_EQ(found.count.value().broken, 2U);
  EXPECT_EQ(found.count.value().first_broken, "a.csv:3: want 2 fields, got 1");
}

TEST(CsvColumns, NameTheOneThatIsMissing) {
  EXPECT_EQ(complaint("ST_CASE,YEAR\n1,2\n"),
            "a.csv: want a column NAME, got 2 columns without it: ST_CASE, YEAR");
  EXPECT_THAT(complaint(""), HasSubstr("want a column ST_CASE"));
}

TEST(CsvColumns, WantARowThatCanBeUsed) {
  EXPECT_EQ(complaint("ST_CASE,NAME\n"), "a.csv: want at least one row, got none");
  EXPECT_EQ(complaint("ST_CASE,NAME\n,x\n"), "no row can be used: a.csv:2: want a number");
}

}  // namespace
}  // namespace saca::crash_records::csv_columns_test
