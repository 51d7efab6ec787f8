#include "saca/thinking/language_model/quoted_number.h"

#include <gtest/gtest.h>

#include <string>

namespace saca::language_model::quoted_number_test {
namespace {

std::string listed(std::string_view text) {
  std::string all;
  for (const QuotedNumber& number : quoted_numbers(text)) {
    all += number.text + number.unit + (number.after_equals ? "=" : "") + ' ';
  }
  return all;
}

TEST(QuotedNumbers, HaveTheirUnits) {
  EXPECT_EQ(listed("at 14.0 m/s, 6.4 m left, 1.3s away, 64 % likely, risk 0.94"),
            "14.0m/s 6.4m 1.3s 64% 0.94 ");
  EXPECT_EQ(listed("2 mice, 3 seconds, 4 m/min, 5m"), "2 3 4 5m ");
}

TEST(QuotedNumbers, KnowTheirResolution) {
  const auto numbers = quoted_numbers("14 14.0 14.25");
  ASSERT_EQ(numbers.size(), 3U);
  EXPECT_EQ(numbers[0].resolution, 1.0);
  EXPECT_DOUBLE_EQ(numbers[1].resolution, 0.1);
  EXPECT_DOUBLE_EQ(numbers[2].resolution, 0.01);
  EXPECT_EQ(numbers[2].value, 14.25);
}

TEST(QuotedNumbers, AreNoNamesLabelsOrChoices) {
  EXPECT_EQ(listed("1. truck1 comes\n2) x\n- 3 T-D-R\n4: y"), "");
  EXPECT_EQ(listed("Policy 5, action 6 and Response to user: 6"), "");
  EXPECT_EQ(listed("Actions 1, 3 and 5 take 7 s"), "7s ");
  EXPECT_EQ(listed("policy 1, 12 m away"), "12m ");  // two digits name no policy
}

TEST(QuotedNumbers, AreNotThoseOfPoliciesAnywhereInALine) {
  EXPECT_EQ(listed("So 3 ES-B-L: as good as 1 aes-l"), "");
  EXPECT_EQ(listed("the best is 8 T-D-R"), "");  // a wrong one is not judged here
  EXPECT_EQ(listed("carried out 0 AEB, harm 0.072"), "0.072 ");
  EXPECT_EQ(listed("by 12 AES-L, 1.3 AEB, 3 AEBs, 3 m"), "12 1.3 3 3m ");
}

TEST(QuotedNumbers, KnowWhereAndOfWhatTheyAre) {
  const auto told = [](std::string_view text) {
    std::string all;
    for (const QuotedNumber& number : quoted_numbers(text)) {
      all += number.of_what + '|' + number.where + ' ';
    }
    return all;
  };
  EXPECT_EQ(told("16.0 m ahead, 6.4 m to the left, 3 m Right"), "|ahead |left |right ");
  EXPECT_EQ(told("3.2 m away, at 7.5 m/s, 4 m leftover"), "|away | | ");
  EXPECT_EQ(told("Lane change left 0.93, maintain 0.94, risk 0.5, brake moving right 0.1"),
            "lane change left| maintain| risk| brake moving right| ");
  EXPECT_EQ(told("harm 0.0125, 12 % likely"), "harm| | ");
  EXPECT_EQ(told("left edge 5.2 m; right edge 1.7 m, an edge 3 m away"),
            "left edge| right edge| edge|away ");
}

TEST(QuotedNumbers, SayWhatIsComputed) {
  EXPECT_EQ(listed("TTC = 16.0/14.0 = 1.14 s"), "16.0= 14.0 1.14s= ");
}

}  // namespace
}  // namespace saca::language_model::quoted_number_test
