#include "saca/lab/policy_study/whatif_report.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "saca/lab/policy_study/whatif_for_test.h"

namespace saca::policy_study::whatif_report_test {
namespace {

using nlohmann::json;

TEST(WhatifReport, TheDocumentHasAxesAndCells) {
  const MapByHand hand;
  const json all = json_of(hand.map());
  EXPECT_EQ(all.at("schema"), "saca.whatif/1");
  EXPECT_EQ(all.at("scenario"), "standing_car");
  EXPECT_EQ(all.at("time_s"), 2.0);
  EXPECT_EQ(all.at("axes"),
            json::array({{{"what", "ego.speed_mps"}, {"values", {5.0, 10.0, 15.0}}}}));
  ASSERT_EQ(all.at("cells").size(), 3U);
  const json& first = all.at("cells").at(0);
  EXPECT_EQ(first.at("best"), 0);
  EXPECT_EQ(first.at("alone"), true);
  EXPECT_EQ(first.at("margin"), 0.2);
  EXPECT_EQ(first.at("contact"), false);
  EXPECT_EQ(first.at("harm"), json({0.25, 0.5, 0.5, nullptr, 0.5, 0.5, 0.5, 0.5}));
  EXPECT_TRUE(all.at("cells").at(2).is_null()) << "it cannot be";
}

TEST(WhatifReport, TheTextCounts) {
  const MapByHand hand;
  EXPECT_EQ(text_of(hand.map()),
            "A standing car, 3 scenes, from 2.00 s on\n"
            "  AEB    best in  33.3 %\n"
            "  NI     best in  33.3 %\n"
            "  ES-B-L cannot be driven in 1 of 3\n"
            "  1 of 3 cannot be: bodies would overlap, or a value is out of range\n");
}

}  // namespace
}  // namespace saca::policy_study::whatif_report_test
