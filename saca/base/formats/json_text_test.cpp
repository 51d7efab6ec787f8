#include "saca/base/formats/json_text.h"

#include <gtest/gtest.h>

namespace saca::formats::json_text_test {

std::string nested(std::size_t levels) {
  return std::string(levels, '[') + std::string(levels, ']');
}

TEST(JsonText, ReadsWhatIsWithinItsBounds) {
  const auto parsed = parse_json(R"({"a": [1, "[[[[\"{{{{"]})", {.depth = 2, .bytes = 100});
  ASSERT_TRUE(parsed.has_value()) << parsed.error().message;
  EXPECT_EQ(parsed.value()["a"][1], "[[[[\"{{{{");
  EXPECT_TRUE(parse_json(nested(32)).has_value());
  EXPECT_TRUE(parse_json("[[],[],[]]", {.depth = 2}).has_value());
}

TEST(JsonText, RefusesWhatIsNestedDeeply) {
  for (const std::size_t levels : {33UL, 500'000UL}) {
    const auto parsed = parse_json<nlohmann::ordered_json>(nested(levels));
    ASSERT_FALSE(parsed.has_value());
    EXPECT_EQ(parsed.error().message, "want JSON of at most 32 levels, got more at byte 32");
  }
  EXPECT_FALSE(parse_json(std::string(500'000, '[')).has_value());
}

TEST(JsonText, RefusesWhatIsLong) {
  const auto parsed = parse_json("[1, 2, 3]", {.bytes = 8});
  ASSERT_FALSE(parsed.has_value());
  EXPECT_EQ(parsed.error().message, "want JSON of at most 8 bytes, got 9");
}

TEST(JsonText, SaysInOneShortLineWhatIsNoJson) {
  for (const std::string& text :
       {std::string("\"\x1b[2J\n"), std::string("\"a\\"), std::string(),
        "{\"a\": x" + std::string(1'000'000, 'y'), "[\"" + std::string(1'000'000, 'y') + "\" 1]"}) {
    const auto parsed = parse_json(text);
    ASSERT_FALSE(parsed.has_value());
    const std::string& message = parsed.error().message;
    EXPECT_LE(message.size(), 300U);
    EXPECT_EQ(message.find_first_of("\n\x1b"), std::string::npos);
    EXPECT_TRUE(message.starts_with("want JSON, got `")) << message;
  }
}

}  // namespace saca::formats::json_text_test
