#include "saca/thinking/language_model/words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace saca::language_model::words_test {
namespace {

using testing::ElementsAre;

TEST(Words, AreLookedUpInLowerCase) {
  EXPECT_EQ(lowered("AES-L Hits Car1"), "aes-l hits car1");
  EXPECT_EQ(lowered("\xC3\x84"), "\xC3\x84") << "ASCII alone";
  EXPECT_EQ(lowered(""), "");
}

TEST(Words, AreWhole) {
  EXPECT_EQ(find_phrase("car12 and car1", "car1"), 10U);
  EXPECT_EQ(find_phrase("a hit, a hit", "hit", 3), 9U);
  EXPECT_FALSE(has_phrase("unclear", "clear"));
  EXPECT_FALSE(has_phrase("clearly", "clear"));
  EXPECT_FALSE(has_phrase("", "clear"));
  EXPECT_TRUE(has_phrase("(no harm)", "no harm"));
  EXPECT_TRUE(has_any("it is free", std::array<std::string_view, 2>{"clear", "free"}));
  EXPECT_FALSE(has_any("freed", std::array<std::string_view, 2>{"clear", "free"}));
}

TEST(Words, StandInSentences) {
  EXPECT_THAT(sentences("One is 1.5 m away. Two; three\nfour"),
              ElementsAre("One is 1.5 m away.", " Two;", " three\n", "four"));
  EXPECT_THAT(sentences("1. AEB is clear. So 0."), ElementsAre("1. AEB is clear.", " So 0."))
      << "a number at the beginning numbers the line";
  EXPECT_TRUE(sentences("\n - \n . \n").empty());
  EXPECT_TRUE(sentences("").empty());
}

}  // namespace
}  // namespace saca::language_model::words_test
