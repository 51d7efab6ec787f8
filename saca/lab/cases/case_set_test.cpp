#include "saca/lab/cases/case_set.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "saca/base/core/file.h"
#include "saca/lab/cases/cases_for_test.h"
#include "saca/thinking/memory/case_json.h"

namespace saca::cases::case_set_test {
namespace {

using manoeuvre::index;
using manoeuvre::PolicyId;
using testing::ElementsAre;

TEST(CaseSetTest, NumbersCasesAndKeepsProblems) {
  const CaseSet set = case_set({{.family = "rear_end", .problem = "a: not drivable"},
                                {.family = "rear_end", .made = case_by_hand("b")},
                                {.family = "crossing"},
                                {.family = "rear_end", .made = case_by_hand("d")}});
  ASSERT_EQ(set.cases.size(), 2U);
  EXPECT_EQ(set.cases[0].judged.one.id, 1);
  EXPECT_EQ(set.cases[1].judged.one.id, 2);
  EXPECT_EQ(set.cases[1].record.name, "d");
  EXPECT_THAT(set.problems, ElementsAre("a: not drivable"));
  EXPECT_TRUE(case_set({}).cases.empty());
}

TEST(CaseSetTest, DriversCasesSayWhatTheDriverDid) {
  CrashCase nobody = case_by_hand("a");
  CrashCase known = case_by_hand("b");
  known.judged.driver = PolicyId::es_b_right;
  known.judged.one.best_harm = 0.125;
  known.judged.one.happened.emplace();
  known.judged.one.happened->at(index(PolicyId::es_b_right)) = 0.5;
  CrashCase not_driven = known;  // by no plan of his policy
  not_driven.judged.one.happened->at(index(PolicyId::es_b_right)).reset();
  const std::vector<memory::Case> drivers = driver_cases({nobody, known, not_driven});
  ASSERT_EQ(drivers.size(), 2U);
  EXPECT_EQ(drivers[0].best, PolicyId::es_b_right);
  EXPECT_EQ(drivers[0].best_harm, 0.5);
  EXPECT_EQ(drivers[1].best_harm, 0.125);
  const std::vector<memory::Case> plain = memory_cases({nobody, known});
  ASSERT_EQ(plain.size(), 2U);
  EXPECT_EQ(plain[1].best, PolicyId::aeb);
  EXPECT_EQ(plain[1].best_harm, 0.125);
}

TEST(CaseSetTest, IsWrittenWhereItIsAskedFor) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "case_set";
  std::filesystem::remove_all(folder);
  const std::vector<CrashCase> cases{case_by_hand()};
  const auto place = [&](const char* file) { return (folder / file).string(); };
  ASSERT_FALSE(write_cases({.cases = place("a.jsonl")}, cases).has_value());
  EXPECT_EQ(read_file(folder / "a.jsonl").value(), crash_cases_text(cases));
  ASSERT_FALSE(write_cases({.cases = place("a.jsonl"),
                            .memory = place("memory.jsonl"),
                            .drivers = place("drivers.jsonl")},
                           cases)
                   .has_value());
  EXPECT_EQ(read_file(folder / "memory.jsonl").value(), memory::cases_text(memory_cases(cases)));
  EXPECT_EQ(read_file(folder / "drivers.jsonl").value(), memory::cases_text({}))
      << "no driver was recorded";
  EXPECT_EQ(write_cases({.cases = place("a.jsonl/b")}, cases)->code, Error::Code::unwritable);
}

}  // namespace
}  // namespace saca::cases::case_set_test
