#include "utf8.h"

#include <gtest/gtest.h>

namespace saca::model_host::utf8_test {
namespace {

// U+20AC is the three bytes E2 82 AC, U+1F600 the four F0 9F 98 80.
TEST(Utf8Splitter, GivesCharactersOnWhole) {
  Utf8Splitter splitter;
  EXPECT_EQ(splitter.take("a\xE2"), "a");
  EXPECT_EQ(splitter.take("\x82"), "");
  EXPECT_EQ(splitter.take("\xAC!"), "\xE2\x82\xAC!");
  EXPECT_EQ(splitter.take("\xF0\x9F\x98"), "");
  EXPECT_EQ(splitter.take("\x80"), "\xF0\x9F\x98\x80");
}

TEST(Utf8Splitter, NeverHoldsMoreThanThreeBytes) {
  Utf8Splitter splitter;
  std::size_t in = 0;
  std::size_t out = 0;
  for (int byte = 0; byte < 256; ++byte) {
    for (const char* tail : {"", "\x80", "\x80\x80"}) {
      const std::string bytes = static_cast<char>(byte) + std::string(tail);
      in += bytes.size();
      out += splitter.take(bytes).size();
      EXPECT_LE(in - out, 3U);
    }
  }
}

}  // namespace
}  // namespace saca::model_host::utf8_test
