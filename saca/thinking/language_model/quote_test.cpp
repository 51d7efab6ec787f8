#include "saca/thinking/language_model/quote.h"

#include <gtest/gtest.h>

namespace saca::language_model::quote_test {
namespace {

TEST(Quote, IsOneLineOfAtMost200Characters) {
  EXPECT_EQ(quote("no such model", ""), "no such model");
  EXPECT_EQ(quote("a\r\nb\tc\x1B[31m\x7F", ""), "a  b c [31m ");
  EXPECT_EQ(quote("a\xC2\x9B"
                  "b\xE2\x80\xA8"
                  "c",
                  ""),
            "a b c");
  EXPECT_EQ(quote(std::string(1000, 'x'), ""), std::string(200, 'x') + "...");
}

TEST(Quote, HasWholeCharactersOnly) {
  std::string euros;
  for (int i = 0; i < 2000; ++i) {  // cut inside the 1366th
    euros += "\xE2\x82\xAC";
  }
  EXPECT_EQ(quote(euros, ""), euros.substr(0, 600) + "...");
  EXPECT_EQ(quote("a\xFF\xE2", ""), "a\xEF\xBF\xBD\xEF\xBF\xBD");  // U+FFFD
}

TEST(Quote, HidesTheSecret) {
  EXPECT_EQ(quote("bad key sk-123456789!", "sk-123456789"), "bad key ***!");
  EXPECT_EQ(quote("sk-123456789sk-123456789", "sk-123456789"), "******");
  EXPECT_EQ(quote("abcabc", "abc"), "******");
  EXPECT_EQ(quote("nothing of it", "abc"), "nothing of it");
}

TEST(Quote, HidesPiecesOfTheSecret) {
  const std::string secret = "sk-abcdefghijklmnopqrstuvwxyz";
  EXPECT_EQ(quote("cut: sk-abcdefgh", secret), "cut: ***");
  EXPECT_EQ(quote("sk-abcdefgh\\/ijklmnopqrstuvwxyz", secret), "***\\/***");
  EXPECT_EQ(quote("alphabet: abcdefg", secret), "alphabet: abcdefg");  // seven in a row
  std::string many;
  for (int i = 0; i < 300; ++i) {  // the bytes looked at end inside one
    many += secret;
  }
  EXPECT_EQ(quote(many, secret).find('s'), std::string::npos);
}

TEST(SecretFilter, HidesTheSecretWhereverItIsCut) {
  const std::string secret = "sk-abcdefghijklmnop";
  const std::string text = "the key is " + secret + ", a piece of it ghijklmno, and sk-a is none";
  for (std::size_t size = 1; size <= text.size(); ++size) {
    SecretFilter filter(secret);
    std::string shown;
    for (std::size_t from = 0; from < text.size(); from += size) {
      shown += filter.take(std::string_view(text).substr(from, size));
    }
    shown += filter.rest();
    EXPECT_EQ(shown, "the key is ***, a piece of it ***, and sk-a is none") << size;
  }
}

TEST(SecretFilter, KeepsBackOnlyWhatMayBeTheSecret) {
  SecretFilter filter("sk-abcdefgh");
  EXPECT_EQ(filter.take("risk"), "ri");
  EXPECT_EQ(filter.take("s"), "sk");
  EXPECT_EQ(filter.rest(), "s");
  SecretFilter nothing;
  EXPECT_EQ(nothing.take("all of it"), "all of it");
  EXPECT_EQ(nothing.rest(), "");
}

}  // namespace
}  // namespace saca::language_model::quote_test
