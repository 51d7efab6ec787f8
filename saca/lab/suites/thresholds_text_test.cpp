#include "saca/lab/suites/thresholds_text.h"

#include <gtest/gtest.h>

namespace saca::suites::thresholds_text_test {
namespace {

TEST(ThresholdsText, NothingIsToBeSaidOfWhatShips) {
  EXPECT_EQ(thresholds_arguments({}), "");
}

TEST(ThresholdsText, WhatDiffersIsAnArgument) {
  reflex::Thresholds changed;
  changed.trigger = 1.25;
  EXPECT_EQ(thresholds_arguments(changed), " --t1-s 1.25");
  changed.waiting_cost = 0.5;
  EXPECT_EQ(thresholds_arguments(changed), " --t1-s 1.25 --waiting-cost 0.5");
}

TEST(ThresholdsText, JournalsNameBothTimes) {
  reflex::Thresholds changed;
  changed.trigger = 1.25;
  changed.preview = 4.0;
  EXPECT_EQ(thresholds_text(changed), "T1 1.25 s, T2 4 s --t1-s 1.25");
}

}  // namespace
}  // namespace saca::suites::thresholds_text_test
