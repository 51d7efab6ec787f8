#include "saca/lab/cases/drawn_examples.h"

#include <gmock/gmock.h>

#include "saca/lab/cases/cases_for_test.h"

namespace saca::cases::drawn_examples_test {
namespace {

using manoeuvre::index;
using manoeuvre::PolicyId;
using testing::HasSubstr;

ExampleSource source_with(const std::string& cues = "") {
  return open_examples({.cases = {case_by_hand()}, .hash = {}}, {.file = "a.jsonl", .cues = cues},
                       shipped().tools(), "scenarios")
      .value();
}

TEST(DrawnExamplesTest, KnowOfTheEncounterWhatHappenedAndOfItsTwinNothing) {
  const DrawnExamples drawn = drawn_examples(case_by_hand(), source_with(), 1);
  EXPECT_EQ(drawn.problem, "");
  ASSERT_FALSE(drawn.examples.empty());
  const ReplyExample& first = drawn.examples.front().example;
  EXPECT_EQ(first.record, "fars_2016_40001");
  EXPECT_EQ(first.family, "rear_end");
  EXPECT_FALSE(first.is_twin);
  EXPECT_EQ(first.known.at(index(PolicyId::aeb)), 0.2);
  EXPECT_FALSE(first.known.at(index(PolicyId::no_intervention)).has_value());
  EXPECT_FALSE(first.by_table.has_value());
  EXPECT_THAT(first.prompt, HasSubstr("Least harm:"));
  for (std::size_t i = 1; i < drawn.examples.size(); ++i) {
    EXPECT_TRUE(drawn.examples[i].example.is_twin);
    EXPECT_EQ(drawn.examples[i].example.known, memory::PolicyHarms{});
  }
}

TEST(DrawnExamplesTest, WithCuesHarmIsWhatTheirLawExpects) {
  const DrawnExamples drawn = drawn_examples(case_by_hand(), source_with("cues"), 1);
  EXPECT_EQ(drawn.problem, "");
  for (const DrawnExample& one : drawn.examples) {
    ASSERT_TRUE(one.example.by_table.has_value());
    EXPECT_TRUE(one.example.known.at(index(PolicyId::aeb)).has_value());
  }
}

TEST(DrawnExamplesTest, SayWhatCannotBeDrawn) {
  CrashCase recorded = case_by_hand();
  recorded.kind.reset();
  const DrawnExamples drawn = drawn_examples(recorded, source_with(), 1);
  EXPECT_TRUE(drawn.examples.empty());
  EXPECT_THAT(drawn.problem, HasSubstr("fars_2016_40001"));
}

}  // namespace
}  // namespace saca::cases::drawn_examples_test
