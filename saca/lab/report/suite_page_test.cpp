#include "saca/lab/report/suite_page.h"

#include <gmock/gmock.h>

#include "saca/base/core/contract.h"
#include "tests/support/scenes.h"

namespace saca::report::suite_page_test {
namespace {

using testing::HasSubstr;
using testing::Not;

SceneView view() {
  SceneView one;
  one.title = "0 AEB";
  one.scene = test::ego_at(10.0);
  one.ego = {.X_WA = {{{0.0, 0.0}, 0.0}, {{5.0, 0.0}, 0.0}}};
  return one;
}

SuitePage page() {
  SuitePage made;
  made.title = "Suite <natural>";
  made.lines = {"SACA is better than braking & worse nowhere."};
  made.chart = DotChart{.heading = "Harm",
                        .lines = {},
                        .axis_name = "harm",
                        .axis_unit = "-",
                        .rows = {{"saca", "fill-blue", "", 0.1, 0.05, 0.2}}};
  made.tables = {{.heading = "All",
                  .lines = {},
                  .columns = {"harm", "regret"},
                  .rows = {{.name = "saca",
                            .explanation = "both planes",
                            .cells = {"0.1", "0.05"},
                            .shades = {std::nullopt, 0.5}}}}};
  made.gallery_heading = "Worst";
  made.gallery = {{.title = "encounter 7",
                   .lines = {"why"},
                   .done = view(),
                   .best = view(),
                   .command = "saca suite natural --replay 7 \"<x>\""}};
  made.footnotes = {"seed 1"};
  return made;
}

TEST(SuitePage, IsOneFileInWhichNoTextBecomesMarkup) {
  const std::string html = suite_page(page());
  EXPECT_THAT(html, HasSubstr("<h1>Suite &lt;natural&gt;</h1>"));
  EXPECT_THAT(html, HasSubstr("better than braking &amp; worse"));
  EXPECT_THAT(html, Not(HasSubstr("<x>")));
  EXPECT_THAT(html, Not(HasSubstr("src=")));
  EXPECT_THAT(html, Not(HasSubstr("href=")));
  EXPECT_EQ(html, suite_page(page()));
}

TEST(SuitePage, ARowMayLeadToAnotherPageAndATableMayHaveAChart) {
  SuitePage made = page();
  made.tables[0].rows[0].link = "a\"b.html";
  made.tables[0].chart = made.chart;
  made.chart.reset();
  const std::string html = suite_page(made);
  EXPECT_THAT(html, HasSubstr("<a href=\"a&quot;b.html\">saca</a></td>"));
  const std::size_t heading = html.find("<h2>All</h2>");
  EXPECT_LT(heading, html.find("<svg", heading));
  EXPECT_LT(html.find("<svg", heading), html.find("<table", heading));
}

TEST(SuitePage, ShowsEachCellWithItsShadeAndEachCardWithTwoPictures) {
  const std::string html = suite_page(page());
  EXPECT_THAT(html, HasSubstr("<td style=\"background:rgba(213,94,0,0.38)\">0.05</td>"));
  EXPECT_THAT(html, HasSubstr("<b>saca</b>: both planes"));
  std::size_t pictures = 0;
  for (std::size_t at = html.find("<title>0 AEB"); at != std::string::npos;
       at = html.find("<title>0 AEB", at + 1)) {
    ++pictures;
  }
  EXPECT_EQ(pictures, 2U);
}

TEST(SuitePage, CardsHaveTablesOpenAndFolded) {
  SuitePage made = page();
  const PageTable table{
      .heading = "Facts <of it>",
      .lines = {},
      .columns = {"code"},
      .rows = {{.name = "TRAV_SP", .explanation = "", .cells = {"45"}, .shades = {}}}};
  made.gallery[0].command.clear();
  made.gallery[0].tables = {table};
  made.gallery[0].folded = {table, table};
  const std::string html = suite_page(made);
  EXPECT_THAT(html, HasSubstr("<details><summary>Facts &lt;of it&gt;</summary>"));
  std::size_t cells = 0;
  for (std::size_t at = html.find("TRAV_SP"); at != std::string::npos;
       at = html.find("TRAV_SP", at + 1)) {
    ++cells;
  }
  EXPECT_EQ(cells, 3U);
  EXPECT_THAT(html, Not(HasSubstr("<code></code>")));
}

TEST(SuitePage, RefusesATableThatDoesNotFit) {
  SuitePage wrong = page();
  wrong.tables[0].rows[0].cells.pop_back();
  EXPECT_THROW((void)suite_page(wrong), ContractViolation);
  wrong = page();
  wrong.tables[0].rows[0].shades[1] = 1.5;
  EXPECT_THROW((void)suite_page(wrong), ContractViolation);
}

}  // namespace
}  // namespace saca::report::suite_page_test
