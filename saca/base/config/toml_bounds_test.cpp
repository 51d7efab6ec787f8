#include "saca/base/config/toml_bounds.h"

#include <gtest/gtest.h>

namespace saca::config::toml_bounds_test {
namespace {

constexpr TomlBounds small{.depth = 3, .bytes = 100};

std::string repeated(std::string_view part, std::size_t times) {
  std::string text;
  for (std::size_t i = 0; i < times; ++i) {
    text += part;
  }
  return text;
}

// The line of what is beyond them; 0: nothing is.
std::size_t line_beyond(std::string_view text) {
  const auto excess = beyond(small, text);
  return excess ? excess->line : 0;
}

TEST(TomlBounds, HoldWhatIsNestedAsDeeplyAsTheyAllow) {
  for (const char* text :
       {"", "a.b.c = 1.5", "[a.b.c]\nd = [[{e = 1.0}]]", "x = [1.0, 2.0, 3.0, 4.0]\ny = 2.0",
        "a = [\n [], # [[[[\n []]", "a = '[[[['", "a = \"[[[\\\"[\"", "a = \"\"\nb = ''",
        "\"a.b.c.d.e\" = 1", "a = \"\"\"[[[\" \"\" [[[\"\"\"\"\"\nb = \"[[[[\"",
        "a = '''[[[\n' ''[[['''''\nb = '[[[['", "a = 1 # .....", "]]]] a = [[[]]]"}) {
    EXPECT_EQ(beyond(small, text), std::nullopt) << text;
  }
}

TEST(TomlBounds, NameTheLineOfWhatIsDeeper) {
  EXPECT_EQ(line_beyond("\na.b.c.d = 1"), 2U);
  EXPECT_EQ(line_beyond("[a. b .\"c\".'d']"), 1U);
  EXPECT_EQ(line_beyond("a = 1\n[[[[b"), 2U);
  EXPECT_EQ(line_beyond("a = [\n[\n{b = [1]}]]"), 3U);
  EXPECT_EQ(line_beyond("a = '''\n\n'''\nb = [[[[1]]]]"), 4U);
  EXPECT_EQ(line_beyond("a = \"\"\"\"\"\"\nb = [[[[1]]]]"), 2U);  // an empty one of three quotes
  EXPECT_EQ(line_beyond("a = \"\"\"b\"\"\"\"\"\nc = [[[[1]]]]"), 2U);
  EXPECT_EQ(line_beyond("a = \"\\\\\"\nb = [[[[1]]]]"), 2U);
  EXPECT_EQ(line_beyond("a = '\\'\nb = [[[[1]]]]"), 2U);
  EXPECT_EQ(line_beyond("# '\nb = [[[[1]]]]"), 2U);
  EXPECT_EQ(line_beyond(std::string(101, ' ')), 1U);
}

TEST(TomlBounds, EndWhereATextDoes) {
  for (const char* text : {"\"", "'", "\"\"\"", "'''a''", "\"\\", "a = \"\"\"\\"}) {
    EXPECT_EQ(beyond(small, text), std::nullopt) << text;
  }
}

TEST(TomlBounds, RefuseWhatIsNestedWithoutEnd) {
  for (const char* part : {"a.", "[", "{a=", "a = [", "\"a\"."}) {
    EXPECT_TRUE(beyond(TomlBounds{}, repeated(part, 30'000)).has_value()) << part;
  }
}

}  // namespace
}  // namespace saca::config::toml_bounds_test
