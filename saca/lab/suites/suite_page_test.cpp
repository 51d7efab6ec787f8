#include "saca/lab/suites/suite_page.h"

#include <gmock/gmock.h>

#include "saca/lab/suites/rows_for_test.h"

namespace saca::suites::suite_page_test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

report::SuitePage page(const SuiteRun& run) {
  SuiteRequest request;
  request.name = "natural";
  return page_of(run, result_of(run, 1), request, {});
}

TEST(SuitePage, TellsWhatThereIsToSeeAndHowItWasMade) {
  SuiteRun run =
      made_run({"saca", "aeb"}, {made_row(0, "a", {0.1, 0.3}, 0.1),
                                 made_row(1, "a", {0.1, 0.3}, 0.1), failed_row(2, "b", "no road")});
  run.notes = {"Made by hand."};
  run.rows[0].risk.runs[0].thinking = encounter::ThinkingFigures{.forecasts = 1};
  const report::SuitePage told = page(run);
  EXPECT_EQ(told.title, "natural: 3 encounters, 2 methods");
  EXPECT_EQ(told.lines.back(), "Made by hand.");
  EXPECT_TRUE(told.chart.has_value());
  ASSERT_EQ(told.tables.size(), 3U);
  EXPECT_EQ(told.tables[0].heading, "All figures");
  EXPECT_EQ(told.tables[1].heading, "Regret by family");
  EXPECT_THAT(told.tables[2].heading, HasSubstr("Where the decisions of "));
  EXPECT_THAT(told.footnotes, ElementsAre("command: saca suite made", "seed: 1",
                                          "encounter 2 could not be played: no road"));
}

TEST(SuitePage, RecordedDriversStandFirst) {
  SuiteRun run = made_run({"aeb"}, {made_row(0, "a", {0.1}, 0.1)});
  run.rows[0].driver = eval::DriverRow{};
  EXPECT_EQ(page(run).tables.front().heading, "The recorded drivers");
}

TEST(SuitePage, WithoutARowThereIsOneSentence) {
  const report::SuitePage told = page(made_run({"aeb"}, {failed_row(0, "a", "no road")}));
  EXPECT_THAT(told.lines,
              ElementsAre("1 of 1 encounters are left out; the first: encounter 0 could not be "
                          "played: no road"));
  EXPECT_THAT(told.tables, IsEmpty());
}

TEST(SuitePage, OfManyFaultsSomeAreTold) {
  std::vector<eval::SuiteRow> rows{made_row(0, "a", {0.1}, 0.1)};
  for (std::uint64_t k = 1; k < 60; ++k) {
    rows.push_back(failed_row(k, "a", "no road"));
  }
  const report::SuitePage told = page(made_run({"aeb"}, rows));
  EXPECT_EQ(told.footnotes.size(), 30U);
  EXPECT_THAT(told.footnotes, Contains(HasSubstr("encounter 1 could not be played")));
}

}  // namespace
}  // namespace saca::suites::suite_page_test
