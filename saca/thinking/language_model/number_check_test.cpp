#include "saca/thinking/language_model/number_check.h"

#include <gtest/gtest.h>

#include <string>

namespace saca::language_model::number_check_test {
namespace {

constexpr std::string_view lines =
    "truck1: 16 m ahead, 6.4 m left, risk 0.94\n"
    "left edge 5.2 m, kerb; right edge 1.8 m\n"
    "0 AEB: clear by 0.6 m, no harm\n";

/// The text of the first number that is not founded; empty: all are.
std::string first_unfounded(std::string_view text, int side = 0) {
  const auto none = unfounded(numbers_said(text, side), lines);
  return none ? none->text : "";
}

TEST(NumberCheck, FindsNumbersWithUnitAndDirection) {
  EXPECT_EQ(first_unfounded("16 m ahead, 6.4 m left, risk 0.94, 16.0 m"), "");
  EXPECT_EQ(first_unfounded("6.4 m right"), "6.4");
  EXPECT_EQ(first_unfounded("16 m/s"), "16");
  EXPECT_EQ(first_unfounded("harm 0.94"), "0.94");
  EXPECT_EQ(first_unfounded("harm 0"), "");
  EXPECT_EQ(first_unfounded("clear by 1 m"), "1") << "too coarse for 0.6";
}

TEST(NumberCheck, HoldsEdgesToTheirSide) {
  EXPECT_TRUE(is_of_an_edge("5.2 m away, a kerb"));
  EXPECT_FALSE(is_of_an_edge("knowledge of 5.2 m"));
  EXPECT_EQ(first_unfounded("the edge, 5.2 m away", 1), "");
  EXPECT_EQ(first_unfounded("the edge, 5.2 m away", -1), "5.2");
  EXPECT_EQ(first_unfounded("an edge, 1.8 m away"), "");
  EXPECT_EQ(first_unfounded("trees, 16 m away"), "16") << "no edge is as far";
  EXPECT_EQ(first_unfounded("somebody, 16 m away"), "");
}

TEST(NumberCheck, ComputesQuotients) {
  EXPECT_EQ(first_unfounded("16 m / 6.4 m = 2.5"), "");
  EXPECT_EQ(first_unfounded("16 m / 6.4 m = 2.6"), "2.6");
}

}  // namespace
}  // namespace saca::language_model::number_check_test
