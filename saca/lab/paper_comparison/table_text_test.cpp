#include "saca/lab/paper_comparison/table_text.h"

#include <gtest/gtest.h>

namespace saca::paper_comparison::table_text_test {
namespace {

TEST(TableText, ColumnsAreAsWideAsTheirWidest) {
  EXPECT_EQ(text_of({.heading = "Losses",
                     .lines = {"Of ten."},
                     .columns = {"loss", "n"},
                     .rows = {{.name = "SACA", .cells = {"0.07", "10"}},
                              {.name = "braking", .cells = {"0.5000", "9"}}}}),
            "Losses\n"
            "  Of ten.\n"
            "             loss   n\n"
            "  SACA       0.07  10\n"
            "  braking  0.5000   9\n"
            "\n");
}

TEST(TableText, WithoutRowsThereAreHeadings) {
  EXPECT_EQ(text_of({.heading = "None", .columns = {"a", "b"}}), "None\n    a  b\n\n");
}

}  // namespace
}  // namespace saca::paper_comparison::table_text_test
