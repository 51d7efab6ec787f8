#include "saca/base/config/config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

namespace saca::config::config_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// What is wrong with `text` when it is read by `read`; empty when nothing is.
std::string problem(std::string_view text, const std::function<void(Table&)>& read) {
  const auto document = Document::parse(text, "car.toml");
  if (!document.has_value()) {
    return document.error().message;
  }
  Table root = document.value().root();
  read(root);
  const auto error = document.value().error();
  return error ? error->message : "";
}

TEST(Config, ReadsEveryKindOfValue) {
  const auto document = Document::parse(R"(
mass_kg = 1700
grip = 0.9
name = "a car"
electric = true
arms_m = [1.35, 1.45]
[road]
width_m = 3.5
[[actor]]
id = 1
[[actor]]
id = 2
)",
                                        "car.toml");
  Table root = document.value().root();
  EXPECT_EQ(root.number("mass_kg"), 1700.0);
  EXPECT_EQ(root.number("grip", {0.0, 1.2}), 0.9);
  EXPECT_EQ(root.text("name"), "a car");
  EXPECT_TRUE(root.flag("electric", false));
  EXPECT_THAT(root.numbers("arms_m", {0.0, 5.0}, 2), ElementsAre(1.35, 1.45));
  EXPECT_EQ(root.table("road").number("width_m"), 3.5);
  auto actors = root.tables("actor");
  ASSERT_EQ(actors.size(), 2U);
  EXPECT_EQ(actors[0].integer("id", 1, 9), 1);
  EXPECT_EQ(actors[1].integer("id", 1, 9), 2);
  EXPECT_EQ(root.optional_number("drag"), std::nullopt);
  EXPECT_EQ(root.optional_text("note"), std::nullopt);
  EXPECT_FALSE(root.optional_table("nothing").has_value());
  EXPECT_EQ(document.value().error(), std::nullopt);
}

TEST(Config, NamesFileLineKeyAndWhatWasWanted) {
  EXPECT_EQ(problem("a = 1\nmass_kg = -3\n",
                    [](Table& t) {
                      (void)t.number("a");
                      (void)t.number("mass_kg", {0.0, 9000.0});
                    }),
            "car.toml:2: mass_kg: want 0 to 9000, got -3");
}

TEST(Config, RefusesNaNAndInfinity) {
  for (const char* text : {"x_m = nan", "x_m = inf", "x_m = -inf"}) {
    EXPECT_THAT(problem(text, [](Table& t) { (void)t.number("x_m"); }), HasSubstr("x_m: want"));
  }
  EXPECT_THAT(problem("x_m = [1, nan]", [](Table& t) { (void)t.numbers("x_m"); }),
              HasSubstr("x_m: want"));
}

TEST(Config, RefusesAnUnknownKeyAtAnyDepth) {
  const auto read = [](Table& t) { (void)t.table("road").number("width_m"); };
  EXPECT_EQ(problem("[road]\nwidth_m = 3\nlenght_m = 2\n", read),
            "car.toml:3: lenght_m: unknown key; here stand width_m");
  EXPECT_EQ(problem("typo = 1\n[road]\nwidth_m = 3\n", read),
            "car.toml:1: typo: unknown key; here stand road");
}

TEST(Config, AsksWhetherAnotherKeyWasMeant) {
  const auto read = [](Table& t) {
    (void)t.number("speed_mps");
    (void)t.optional_text("driver");
    (void)t.optional_number("x_m");
    (void)t.optional_number("y_m");
  };
  EXPECT_EQ(problem("speed_mps = 1\ndriven = \"me\"", read),
            "car.toml:2: driven: unknown key; did you mean 'driver'?");
  EXPECT_EQ(problem("speed_mps = 1\nz_m = 1\ny_m = 1", read),
            "car.toml:2: z_m: unknown key; did you mean 'x_m'?");  // y_m is there already
}

// Which is wrong: the key that is there, not the one that it leaves missing.
TEST(Config, BlamesTheMisspeltKeyRatherThanTheOneThatIsMissing) {
  const auto read = [](Table& t) {
    (void)t.text("name");
    Table start = t.table("start");
    (void)start.text("behaviour");
    (void)start.number("speed_mps");
  };
  EXPECT_EQ(problem("name = \"a\"\n[start]\nspeed_mps = 1\nbehavior = \"brake\"", read),
            "car.toml:4: behavior: unknown key; did you mean 'behaviour'?");
  EXPECT_EQ(problem("name = \"a\"\n[strat]\nspeed_mps = 1\nbehaviour = \"brake\"", read),
            "car.toml:2: strat: unknown key; did you mean 'start'?");
  EXPECT_EQ(problem("name = \"a\"\n[start]\nspeed_kmh = 1\nbehaviour = \"brake\"", read),
            "car.toml:3: speed_kmh: unknown key; did you mean 'speed_mps'?");
  EXPECT_EQ(problem("name = \"a\"\ncolour = 1\n[start]\nspeed_mps = 1", read),
            "car.toml:3: behaviour: missing");  // nothing here looks like it
}

