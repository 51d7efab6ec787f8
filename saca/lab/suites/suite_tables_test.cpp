#include "saca/lab/suites/suite_tables.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "saca/lab/suites/method_list.h"
#include "saca/lab/suites/rows_for_test.h"

namespace saca::suites::suite_tables_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Two families, of which one could not be played.
SuiteRun two_methods() {
  return made_run({"aeb", "oracle"},
                  {made_row(0, "a", {0.2, 0.1}, 0.1), made_row(1, "a", {0.2, 0.1}, 0.1),
                   failed_row(2, "b", "no road")});
}

TEST(HarmChart, ShowsEachMethodAndGreysYardsticks) {
  const report::DotChart chart = harm_chart(result_of(two_methods(), 1));
  ASSERT_EQ(chart.rows.size(), 2U);
  EXPECT_EQ(chart.axis_name, "harm");
  EXPECT_EQ(chart.rows[0].name, title_of("aeb"));
  EXPECT_EQ(chart.rows[0].looks, "fill-blue");
  EXPECT_EQ(chart.rows[0].note, "0.2000");
  EXPECT_NEAR(chart.rows[0].value.value_or(-1.0), 0.2, 1e-12);
  EXPECT_GE(chart.rows[0].low, 0.0);
  EXPECT_EQ(chart.rows[1].looks, "fill-grey");
}

TEST(FiguresTable, HasACellForEachColumn) {
  const report::PageTable table = figures_table(result_of(two_methods(), 1));
  ASSERT_EQ(table.rows.size(), 2U);
  const auto at = [&](const std::string& column) {
    const auto found = std::find(table.columns.begin(), table.columns.end(), column);
    return static_cast<std::size_t>(found - table.columns.begin());
  };
  for (const report::PageTable::Row& row : table.rows) {
    EXPECT_EQ(row.cells.size(), table.columns.size());
  }
  EXPECT_EQ(table.rows[0].cells[at("harm")], "0.2000 (0.2000 to 0.2000)");
  EXPECT_EQ(table.rows[0].cells[at("regret, all plans")], "0.1000 (0.1000 to 0.1000)");
  EXPECT_EQ(table.rows[1].cells[at("harm above AEB's")], "-0.1000 (-0.1000 to -0.1000)");
  EXPECT_EQ(table.rows[1].cells[at("False-Trigger Loss (twins)")], "-");
  EXPECT_FALSE(table.rows[0].faded);
  EXPECT_TRUE(table.rows[1].faded);
}

// The darkest cell is the one in which most is lost; what the family of faults lost nobody knows.
TEST(FamiliesTable, ShadesRegret) {
  const report::PageTable table = families_table(result_of(two_methods(), 1));
  EXPECT_THAT(table.columns, ElementsAre("a (2)"));
  EXPECT_THAT(table.rows[0].cells, ElementsAre("0.1000"));
  EXPECT_THAT(table.rows[0].shades, ElementsAre(testing::Optional(1.0)));
  EXPECT_THAT(table.rows[1].shades, ElementsAre(testing::Optional(0.0)));
}

TEST(DriversTable, StandsBesideTheMethodsWhereThereWereDrivers) {
  SuiteRun run = two_methods();
  EXPECT_FALSE(drivers_table(run).has_value());
  run.rows[1].driver = eval::DriverRow{.harm = 0.05, .brakes = true};
  run.rows[1].risk.runs[0].met = "car";
  const auto table = drivers_table(run);
  ASSERT_TRUE(table.has_value());
  EXPECT_THAT(table->lines[0], HasSubstr("1 encounters with a recorded driver, who met somebody "
                                         "in 0, braked in 1 and moved aside in 0."));
  ASSERT_EQ(table->rows.size(), 3U);
  EXPECT_THAT(table->rows[0].cells, ElementsAre("0.0500", "0", "-"));
  EXPECT_THAT(table->rows[1].cells, ElementsAre("0.2000", "1", "100.0"));
  EXPECT_THAT(table->rows[2].cells, ElementsAre("0.1000", "0", "100.0"));
}

}  // namespace
}  // namespace saca::suites::suite_tables_test
