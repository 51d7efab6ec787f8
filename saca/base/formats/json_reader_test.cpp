#include "saca/base/formats/json_reader.h"

#include <gtest/gtest.h>

#include <array>

namespace saca::formats::json_reader_test {
namespace {

using nlohmann::json;

/// What a reader remembers after `read` has read this text.
template <class Read>
std::string problem_of(const char* text, Read&& read) {
  const json node = json::parse(text);
  std::optional<Error> problem;
  JsonReader reader(node, "", problem, "tape");
  read(reader);
  return problem ? problem->message : "";
}

TEST(JsonReader, ReadsWhatIsThere) {
  const json node = json::parse(
      R"({"a": 0.1, "b": true, "c": "x", "d": 7, "e": null, "f": [1, -2.5], "g": {"h": 3}})");
  std::optional<Error> problem;
  JsonReader reader(node, "", problem);
  EXPECT_EQ(reader.number("a"), 0.1);
  EXPECT_TRUE(reader.flag("b"));
  EXPECT_EQ(reader.text("c"), "x");
  EXPECT_EQ(reader.integer("d"), 7U);
  EXPECT_FALSE(reader.has_value("e"));
  std::array<double, 2> numbers{};
  reader.numbers("f", numbers);
  EXPECT_EQ(numbers, (std::array{1.0, -2.5}));
  EXPECT_EQ(reader.object("g").integer("h"), 3U);
  reader.refuse_others();
  EXPECT_FALSE(problem) << problem->message;
}

TEST(JsonReader, TakesIntegersThatAProgramMade) {
  const json node{{"a", std::int64_t{7}}, {"b", std::int64_t{-7}}};
  std::optional<Error> problem;
  JsonReader reader(node, "", problem);
  EXPECT_EQ(reader.integer("a", 7), 7U);
  EXPECT_FALSE(problem);
  (void)reader.integer("b");
  EXPECT_TRUE(problem);
}

TEST(JsonReader, NamesKeyWantedAndGot) {
  EXPECT_EQ(problem_of("{}", [](JsonReader& r) { (void)r.number("a_m"); }), "a_m: is missing");
  EXPECT_EQ(problem_of(R"({"a_m": "5"})", [](JsonReader& r) { (void)r.number("a_m"); }),
            "a_m: want a finite number, got \"5\"");
  EXPECT_EQ(problem_of(R"({"a": 256})", [](JsonReader& r) { (void)r.integer("a", 255); }),
            "a: want an integer from 0 to 255, got 256");
  EXPECT_EQ(problem_of(R"({"a": -1})", [](JsonReader& r) { (void)r.integer("a", 255); }),
            "a: want an integer from 0 to 255, got -1");
  EXPECT_EQ(problem_of(R"({"a": 1})", [](JsonReader& r) { (void)r.flag("a"); }),
            "a: want true or false, got 1");
  EXPECT_EQ(problem_of(R"({"a": 1})", [](JsonReader& r) { (void)r.text("a"); }),
            "a: want a text, got 1");
  EXPECT_EQ(problem_of(R"({"a": [1, 2, 3]})", [](JsonReader& r) { (void)r.list("a", 2); }),
            "a: want at most 2, got 3");
  EXPECT_EQ(problem_of(R"({"b": {"c": []}})",
                       [](JsonReader& r) {
                         std::array<double, 1> one{};
                         r.object("b").numbers("c", one);
                       }),
            "b.c: want 1 finite numbers, got []");
  EXPECT_EQ(problem_of(R"({"a": [{}, 4]})",
                       [](JsonReader& r) {
                         const json& all = *r.list("a");
                         (void)r.element("a", all, 1);
                       }),
            "a[1]: want an object, got 4");
  EXPECT_EQ(problem_of("[]", [](JsonReader&) {}), "tape: want an object, got []");
  EXPECT_EQ(problem_of(R"({"a": null})",
                       [](JsonReader& r) {
                         (void)r.has_value("a");
                         (void)r.has_value("b");
                       }),
            "b: is missing");
}

TEST(JsonReader, WantsTheSchemaByWhichItReads) {
  const auto read = [](JsonReader& r) {
    r.schema("saca.scene/1");
    r.refuse_others();
  };
  EXPECT_EQ(problem_of(R"({"schema": "saca.scene/1"})", read), "");
  EXPECT_EQ(problem_of(R"({"schema": "saca.scene/2"})", read),
            "schema: want saca.scene/1, got \"saca.scene/2\"");
  EXPECT_EQ(problem_of(R"({"schema": 1})", read), "schema: want saca.scene/1, got 1");
  EXPECT_EQ(problem_of("{}", read), "schema: is missing");
}

TEST(JsonReader, RefusesWhatNobodyAskedFor) {
  EXPECT_EQ(problem_of(R"({"a": 1, "b": 2})",
                       [](JsonReader& r) {
                         (void)r.number("a");
                         r.refuse_others();
                       }),
            "b: is not known");
}

TEST(JsonReader, KeepsTheFirstProblem) {
  EXPECT_EQ(problem_of("{}",
                       [](JsonReader& r) {
                         (void)r.number("first");
                         (void)r.number("second");
                         r.reject("third", "want nothing");
                       }),
            "first: is missing");
}

}  // namespace
}  // namespace saca::formats::json_reader_test
