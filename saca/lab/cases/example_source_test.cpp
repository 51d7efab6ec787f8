#include "saca/lab/cases/example_source.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "saca/base/core/file.h"
#include "saca/lab/cases/cases_for_test.h"

namespace saca::cases::example_source_test {
namespace {

using testing::HasSubstr;

const std::filesystem::path scenarios = "scenarios";

CaseFile file_of(std::vector<CrashCase> cases) {
  return {.cases = std::move(cases), .hash = {}};
}

/// One that may be an example, one that was recorded, and one of a family for tests alone.
std::vector<CrashCase> three_cases() {
  std::vector<CrashCase> cases(3, case_by_hand());
  cases[1].kind.reset();
  cases[2].kind = "cyclist";
  return cases;
}

TEST(ExampleSourceTest, OptionsReadAsTheyWereTyped) {
  EXPECT_EQ(example_text({.file = "a.jsonl"}), "--car compact_rwd_ev --seed 1");
  EXPECT_EQ(example_text({.file = "a.jsonl", .memory = "b.db", .car = "c", .cues = "d", .seed = 5}),
            "--car c --seed 5 --memory b.db --cues d");
}

TEST(ExampleSourceTest, ReadsAFileOfCases) {
  const std::string file = testing::TempDir() + "/example_source.jsonl";
  ASSERT_FALSE(write_file(file, crash_cases_text(three_cases())).has_value());
  const CaseFile read = read_cases(file).value();
  EXPECT_EQ(read.cases.size(), 3U);
  EXPECT_EQ(read.hash.value(), fnv1a(crash_cases_text(three_cases())));
  ASSERT_FALSE(write_file(file, "no case").has_value());
  EXPECT_THAT(read_cases(file).error().message, HasSubstr("example_source.jsonl"));
  EXPECT_THAT(read_cases("no_such.jsonl").error().message, HasSubstr("no_such.jsonl"));
}

TEST(ExampleSourceTest, LeavesOutWhatIsRecordedOrForTests) {
  const auto source =
      open_examples(file_of(three_cases()), {.file = "a.jsonl"}, shipped().tools(), scenarios);
  ASSERT_TRUE(source.has_value()) << source.error().message;
  EXPECT_EQ(source.value().cases.size(), 1U);
  EXPECT_EQ(source.value().recorded, 1);
  EXPECT_EQ(source.value().test_only, 1);
  EXPECT_FALSE(source.value().told.has_value());
  EXPECT_FALSE(source.value().cues.has_value());
}

TEST(ExampleSourceTest, CuesAreOfASuiteAndPartOfTheDigest) {
  const auto open = [](const std::string& cues) {
    return open_examples(file_of(three_cases()), {.file = "a.jsonl", .cues = cues},
                         shipped().tools(), scenarios);
  };
  ASSERT_TRUE(open("cues").has_value());
  EXPECT_TRUE(open("cues").value().cues.has_value());
  EXPECT_NE(open("cues").value().digest, open("").value().digest);
  EXPECT_THAT(open("no_such").error().message, HasSubstr("--cues: no_such"));
}

TEST(ExampleSourceTest, SaysWhyThereIsNone) {
  std::vector<CrashCase> cases = three_cases();
  cases.erase(cases.begin());
  EXPECT_EQ(
      open_examples(file_of(cases), {.file = "a.jsonl"}, shipped().tools(), scenarios)
          .error()
          .message,
      "a.jsonl: want cases that were drawn from families of the tuning split, got 1 recorded ones "
      "and 1 of families for tests");
  EXPECT_THAT(open_examples(file_of(three_cases()), {.file = "a.jsonl", .memory = "no_such.db"},
                            shipped().tools(), scenarios)
                  .error()
                  .message,
              HasSubstr("no_such.db"));
  EXPECT_THAT(
      open_examples(file_of(three_cases()), {}, shipped().tools(), "no_such").error().message,
      HasSubstr("splits.toml"));
}

}  // namespace
}  // namespace saca::cases::example_source_test
