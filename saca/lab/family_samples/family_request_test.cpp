#include "saca/lab/family_samples/family_request.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/lab/installation/here_for_test.h"

namespace saca::family_samples::family_request_test {
namespace {

using testing::HasSubstr;

class FamilyRequestTest : public testing::Test {
 protected:
  const installation::Installation here = installation::here_for_test();
};

TEST_F(FamilyRequestTest, DrawsAsManyFromTheFirstOn) {
  const auto all = drawn_family(here, {.name = "crossing", .count = 3});
  ASSERT_TRUE(all.has_value()) << all.error().message;
  ASSERT_EQ(all.value().scenarios.size(), 3U);
  EXPECT_EQ(all.value().sheet.scenes.size(), 3U);
  EXPECT_EQ(all.value().name, "crossing");
  const auto last = drawn_family(here, {.name = "crossing", .count = 1, .first = 2});
  EXPECT_EQ(scenario::write_scenario(last.value().scenarios[0]),
            scenario::write_scenario(all.value().scenarios[2]));
  const auto twin = drawn_family(here, {.name = "crossing", .count = 1, .first = 2, .twins = true});
  EXPECT_NE(scenario::write_scenario(twin.value().scenarios[0]),
            scenario::write_scenario(last.value().scenarios[0]));
}

TEST_F(FamilyRequestTest, SplitsHaveSeedsOfTheirOwnAndTheTestSplitALog) {
  const auto tuning = drawn_family(here, {.name = "crossing", .count = 1});
  const auto calibration =
      drawn_family(here, {.name = "crossing", .count = 1, .split = "calibration"});
  EXPECT_NE(tuning.value().seed, calibration.value().seed);
  EXPECT_THAT(drawn_family(here, {.name = "crossing", .count = 1, .split = "test"}).error().message,
              HasSubstr("(--test-log FILE)"));
}

TEST_F(FamilyRequestTest, WhatIsUnknownIsTold) {
  EXPECT_THAT(drawn_family(here, {.name = "crosing"}).error().message, HasSubstr("crossing"));
  EXPECT_THAT(drawn_family(here, {.name = "crossing", .cues = "none"}).error().message,
              HasSubstr("--cues: "));
  EXPECT_THAT(drawn_family(here, {.name = "crossing", .car = "none"}).error().message,
              HasSubstr("none: no car"));
}

}  // namespace
}  // namespace saca::family_samples::family_request_test
