#include "saca/base/config/toml_number.h"

#include <gtest/gtest.h>

#include "saca/base/config/config.h"

namespace saca::config::toml_number_test {
namespace {

constexpr std::string_view text = R"(
name = "a"  # a comment
count = 3
share = 0.1
[road]
width_m = 3.5
[[actors]]
id = 1
[actors.start]
s_m = -70.25
times_s = [0, 0.1, 0.2]
[[actors]]
id = 2
)";

TEST(TomlNumber, IsFoundUnderKeysAndPlaces) {
  EXPECT_EQ(number_at(text, "count"), 3.0);
  EXPECT_EQ(number_at(text, "road.width_m"), 3.5);
  EXPECT_EQ(number_at(text, "actors.0.start.s_m"), -70.25);
  EXPECT_EQ(number_at(text, "actors.1.id"), 2.0);
  EXPECT_EQ(number_at(text, "actors.0.start.times_s.2"), 0.2);
  for (const char* path : {"", ".", "name", "road", "actors", "actors.2.id", "actors.-1.id",
                           "actors.id", "road.width_m.0", "count.", "actors.99999999999.id"}) {
    EXPECT_EQ(number_at(text, path), std::nullopt) << path;
  }
  EXPECT_EQ(number_at("not toml", "count"), std::nullopt);
}

TEST(TomlNumber, IsChangedAndNothingElseIs) {
  constexpr double third = 1.0 / 3.0;  // no short decimal: the bits must come back
  for (const char* path :
       {"road.width_m", "share", "actors.0.start.s_m", "actors.0.start.times_s.1"}) {
    const auto changed = with_number(text, path, third);
    ASSERT_TRUE(changed.has_value()) << path;
    EXPECT_EQ(number_at(changed.value(), path), third) << path;
    const auto back = with_number(changed.value(), path, number_at(text, path).value());
    EXPECT_EQ(back.value(), with_number(text, "share", 0.1).value()) << path;
  }
}

TEST(TomlNumber, KeepsAnIntegerWhereItCan) {
  const auto read = [](const std::string& changed) {
    const auto document = Document::parse(changed, "a.toml");
    Table root = document.value().root();
    (void)root.integer("count", 0, 10);
    return document.value().error()->message;
  };
  EXPECT_NE(read(with_number(text, "count", 11.0).value()).find("want 0 to 10, got 11"),
            std::string::npos);
  EXPECT_NE(read(with_number(text, "count", 1.5).value()).find("want an integer"),
            std::string::npos);
}

TEST(TomlNumber, IsMadeWhereItMayBeMissing) {
  const auto made = with_number(text, "perception.latency_s", 0.25);
  EXPECT_EQ(number_at(made.value(), "perception.latency_s"), 0.25);
  EXPECT_EQ(number_at(with_number(text, "actors.1.start.s_m", 4.0).value(), "actors.1.start.s_m"),
            4.0);
  for (const char* path : {"name", "name.a", "actors.2.id", "actors.a.id", "road.width_m.a",
                           "actors.0.start.times_s.3"}) {
    EXPECT_FALSE(with_number(text, path, 1.0).has_value()) << path;
  }
  EXPECT_FALSE(with_number("not toml", "a", 1.0).has_value());
}

}  // namespace
}  // namespace saca::config::toml_number_test