TEST(Config, AsksWhetherANumberIsInAnotherUnit) {
  const auto wrong = [](const std::string& key, Range range, const std::string& text) {
    return problem(key + " = " + text, [&](Table& t) { (void)t.number(key, range); });
  };
  EXPECT_EQ(wrong("speed_mps", {0.0, 100.0}, "130"),
            "car.toml:1: speed_mps: want 0 to 100, got 130 (did you mean km/h? that would be 36.1 "
            "m/s)");
  EXPECT_EQ(wrong("grip", {0.05, 1.2}, "90"),
            "car.toml:1: grip: want 0.05 to 1.2, got 90 (did you mean %? that would be 0.9)");
  EXPECT_EQ(wrong("width_m", {0.0, 1.0}, "90"), "car.toml:1: width_m: want 0 to 1, got 90");
}

TEST(Config, RefusesTheWrongType) {
  EXPECT_THAT(problem("a = \"1\"", [](Table& t) { (void)t.number("a"); }),
              HasSubstr("want a number, got a string"));
  EXPECT_THAT(problem("a = 1", [](Table& t) { (void)t.text("a"); }), HasSubstr("want a text"));
  EXPECT_THAT(problem("a = 1", [](Table& t) { (void)t.flag("a", true); }),
              HasSubstr("true or false"));
  EXPECT_THAT(problem("a = 1.5", [](Table& t) { (void)t.integer("a", 0, 2); }),
              HasSubstr("want an integer"));
  EXPECT_THAT(problem("a = 7", [](Table& t) { (void)t.integer("a", 0, 2); }),
              HasSubstr("want 0 to 2, got 7"));
  EXPECT_THAT(problem("a = 1", [](Table& t) { (void)t.table("a"); }), HasSubstr("want a table"));
  EXPECT_THAT(problem("a = 1", [](Table& t) { (void)t.tables("a"); }), HasSubstr("want [[a]]"));
  EXPECT_THAT(problem("a = [1]", [](Table& t) { (void)t.numbers("a", {}, 2); }),
              HasSubstr("want [2 numbers], got 1"));
  EXPECT_THAT(problem("a = [1]", [](Table& t) { (void)t.tables("a"); }), HasSubstr("want a table"));
}

TEST(Config, TellsOnlyTheFirstProblem) {
  EXPECT_THAT(problem("b = 1\n",
                      [](Table& t) {
                        (void)t.number("a");
                        (void)t.text("b");
                      }),
              HasSubstr("a: missing"));
}

TEST(Config, ReadsStayInRangeAfterAnError) {
  const auto document = Document::parse("", "car.toml");
  Table root = document.value().root();
  EXPECT_EQ(root.number("mass_kg", {500.0, 9000.0}), 500.0);
  EXPECT_EQ(root.numbers("arms", {1.0, 2.0}, 3).size(), 3U);
  EXPECT_EQ(root.table("road").number("w", {2.0, 3.0}), 2.0);
}

TEST(Config, ARuleOverSeveralKeysCanBeRejected) {
  EXPECT_EQ(problem("a = 1\nb = 2",
                    [](Table& t) {
                      (void)t.number("a");
                      (void)t.number("b");
                      t.reject("b", "want less than a");
                    }),
            "car.toml:2: b: want less than a");
}

TEST(Config, SaysWhereItIsNotToml) {
  EXPECT_THAT(problem("a = 1\nb = = 2", [](Table&) {}), HasSubstr("car.toml:2: not TOML:"));
}

TEST(Config, RefusesWhatIsNestedDeeply) {
  std::string dotted = "b = 1\na";
  for (int i = 0; i < 30'000; ++i) {
    dotted += ".a";
  }
  EXPECT_EQ(problem(dotted + " = 1", [](Table&) {}),
            "car.toml:2: want keys of at most 32 parts, got one of more");
  EXPECT_EQ(problem("[" + dotted.substr(6) + "]", [](Table&) {}),
            "car.toml:1: want keys of at most 32 parts, got one of more");
  EXPECT_EQ(problem("b = 1\na = " + std::string(30'000, '['), [](Table&) {}),
            "car.toml:2: want arrays and tables within each other at most 32 deep, got more");
}

TEST(Config, RefusesATextWithoutEnd) {
  const auto read = [](Table& t) { (void)t.text("a"); };
  EXPECT_EQ(problem("a = \"" + std::string(65'536, 'x') + "\"", read), "");
  EXPECT_EQ(problem("a = \"" + std::string(65'537, 'x') + "\"", read),
            "car.toml:1: a: want a text of at most 65536 bytes, got 65537");
}

TEST(Config, ShowsOfWhatCameOneShortLine) {
  const std::string key(50'000, 'k');
  EXPECT_LT(problem(key + " = 1", [](Table&) {}).size(), 200U);
  const std::string message =
      problem("schema = \"a\\n\\u001b[2J" + key + "\"", [](Table& t) { t.want_schema("b"); });
  EXPECT_THAT(message, testing::StartsWith("car.toml:1: schema: want \"b\", got \"a  [2Jkkk"));
  EXPECT_LT(message.size(), 600U);
}

}  // namespace
}  // namespace saca::config::config_test
