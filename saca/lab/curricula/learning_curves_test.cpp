#include "saca/lab/curricula/learning_curves.h"

#include <gmock/gmock.h>

#include "saca/lab/curricula/episodes_for_test.h"

namespace saca::curricula::learning_curves_test {
namespace {

using testing::HasSubstr;

TEST(LearningCurves, HaveAPointInTheMiddleOfEachBlock) {
  const report::ChartSheet sheet = learning_curves(some_episodes(), "made");
  EXPECT_THAT(sheet.lines.front(), HasSubstr("made: 2 encounters one after the other, mean of 2 "
                                             "seeds"));
  ASSERT_EQ(sheet.charts.size(), 2U);
  const report::LineChart& lost = sheet.charts[0];
  EXPECT_EQ(lost.x.high, 2.0);
  ASSERT_EQ(lost.curves.size(), eval::curriculum_methods.size());
  EXPECT_EQ(lost.curves[0].name, "frozen");
  ASSERT_EQ(lost.curves[0].points.size(), 2U);
  EXPECT_DOUBLE_EQ(lost.curves[0].points[0].x, 0.5);
  EXPECT_DOUBLE_EQ(lost.curves[0].points[0].y, 0.15);
  EXPECT_DOUBLE_EQ(lost.curves[0].points[1].x, 1.5);
  // A tenth of room above the largest mean of a block: "drawn" and "corrected" have 0.25.
  EXPECT_DOUBLE_EQ(lost.y.high, 1.1 * 0.25);
  EXPECT_FALSE(lost.curves[2].dashed);
  EXPECT_TRUE(lost.curves[3].dashed);
}

TEST(LearningCurves, OnlyWhoThoughtHasAShareFromMemory) {
  const report::LineChart known = learning_curves(some_episodes(), "made").charts[1];
  ASSERT_EQ(known.curves.size(), eval::num_learners);
  EXPECT_TRUE(known.curves[0].points.empty());
  ASSERT_EQ(known.curves[1].points.size(), 2U);
  EXPECT_DOUBLE_EQ(known.curves[1].points[0].y, 25.0);  // of the one seed that thought, in per cent
  EXPECT_DOUBLE_EQ(known.curves[1].points[1].y, 100.0);
}

TEST(LearningCurves, CanBeDrawnWhereNothingWasLost) {
  std::vector<eval::Episodes> all(1);
  all[0].of = {harming({0.0, 0.0, 0.0, 0.0, 0.0, 0.0})};
  all[0].size = {{0, 0, 0}};
  const report::ChartSheet sheet = learning_curves(all, "made");
  EXPECT_EQ(sheet.charts[0].y.high, 1.0);
  EXPECT_THAT(report::chart_svg(sheet), HasSubstr("Learning from encounters"));
}

}  // namespace
}  // namespace saca::curricula::learning_curves_test
