#include "saca/lab/shell/quotes.h"

#include <gtest/gtest.h>

namespace saca::shell::quotes_test {
namespace {

TEST(Quotes, EndBeforeAQuoteAndBeginAnewBehindIt) {
  EXPECT_EQ(in_quotes("a b"), "'a b'");
  EXPECT_EQ(in_quotes("don't"), "'don'\\''t'");
  EXPECT_EQ(in_quotes(""), "''");
}

TEST(AWord, IsQuotedOnlyWhereAShellSeesMoreInIt) {
  EXPECT_EQ(quoted_word("--at-s=4.5"), "--at-s=4.5");
  EXPECT_EQ(quoted_word("m@https://host:1/v1"), "m@https://host:1/v1");
  EXPECT_EQ(quoted_word("a*"), "'a*'");
  EXPECT_EQ(quoted_word("$HOME"), "'$HOME'");
  EXPECT_EQ(quoted_word(""), "''");
}

}  // namespace
}  // namespace saca::shell::quotes_test
