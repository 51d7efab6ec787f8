#include "saca/lab/reach_study/solution_summary.h"

#include <gtest/gtest.h>

#include <vector>

namespace saca::reach_study::solution_summary_test {
namespace {

/// Two snapshots of four cells: of the last, 0 counts as unsafe, and so does 0.5.
danger::Solution four_cells() {
  danger::Solution solved{.grid = {{{.name = "x", .first = 0.0, .last = 3.0, .points = 4}}},
                          .times = {0.5, 2.0}};
  solved.values = danger::Snapshots<float>{{1.0F, 1.0F, 1.0F, 1.0F}, {-1.0F, 0.0F, 0.5F, -2.0F}};
  return solved;
}

TEST(SolutionSummary, CountsTheUnsafeCellsOfTheLastSnapshot) {
  const SolutionSummary summary = summary_of("a.h5", four_cells(), 3.0);
  EXPECT_EQ(summary.cells, 4U);
  EXPECT_EQ(summary.unsafe_share, 0.5);
  EXPECT_EQ(summary.times, (std::vector{0.5, 2.0}));
}

TEST(SolutionSummary, HasItsSchema) {
  const nlohmann::json all = json_of(summary_of("a.h5", four_cells(), 3.0));
  EXPECT_EQ(all, (nlohmann::json{{"schema", "saca.reach_solve/1"},
                                 {"file", "a.h5"},
                                 {"cells", 4},
                                 {"times_s", {0.5, 2.0}},
                                 {"unsafe_share", 0.5},
                                 {"seconds", 3.0}}));
}

TEST(SolutionSummary, IsOneLineForPeople) {
  EXPECT_EQ(text_of(summary_of("b/a.h5", four_cells(), 3.04)),
            "b/a.h5: 4 cells, to 2 s, 50.00 % of them unsafe; 3.0 s\n");
}

}  // namespace
}  // namespace saca::reach_study::solution_summary_test
