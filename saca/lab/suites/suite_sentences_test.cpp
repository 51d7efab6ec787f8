#include "saca/lab/suites/suite_sentences.h"

#include <gmock/gmock.h>

#include "saca/lab/suites/rows_for_test.h"

namespace saca::suites::suite_sentences_test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> told(const SuiteRun& run) {
  return sentences_of(run, result_of(run, 1));
}

// In each of ten encounters 0.2 or 0.3 less than braking: no bootstrap sample says otherwise.
TEST(SuiteSentences, ABetterMethodIsSaidToBe) {
  std::vector<eval::SuiteRow> rows;
  for (std::uint64_t k = 0; k < 10; ++k) {
    rows.push_back(made_row(k, "a", {0.1, k % 2 == 0 ? 0.3 : 0.4}, 0.1));
  }
  rows.push_back(failed_row(10, "b", "no road"));  // of this family there is nothing to say
  const auto lines = told(made_run({"saca", "aeb"}, rows));
  EXPECT_THAT(lines[0], HasSubstr("does 0.1000 harm per encounter, emergency braking at T1 0.3500: "
                                  "it is better (difference -0.2500 ("));
  EXPECT_THAT(lines[1], HasSubstr("In 10 of 10 encounters it does materially less harm (by more "
                                  "than 0.005), in 0 materially more"));
  EXPECT_EQ(lines[2], "Better than braking in: a (-0.2500). Worse in: no family.");
  EXPECT_THAT(lines[3], HasSubstr("is 0.0000 for "));
}

TEST(SuiteSentences, WhatMayBeChanceIsCalledSo) {
  const auto lines = told(made_run(
      {"saca", "aeb"}, {made_row(0, "a", {0.1, 0.3}, 0.0), made_row(1, "a", {0.3, 0.1}, 0.0)}));
  EXPECT_THAT(lines[0], HasSubstr("the difference may be chance"));
  EXPECT_EQ(lines[2], "Better than braking in: no family. Worse in: no family.");
}

// Of one encounter all bootstrap samples are alike: that says nothing.
TEST(SuiteSentences, OneEncounterIsNoProof) {
  const auto lines = told(made_run({"saca", "aeb"}, {made_row(0, "a", {0.1, 0.35}, 0.1)}));
  EXPECT_THAT(lines[0], HasSubstr("the difference may be chance"));
  EXPECT_EQ(lines[2], "Better than braking in: no family. Worse in: no family.");
  const auto alike = told(made_run({"saca", "aeb"}, {made_row(0, "a", {0.1, 0.1}, 0.1)}));
  EXPECT_THAT(alike[0], HasSubstr("the same (difference"));
}

TEST(SuiteSentences, WithoutBrakingOnlyRegretIsTold) {
  const auto lines = told(made_run({"saca", "oracle"}, {made_row(0, "a", {0.25, 0.0}, 0.0)}));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_THAT(lines[0], HasSubstr("is 0.2500 for "));
  // The oracle loses less, but knows the truth.
  EXPECT_THAT(lines[1], HasSubstr("has the least: 0.2500"));
}

TEST(SuiteSentences, OfYardsticksNobodyIsPraised) {
  EXPECT_THAT(told(made_run({"oracle"}, {made_row(0, "a", {0.0}, 0.0)})),
              Not(Contains(HasSubstr("has the least"))));
}

}  // namespace
}  // namespace saca::suites::suite_sentences_test
