#include "saca/lab/model_trials/reply_stream.h"

#include <gtest/gtest.h>

namespace saca::model_trials::reply_stream_test {
namespace {

class Streaming : public testing::Test {
 protected:
  [[nodiscard]] ReplyStream of(std::size_t num_replies) {
    return {num_replies, [this](const std::string& text) { told_ += text; }};
  }
  std::string told_;
};

TEST_F(Streaming, OneReplyIsToldAsItComes) {
  ReplyStream stream = of(1);
  stream.take(0, "1. AEB");
  EXPECT_EQ(told_, "1. AEB");
  stream.take(0, " is clear.\n2. So");
  stream.end();
  EXPECT_EQ(told_, "1. AEB is clear.\n2. So\n");
}

TEST_F(Streaming, SeveralAreToldLineByLineWithTheirNumbers) {
  ReplyStream stream = of(2);
  stream.take(0, "a1");
  stream.take(1, "b1\nb2\nb");
  EXPECT_EQ(told_, "2 | b1\n2 | b2\n") << "the first has no whole line yet";
  stream.take(0, "\n");
  stream.take(1, "3");
  stream.end();
  EXPECT_EQ(told_, "2 | b1\n2 | b2\n1 | a1\n2 | b3\n\n");
}

}  // namespace
}  // namespace saca::model_trials::reply_stream_test
