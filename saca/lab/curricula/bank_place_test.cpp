#include "saca/lab/curricula/bank_place.h"

#include <gtest/gtest.h>

namespace saca::curricula::bank_place_test {
namespace {

TEST(BankPlace, ABankWithinTheFolderIsInTheWay) {
  const auto problem = why_in_the_way("/banks/way/seed-1/learning.sqlite", "/banks/way");
  ASSERT_TRUE(problem.has_value());
  EXPECT_EQ(problem->code, Error::Code::out_of_range);
  EXPECT_EQ(problem->message,
            "--memory: want a bank outside of /banks/way, whose banks are replaced, got "
            "/banks/way/seed-1/learning.sqlite");
  EXPECT_TRUE(why_in_the_way("/banks/other/../way/mine.sqlite", "/banks/way").has_value());
}

TEST(BankPlace, ABankBesideTheFolderIsNot) {
  EXPECT_FALSE(why_in_the_way("/banks/way.sqlite", "/banks/way").has_value());
  EXPECT_FALSE(why_in_the_way("/banks/ways/mine.sqlite", "/banks/way").has_value());
  EXPECT_FALSE(why_in_the_way("", "/banks/way").has_value());  // none
}

}  // namespace
}  // namespace saca::curricula::bank_place_test
