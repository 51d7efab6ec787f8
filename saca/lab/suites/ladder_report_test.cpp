#include "saca/lab/suites/ladder_report.h"

#include <gmock/gmock.h>

#include "saca/lab/suites/method_list.h"
#include "saca/lab/suites/rows_for_test.h"

namespace saca::suites::ladder_report_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// Braking, which loses 0.2 (0.1 to 0.3) against the oracle, or perhaps nothing.
std::vector<RungFigures> two_rungs(double step_low) {
  RungFigures top{{"oracle", nullptr, "Best in hindsight."}, {}, std::nullopt};
  top.figures.method = "oracle";
  top.figures.regret = {.value = -0.01, .low = -0.02, .high = 0.0, .n = 7};
  RungFigures braking{{"aeb", "oracle", "always braking"}, {}, std::nullopt};
  braking.figures.method = "aeb";
  braking.figures.regret = {.value = 0.2, .low = 0.1, .high = 0.3, .n = 7};
  braking.figures.worse_than_aeb = {.value = 0.125, .low = 0.0, .high = 0.25, .n = 7};
  braking.step = eval::Estimate{.value = 0.2, .low = step_low, .high = 0.3, .n = 7};
  return {top, braking};
}

TEST(LadderText, TellsWhatAStepCostsAndWhatMayBeChance) {
  SuiteRun run = made_run({"oracle", "aeb"}, {failed_row(4, "a", "no road")});
  const std::string sure = ladder_text(run, two_rungs(0.1), "folder/natural");
  EXPECT_THAT(sure,
              HasSubstr("\n1 of 1 encounters are left out; the first: encounter 4 could not be "
                        "played: no road\n"));
  EXPECT_THAT(sure, StartsWith("folder/natural: 7 encounters; regret, "));
  EXPECT_THAT(sure, HasSubstr("\noracle                 -0.0100 (-0.0200 to 0.0000)  Best in "
                              "hindsight.\n"));
  EXPECT_THAT(sure, HasSubstr("always braking: +0.2000 (+0.1000 to +0.3000)\n"));
  run.rows.clear();
  EXPECT_THAT(ladder_text(run, two_rungs(0.1), "natural"), Not(HasSubstr("left out")));
  EXPECT_THAT(ladder_text(run, two_rungs(-0.1), "natural"),
              HasSubstr("+0.2000 (-0.1000 to +0.3000), which may be chance\n"));
}

TEST(LadderJson, HasRegretAndSteps) {
  auto climbed = two_rungs(0.1);
  climbed[1].figures.sources = {{"memory", 2}};
  SuiteRun run = made_run({"oracle", "aeb"}, {});
  nlohmann::json out = ladder_json(run, climbed, "natural");
  EXPECT_EQ(out.at("meta.seed"), "1");
  EXPECT_EQ(out.at("ladder.natural.aeb"), 0.2);
  EXPECT_EQ(out.at("ladder.natural.aeb.lo"), 0.1);
  EXPECT_EQ(out.at("ladder.natural.aeb.materially_worse_than_aeb"), 0.125);
  EXPECT_EQ(out.at("ladder.natural.aeb.step_from.oracle"), 0.2);
  EXPECT_EQ(out.at("ladder.natural.aeb.step_from.oracle.n"), 7);
  EXPECT_FALSE(out.contains("ladder.natural.aeb.source.memory"));  // it does not think ahead
  climbed[1].figures.thinking = encounter::ThinkingFigures{.forecasts = 1};
  EXPECT_EQ(ladder_json(run, climbed, "natural").at("ladder.natural.aeb.source.memory"), 2);
}

TEST(LadderPage, DrawsNothingBelowNought) {
  const report::SuitePage page = ladder_page(
      made_run({"oracle", "aeb"}, {made_row(0, "a", {0.0, 0.2}, 0.0)}), two_rungs(0.1), "natural");
  EXPECT_EQ(page.title, "Where regret comes from: natural, 1 encounters");
  ASSERT_EQ(page.chart->rows.size(), 2U);
  EXPECT_EQ(page.chart->rows[0].value, std::optional(0.0));
  EXPECT_EQ(page.chart->rows[0].low, 0.0);
  EXPECT_EQ(page.chart->rows[0].high, 0.0);
  EXPECT_EQ(page.chart->rows[0].looks, "fill-grey");
  EXPECT_EQ(page.chart->rows[1].high, 0.3);
  ASSERT_EQ(page.tables.size(), 1U);
  EXPECT_THAT(page.tables[0].rows[1].cells,
              ElementsAre("0.2000 (0.1000 to 0.3000)", "0.2000 (0.1000 to 0.3000)",
                          title_of("oracle"), "12.5", "always braking"));
  EXPECT_EQ(page.tables[0].rows[0].cells[1], "-");
  EXPECT_EQ(page.tables[0].rows[0].cells[2], "-");
  EXPECT_THAT(page.footnotes, ElementsAre("command: saca suite made", "seed: 1"));
}

}  // namespace
}  // namespace saca::suites::ladder_report_test
