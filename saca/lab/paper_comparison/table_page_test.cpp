#include "saca/lab/paper_comparison/table_page.h"

#include <gmock/gmock.h>

#include "saca/lab/eval/methods.h"
#include "saca/lab/paper_comparison/rows_for_test.h"

namespace saca::paper_comparison::table_page_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

// Published: arXiv 2504.00115, Table III.
TEST(TablePage, PublishedStandsAboveOurs) {
  const report::PageTable table = page_table(some_figures());
  EXPECT_EQ(table.heading, "Table III: one-way road");
  EXPECT_EQ(table.columns[0], "Collision Loss, n = 10");
  EXPECT_EQ(table.columns[1], "n = 12");
  ASSERT_EQ(table.rows.size(), 4U + 2U);
  EXPECT_EQ(table.rows[3].name, "published: SACA with a fine-tuned model");
  EXPECT_THAT(table.rows[3].cells, ElementsAre("0.07", "-", "-", "0.00", "-", "-"));
  const report::PageTable::Row& saca = table.rows[4];
  EXPECT_EQ(saca.name, eval::find_method("saca")->title);
  EXPECT_EQ(saca.link, "table_3.html");
  EXPECT_EQ(saca.cells[0], "0.50 (0.50 to 0.50)");
  EXPECT_THAT(saca.cells[1], StartsWith("0.75 ("));
  EXPECT_EQ(saca.cells[2], "0.50 (0.50 to 0.50), n = 2");
  EXPECT_EQ(saca.cells[3], "-");  // without twins there is no false trigger
  EXPECT_THAT(saca.cells[5], StartsWith("-0.0250 ("));
  EXPECT_EQ(table.rows[5].cells[2], "-");
  ASSERT_TRUE(table.chart.has_value());
  ASSERT_EQ(table.chart->rows.size(), 2U);
  EXPECT_EQ(table.chart->rows[0].note, "0.75");
  EXPECT_THAT(report::suite_page({.title = "Tables", .tables = {table}}),
              HasSubstr("table_3.html"));
}

// Published: arXiv 2504.00115, Table IV.
TEST(TablePage, RepliesStandBesideThePapersOfTheSameTable) {
  const report::PageTable table = replies_table({some_replies()});
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0].name, "published: Table III: one-way road");
  EXPECT_THAT(table.rows[0].cells, ElementsAre("-", "-", "-", "352", "5.3", "3.5", "-"));
  EXPECT_EQ(table.rows[1].name, "Table III: one-way road, the model");
  EXPECT_THAT(table.rows[1].cells,
              ElementsAre("20", "18", "17", "110 (100 to 112)", "3.3 (3.0 to 3.5)", "2.8", "12"));
}

TEST(TablePage, WithoutReplyThereIsNoLeastTime) {
  TimedModel none = some_replies();
  none.times = {};
  EXPECT_THAT(replies_table({none}).rows[1].cells, ElementsAre("0", "0", "0", "-", "-", "-", "0"));
  EXPECT_TRUE(replies_table({}).rows.empty());
}

}  // namespace
}  // namespace saca::paper_comparison::table_page_test
