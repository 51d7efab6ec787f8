#include "saca/lab/policy_study/whatif_picture.h"

#include <gmock/gmock.h>

#include "saca/lab/policy_study/whatif_for_test.h"
#include "saca/lab/report/xml_for_test.h"

namespace saca::policy_study::whatif_picture_test {
namespace {

TEST(WhatifPicture, OverOneNumberItIsAStripWithACurveForEachPolicy) {
  const MapByHand hand;
  const auto all = report::xml_elements(whatif_svg(hand.map()));
  EXPECT_TRUE(report::says(all, "Which policy is best"));
  EXPECT_TRUE(report::says(all, "A standing car"));
  EXPECT_TRUE(report::says(all, "All eight begin at 2.00 s; everything else is where it was."));
  EXPECT_TRUE(report::says(all, "ego.speed [m/s]")) << "the unit leaves the name";
}

TEST(WhatifPicture, OverTwoItIsAMapThatNamesBoth) {
  const MapByHand hand;
  const auto all = report::xml_elements(whatif_svg(hand.with_two_axes()));
  EXPECT_TRUE(report::says(all, "ego.speed [m/s]"));
  EXPECT_TRUE(report::says(all, "grip [-]"));
  EXPECT_FALSE(report::with_class(all, "rect", "no-risk").empty());
}

}  // namespace
}  // namespace saca::policy_study::whatif_picture_test
