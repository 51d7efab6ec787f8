#include "saca/lab/danger_study/margin_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace saca::danger_study::margin_report_test {
namespace {

using learned_danger::bin_of;
using testing::HasSubstr;

/// 20,000 of a bin that are told safe by 6 m and never hit, and 10 of another, half of them hit.
MarginCount counted() {
  MarginCount count{.situations = 50'000, .told = {}};
  for (int i = 0; i < 20'000; ++i) {
    count.told[bin_of(true, 10.0, 0.9, 1)].add(-6.0, false);
  }
  for (int i = 0; i < 10; ++i) {
    count.told[bin_of(false, 30.0, 0.3, 2)].add(-1.0, i < 5);
  }
  return count;
}

TEST(MarginReport, HasAMarginWhereOneIsShown) {
  const nlohmann::json all = json_of(margin_report(counted()));
  EXPECT_EQ(all.size(), 32U);
  EXPECT_EQ(all.at("danger.net.straight.below_20_mps.good_grip.one.margin_m"), 0.0);
  EXPECT_EQ(all.at("danger.net.straight.below_20_mps.good_grip.one.told_safe"), 20'000);
  EXPECT_EQ(all.at("danger.net.turning.from_20_mps.slippery.several.margin_m"), 1000.0);
  EXPECT_EQ(all.at("danger.net.turning.from_20_mps.slippery.several.told_safe"), 10);
  EXPECT_EQ(all.at("danger.net.turning.from_20_mps.slippery.one.told_safe"), 0);
}

TEST(MarginReport, HasALineForEachBin) {
  const std::string text = text_of(margin_report(counted()));
  EXPECT_THAT(text, HasSubstr("straight.below_20_mps.good_grip.one         0.00 m of  20000 told "
                              "safe     0 were hit\n"));
  EXPECT_THAT(text, HasSubstr("turning.from_20_mps.slippery.several          none of     10 told "
                              "safe     5 were hit\n"));
}

TEST(MarginReport, StandsAmongTheWordsOfWeights) {
  const formats::Tensors all =
      with_margins({.words = {{"car", "a"}}, .tensors = {}}, margin_report(counted()));
  EXPECT_EQ(all.words.at("car"), "a");
  EXPECT_EQ(all.words.at("margin.situations"), "50000");
  const auto margins = learned_danger::Margins::from(all.words, "w");
  ASSERT_TRUE(margins.has_value() && margins.value().has_value());
  EXPECT_EQ(margins.value()->at(true, 10.0, 0.9, 1), 0.0);
  EXPECT_EQ(margins.value()->at(false, 30.0, 0.3, 2), learned_danger::Margins::none);
}

}  // namespace
}  // namespace saca::danger_study::margin_report_test
