#include "saca/lab/regulation/regulation_page.h"

#include <gmock/gmock.h>

#include "saca/lab/eval/methods.h"
#include "saca/lab/regulation/run_for_test.h"

namespace saca::regulation::regulation_page_test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(RegulationPage, HasASummaryAndATableForEachRow) {
  const report::SuitePage page = page_of(some_run());
  EXPECT_EQ(page.title, "Some text");
  EXPECT_THAT(page.lines.front(), HasSubstr("would not be allowed"));
  EXPECT_THAT(page.lines, Contains(HasSubstr("Test surface: friction coefficient 0.9 (6.1).")));
  EXPECT_THAT(page.lines, Contains(HasSubstr("without braking by 3.0 m/s2 at least")));
  ASSERT_EQ(page.tables.size(), 4U);
  const report::PageTable& summary = page.tables[0];
  EXPECT_THAT(summary.columns, ElementsAre("small", "large", "all"));
  ASSERT_EQ(summary.rows.size(), 2U);
  EXPECT_EQ(summary.rows[1].name, eval::find_method("aeb")->title);
  EXPECT_THAT(summary.rows[1].cells, ElementsAre("3 of 4", "2 of 4", "5 of 8"));
  EXPECT_THAT(summary.rows[1].shades, ElementsAre(0.25, 0.5, 0.375));
  EXPECT_NO_THROW((void)report::suite_page(page));
}

TEST(RegulationPage, CellsSayWhatHappenedInWordsAndShades) {
  const report::SuitePage page = page_of(some_run());
  const report::PageTable& car = page.tables[1];
  EXPECT_EQ(car.heading, "A car stands");
  EXPECT_THAT(car.lines, ElementsAre("r1: 7.1. Nobody may be touched."));
  EXPECT_THAT(car.columns, ElementsAre("36 km/h", "72 km/h"));
  ASSERT_EQ(car.rows.size(), 4U);  // each method with each car
  EXPECT_THAT(car.rows[3].cells,
              ElementsAre("FAILS: hits with 3.0 m/s", "FAILS: hits with 12.0 m/s"));
  // 0.45 for a failure, and up to 1 by the share of the speed that is left: 3 of 10, 12 of 20.
  EXPECT_NEAR(*car.rows[3].shades[0], 0.45 + 0.55 * 0.3, 1e-12);
  EXPECT_NEAR(*car.rows[3].shades[1], 0.45 + 0.55 * 0.6, 1e-12);
  EXPECT_EQ(*car.rows[2].shades[0], 0.0);
  const report::PageTable& person = page.tables[2];
  EXPECT_THAT(person.columns, ElementsAre("36 km/h (9)"));
  EXPECT_THAT(person.rows[3].cells, ElementsAre("passes: 2.0 m/s"));
  const report::PageTable& plate = page.tables[3];
  EXPECT_THAT(plate.lines.front(), HasSubstr("by less than 0.25 g"));
  EXPECT_THAT(plate.rows[3].cells, ElementsAre("passes: 0.20 g"));
  EXPECT_THAT(plate.rows[0].cells, ElementsAre("FAILS: could not be played"));
}

TEST(RegulationPage, WhoSteersPassesByName) {
  RegulationRun run = some_run();
  run.results[1].plan = manoeuvre::Plan{manoeuvre::PolicyId::aes_left, std::nullopt};
  const report::PageTable table = page_of(run).tables[1];
  EXPECT_EQ(table.rows[2].cells[0],
            "passes: " + std::string(manoeuvre::name(manoeuvre::PolicyId::aes_left)));
}

TEST(RegulationPage, TheFootTellsNotesOriginsAndFaults) {
  EXPECT_THAT(page_of(some_run()).footnotes,
              ElementsAre("Nothing is left out.", "command: saca suite r1",
                          HasSubstr("nothing, small, plate, 36 km/h: it threw")));
}

}  // namespace
}  // namespace saca::regulation::regulation_page_test
