#include "saca/lab/paper_comparison/table_figures.h"

#include <gtest/gtest.h>

#include "saca/lab/paper_comparison/rows_for_test.h"

namespace saca::paper_comparison::table_figures_test {
namespace {

TEST(TableFigures, AreOfFewDrawsAndOfAll) {
  const TableFigures figures = some_figures();
  EXPECT_EQ(figures.page, "table_3.html");
  ASSERT_EQ(figures.few.size(), 2U);
  EXPECT_EQ(figures.few[0].method, "saca");
  EXPECT_EQ(figures.few[0].collision_loss.n, 10);
  EXPECT_DOUBLE_EQ(figures.few[0].collision_loss.value, 0.5);
  EXPECT_EQ(figures.all[0].collision_loss.n, 12);
  EXPECT_DOUBLE_EQ(figures.all[0].collision_loss.value, 0.75);  // (10 * 0.5 + 2 * 2) / 12
  EXPECT_DOUBLE_EQ(figures.all[0].over_aeb.value, 0.075 - 0.1);
}

// Like the paper's filter: asked at all, and each reply came to its end by itself.
TEST(TableFigures, InTimeIsWhereEveryReplyCameToItsEnd) {
  const TableFigures figures = some_figures();
  ASSERT_EQ(figures.in_time.size(), 2U);
  ASSERT_TRUE(figures.in_time[0].has_value());
  EXPECT_EQ(figures.in_time[0]->method, "saca");
  EXPECT_EQ(figures.in_time[0]->collision_loss.n, 2);
  EXPECT_FALSE(figures.in_time[1].has_value());  // AEB asks nobody
}

TEST(TableFigures, WhatCouldNotBePlayedDoesNotCount) {
  suites::SuiteRun run = some_draws();
  run.rows[0].fault = "it could not be played";
  const TableFigures figures = table_figures(*eval::find_paper_table("table_3"), run, 10, 1);
  EXPECT_EQ(figures.few[0].collision_loss.n, 9);
  EXPECT_EQ(figures.in_time[0]->collision_loss.n, 1);
  for (std::size_t k = 0; k < 10; ++k) {
    run.rows[k].fault = "it could not be played";
  }
  EXPECT_TRUE(table_figures(*eval::find_paper_table("table_3"), run, 10, 1).few.empty());
}

TEST(TableFigures, FewerThanFewAreAll) {
  const TableFigures figures =
      table_figures(*eval::find_paper_table("table_2"), some_draws(), 60, 1);
  EXPECT_EQ(figures.few[0].collision_loss.n, 12);
}

}  // namespace
}  // namespace saca::paper_comparison::table_figures_test
