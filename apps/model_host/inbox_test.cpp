#include "inbox.h"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <string_view>

namespace saca::model_host::inbox_test {
namespace {

class InboxTest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(pipe2(ends_.data(), O_CLOEXEC), 0); }
  void TearDown() override {
    close(ends_[0]);
    hang_up();
  }
  void say(std::string_view text) {
    ASSERT_EQ(write(ends_[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  void hang_up() {
    if (ends_[1] >= 0) {
      close(ends_[1]);
      ends_[1] = -1;
    }
  }
  bool holds(Inbox& inbox, const std::string& wanted) {
    return inbox.holds([&](const std::string& line) { return line == wanted; });
  }

  std::array<int, 2> ends_{-1, -1};
};

TEST_F(InboxTest, LinesComeInTheirOrderHoweverTheyWereCut) {
  Inbox inbox(ends_[0]);
  say("one\ntw");
  EXPECT_EQ(inbox.take(), "one");
  say("o\n\nthree");
  EXPECT_EQ(inbox.take(), "two");
  EXPECT_EQ(inbox.take(), "");
  hang_up();
  EXPECT_EQ(inbox.take(), "three");  // the last line needs no end
  EXPECT_EQ(inbox.take(), std::nullopt);
  EXPECT_EQ(inbox.take(), std::nullopt);
}

TEST_F(InboxTest, LooksWithoutWaitingAndTakesNothing) {
  Inbox inbox(ends_[0]);
  EXPECT_FALSE(holds(inbox, "stop"));
  say("go\nst");
  EXPECT_FALSE(holds(inbox, "stop"));
  say("op\n");
  EXPECT_TRUE(holds(inbox, "stop"));
  hang_up();
  EXPECT_TRUE(holds(inbox, "stop"));
  EXPECT_EQ(inbox.take(), "go");
  EXPECT_EQ(inbox.take(), "stop");
  EXPECT_FALSE(holds(inbox, "stop"));
  EXPECT_EQ(inbox.take(), std::nullopt);
}

TEST_F(InboxTest, LinesOfAnyLengthAreWhole) {
  Inbox inbox(ends_[0]);
  const std::string line(50'000, 'x');  // more than one read, less than a pipe holds
  say(line + "\n");
  EXPECT_EQ(inbox.take(), line);
}

}  // namespace
}  // namespace saca::model_host::inbox_test
