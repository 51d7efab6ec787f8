#include "saca/base/core/printable.h"

#include <gtest/gtest.h>

namespace saca::printable_test {

TEST(Printable, KeepsTextAndNewlines) {
  const std::string text = "Stop.\nLücke 3,5 m → 漢字 \xF0\x9F\x9A\x97";
  EXPECT_EQ(printable(text), text);
}

TEST(Printable, LeavesNoCommandForATerminal) {
  EXPECT_EQ(printable("a\x1b[2Jb\rc\td\x7f"), "a [2Jb c d ");
  EXPECT_EQ(printable("\xC2\x9B"
                      "2J"),
            " 2J");                                            // CSI of C1
  EXPECT_EQ(printable("a\xE2\x80\xA8g\xE2\x80\xAE"), "a g ");  // U+2028, U+202E
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a b");
}

TEST(Printable, MarksBytesThatAreNoUtf8) {
  const std::string mark = "\xEF\xBF\xBD";
  EXPECT_EQ(printable("\x9B"), mark);                                   // a lone C1 byte
  EXPECT_EQ(printable("a\xC3"), "a" + mark);                            // cut
  EXPECT_EQ(printable("\xC0\x9B"), mark + mark);                        // overlong
  EXPECT_EQ(printable("\xED\xA0\x80"), mark + mark + mark);             // surrogate
  EXPECT_EQ(printable("\xF4\x90\x80\x80"), mark + mark + mark + mark);  // beyond U+10FFFF
}

TEST(Printable, TellsUtf8FromOtherBytes) {
  EXPECT_TRUE(is_utf8(""));
  EXPECT_TRUE(is_utf8("Lücke 3,5 m → 漢字 \xF0\x9F\x9A\x97"));
  for (const char* const other :
       {"\x9B", "a\xC3", "\xC0\x9B", "\xED\xA0\x80", "\xF4\x90\x80\x80"}) {
    EXPECT_FALSE(is_utf8(other));
  }
}

TEST(Printable, OneLineHasNoEndAndAtMostSoManyCharacters) {
  EXPECT_EQ(one_line("a\nb"), "a b");
  EXPECT_EQ(one_line("abc", 3), "abc");
  EXPECT_EQ(one_line("abcd", 3), "abc...");
  EXPECT_EQ(one_line("äöüß", 3), "äöü...");
  EXPECT_EQ(one_line(std::string(1'000'000, 'x')), std::string(200, 'x') + "...");
}

}  // namespace saca::printable_test
