#include "reply_pace.h"

#include <gtest/gtest.h>

namespace saca::model_host::reply_pace_test {
namespace {

TEST(ReplyPace, IsShortWhereNoFurtherStatementFits) {
  ReplyPace pace;
  EXPECT_FALSE(pace.is_short(0.0, 100, 3)) << "nothing is known yet";
  EXPECT_EQ(pace.cost_of(100), 0.0);
  pace.add(0.030, 3);   // a token each
  pace.add(0.070, 17);  // forced text: 5 ms a token on average
  EXPECT_DOUBLE_EQ(pace.cost_of(10), 0.050);
  // Three brief ends of 20 tokens take 0.3 s, with a statement more each at least half as much
  // again; twice that is plenty.
  EXPECT_TRUE(pace.is_short(0.30, 60, 3));
  EXPECT_TRUE(pace.is_short(0.45, 60, 3));
  EXPECT_FALSE(pace.is_short(0.90, 60, 3));
  EXPECT_FALSE(pace.is_short(0.30, 20, 1)) << "one alone has time";
}

TEST(ReplyPace, FollowsTheLastAsk) {
  ReplyPace pace;
  pace.add(1.0, 100);
  ASSERT_FALSE(pace.is_short(1.0, 20, 1));
  for (int ask = 0; ask < 5; ++ask) {
    pace.fade();
    pace.add(4.0, 100);  // the machine has become four times slower
  }
  EXPECT_TRUE(pace.is_short(1.0, 20, 1));
}

}  // namespace
}  // namespace saca::model_host::reply_pace_test
