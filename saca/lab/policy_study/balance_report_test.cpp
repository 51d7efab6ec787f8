#include "saca/lab/policy_study/balance_report.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "saca/base/core/proportion.h"

namespace saca::policy_study::balance_report_test {
namespace {

using testing::HasSubstr;

/// Ten encounters: four are won by AEB alone, one by AES-L alone; doing nothing is best in five.
eval::Balance ten() {
  eval::Balance balance{.count = 10};
  balance.lessons = {1, 3, 0, 1, 5};
  balance.alone[0] = 4;
  balance.alone[1] = 1;
  balance.best[0] = 4;
  balance.best[1] = 1;
  balance.best[7] = 5;
  balance.margin[0] = 0.25;
  return balance;
}

TEST(BalanceReport, FiguresAreSharesWithTheirIntervals) {
  const nlohmann::json figures = json_of(ten(), "natural");
  EXPECT_EQ(figures.at("balance.natural.n"), 10);
  EXPECT_EQ(figures.at("balance.natural.never_triggers_share"), 0.1);
  EXPECT_EQ(figures.at("balance.natural.one_alone_share"), 0.5);
  EXPECT_EQ(figures.at("balance.natural.strict_share.p0"), 0.4);
  EXPECT_EQ(figures.at("balance.natural.best_share.p7"), 0.5);
  EXPECT_EQ(figures.at("balance.natural.margin.p0"), 0.25);
  const Proportion half = proportion(5, 10);
  EXPECT_EQ(figures.at("balance.natural.best_share.p7.lo"), half.low);
  EXPECT_EQ(figures.at("balance.natural.best_share.p7.hi"), half.high);
}

TEST(BalanceReport, TheLeastShareLeavesDoingNothingOut) {
  eval::Balance balance = ten();
  balance.alone = {4, 1, 1, 1, 1, 1, 1, 0};
  EXPECT_EQ(json_of(balance, "x").at("balance.x.least_strict_share"), 0.1);
  balance.alone[6] = 0;
  EXPECT_EQ(json_of(balance, "x").at("balance.x.least_strict_share"), 0.0);
}

TEST(BalanceReport, TellsPeopleOfEachLessonAndPolicy) {
  const std::string text = text_of(ten());
  EXPECT_THAT(text, testing::StartsWith("10 encounters\n"));
  EXPECT_THAT(text, HasSubstr("\n  one alone is best                           50.0 % ("));
  EXPECT_THAT(text, HasSubstr("\n0 AEB      40.0 % ("));
  EXPECT_THAT(text, HasSubstr("\n7 NI        0.0 % ("));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 5 + 2 + 8);
}

}  // namespace
}  // namespace saca::policy_study::balance_report_test
