#include "saca/lab/suites/suite_result.h"

#include <gmock/gmock.h>

#include "saca/lab/suites/rows_for_test.h"

namespace saca::suites::suite_result_test {
namespace {

using manoeuvre::PolicyId;

TEST(SuiteResult, IsOfAllAndOfEachFamily) {
  SuiteRun run = made_run({"saca", "aeb"},
                          {made_row(0, "a", {0.2, 0.4}, 0.1), made_row(1, "a", {0.4, 0.4}, 0.1),
                           made_row(2, "b", {0.0, 0.1}, 0.0), failed_row(3, "b", "no road")});
  const SuiteResult result = result_of(run, 1);
  EXPECT_EQ(result.faults, 1);
  EXPECT_EQ(result.method_faults, 0);
  ASSERT_EQ(result.all.size(), 2U);
  EXPECT_EQ(result.all[0].method, "saca");
  EXPECT_NEAR(result.all[1].harm.value, 0.9 / 3.0, 1e-12);
  ASSERT_EQ(result.families.size(), 2U);
  const auto& of_a = result.families.at("a");
  EXPECT_NEAR(of_a[0].harm.value, 0.3, 1e-12);
  EXPECT_NEAR(of_a[0].regret.value, 0.2, 1e-12);
  EXPECT_NEAR(of_a[0].over_aeb.value, -0.1, 1e-12);
  EXPECT_EQ(result.families.at("b")[1].harm.n, 1);
}

// One threw with risk, another in a twin: nobody's figures count these encounters, and both are
// told.
TEST(SuiteResult, WhereAMethodFailedNobodyIsCounted) {
  SuiteRun run = made_run({"saca", "aeb"},
                          {made_row(0, "a", {0.5, 0.5}, 0.0), made_row(1, "a", {0.1, 0.1}, 0.0),
                           made_row(2, "a", {0.3, 0.3}, 0.0), made_row(3, "a", {0.7, 0.7}, 0.0)});
  for (eval::SuiteRow& row : run.rows) {
    row.twin = row.risk;
  }
  run.rows[0].risk.runs[0].fault = "it threw";
  run.rows[2].twin->runs[1].fault = "that threw";
  const SuiteResult result = result_of(run, 1);
  EXPECT_EQ(result.faults, 0);
  EXPECT_EQ(result.method_faults, 2);
  EXPECT_EQ(result.all[0].faults, 1);
  EXPECT_EQ(result.all[1].faults, 1);
  EXPECT_EQ(result.all[0].harm.n, 2);
  EXPECT_NEAR(result.all[0].harm.value, 0.4, 1e-12);
  EXPECT_NEAR(result.all[1].twins->harm.value, 0.4, 1e-12);
  EXPECT_EQ(failure_of(run.rows[2], run.methods), "aeb failed in its twin: that threw");
  EXPECT_EQ(failures_text(run),
            "2 of 4 encounters are left out; the first: encounter 0 saca failed: it threw");
  run.rows[1].risk.runs[0].fault = run.rows[3].risk.runs[0].fault = "it threw";
  EXPECT_TRUE(result_of(run, 1).all.empty());
  EXPECT_EQ(result_of(run, 1).method_faults, 4);
}

TEST(Failures, AreToldOnlyWhereThereAreAny) {
  EXPECT_EQ(failures_text(made_run({"aeb"}, {made_row(0, "a", {0.0}, 0.0)})), "");
}

TEST(SuiteResult, AFamilyOfWhichNothingCouldBePlayedHasNoFigures) {
  const SuiteRun run = made_run({"aeb"}, {failed_row(0, "a", "no road")});
  EXPECT_EQ(failures_text(run),
            "1 of 1 encounters are left out; the first: encounter 0 could not be played: no road");
  const SuiteResult result = result_of(run, 1);
  EXPECT_TRUE(result.all.empty());
  EXPECT_TRUE(result.families.at("a").empty());
  EXPECT_EQ(result.faults, 1);
}

// Three drivers: one braked and met nobody, one moved aside and met nobody, one was hit. Who always
// brakes does as the first of the two did.
TEST(DriverFigures, HoldMethodsAgainstThoseWhoMetNobody) {
  SuiteRun run = made_run({"aeb", "nothing"},
                          {made_row(0, "a", {0.0, 0.0}, 0.0), made_row(1, "a", {0.0, 0.0}, 0.0),
                           made_row(2, "a", {0.0, 0.0}, 0.0), made_row(3, "a", {0.0, 0.0}, 0.0),
                           failed_row(4, "a", "no road")});
  for (eval::SuiteRow& row : run.rows) {
    if (row.fault.empty()) {
      row.risk.runs[1].plan = std::nullopt;
    }
  }
  run.rows[0].driver = eval::DriverRow{.brakes = true};
  run.rows[1].driver = eval::DriverRow{.steers = 1};
  run.rows[2].driver = eval::DriverRow{.harm = 0.3, .met = "car", .impact_speed = 9.0};
  run.rows[4].driver = eval::DriverRow{.harm = 1.0};
  const DriverFigures figures = driver_figures(run);
  EXPECT_EQ(figures.count, 3);
  EXPECT_NEAR(figures.harm, 0.1, 1e-12);
  EXPECT_EQ(figures.met, 1);
  EXPECT_EQ(figures.braked, 1);
  EXPECT_EQ(figures.steered, 1);
  EXPECT_THAT(figures.agreement, testing::ElementsAre(0.5, 0.0));
}

TEST(DriverFigures, WithoutDriversAreNought) {
  const DriverFigures figures = driver_figures(made_run({"aeb"}, {made_row(0, "a", {0.1}, 0.0)}));
  EXPECT_EQ(figures.count, 0);
  EXPECT_EQ(figures.harm, 0.0);
  EXPECT_THAT(figures.agreement, testing::ElementsAre(0.0));
}

}  // namespace
}  // namespace saca::suites::suite_result_test
