#include "saca/lab/regulation/constant_in_words.h"

#include <gmock/gmock.h>

#include "saca/lab/regulation/run_for_test.h"

namespace saca::regulation::constant_in_words_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(ConstantInWords, SaysWhichTestsFailAndWhereWorst) {
  RegulationRun run = some_run();
  run.elsewhere.push_back(on_the_second_surface());
  EXPECT_THAT(
      constant_in_words(run),
      ElementsAre(
          "Full braking at the paper's T1 = 1.3 s would not be allowed on the road: it fails 3 of "
          "6 "
          "tests, at worst with an impact of 12.0 m/s. Where the driver brakes one second after a "
          "warning, it passes all 2 tests: nobody is warned before T1, and then the driver comes "
          "too late.",
          "A car stands (7.1): small fails 1 of 2, worst at 72 km/h: hits with 8.0 m/s; large "
          "fails 2 of 2, worst at 72 km/h: hits with 12.0 m/s.",
          "On a surface with friction coefficient 0.5 (6.2), without the driver's brake: small "
          "passes all 3 tests; large fails 1 of 3 tests, at worst with an impact of 15.0 m/s."));
}

TEST(ConstantInWords, WhatPassesAllIsOneSentence) {
  const RegulationRun run = tests_of(some_run().regulation, {"small"}, {"aeb"});
  EXPECT_THAT(constant_in_words(run),
              ElementsAre("Full braking at the paper's T1 = 1.3 s passes all 4 tests that were "
                          "run."));
}

TEST(ConstantInWords, WithoutBrakingThereIsNothingToSay) {
  EXPECT_THAT(constant_in_words(tests_of(some_run().regulation, {"small"}, {"nothing"})),
              IsEmpty());
}

TEST(ConstantInWords, EveryVerdictHasItsWords) {
  using eval::TestVerdict;
  EXPECT_EQ(failure_of({.verdict = TestVerdict::passed}), "");
  EXPECT_EQ(failure_of({.verdict = TestVerdict::contact, .impact_speed = 7.25}),
            "hits with 7.2 m/s");
  EXPECT_THAT(failure_of({.verdict = TestVerdict::no_braking}), HasSubstr("does not brake"));
  EXPECT_EQ(failure_of({.verdict = TestVerdict::false_reaction, .peak_deceleration = 3.0}),
            "acts, decelerates by 3.0 m/s2");
  EXPECT_EQ(failure_of({.verdict = TestVerdict::fault}), "could not be played");
}

}  // namespace
}  // namespace saca::regulation::constant_in_words_test
