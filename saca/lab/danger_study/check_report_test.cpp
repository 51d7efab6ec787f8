#include "saca/lab/danger_study/check_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace saca::danger_study::check_report_test {
namespace {

using learned_danger::CheckedCase;
using testing::HasSubstr;

/// At 10 m/s on good grip, beside one obstacle that braking straight does not evade.
CheckedCase one(double told, double acted, double best) {
  return {.speed = 10.0, .grip = 0.9, .told = told, .acted = acted, .best = best};
}

/// Two told safe, of which one is hit; a pincer of two obstacles that is told.
std::vector<CheckedCase> three() {
  CheckedCase pincer = one(0.5, 0.4, 0.3);
  pincer.num_obstacles = 2;
  pincer.told_alone = -0.5;
  pincer.is_pincer = true;
  return {one(-1.0, -1.5, -1.5), one(-0.25, 0.5, 0.5), pincer};
}

/// 0.3 m for the bin of `one`, none for all others.
learned_danger::Margins some_margins() {
  std::array<double, learned_danger::num_bins> metres{};
  metres.fill(learned_danger::Margins::none);
  metres[learned_danger::bin_of(false, 10.0, 0.9, 1)] = 0.3;
  return learned_danger::Margins(metres);
}

TEST(CheckReport, WithoutMarginsIsOfAllAndByObstacles) {
  const nlohmann::json all = json_of(check_report(three(), std::nullopt, 2.5));
  EXPECT_EQ(all.at("danger.net.us_batch32"), 2.5);
  EXPECT_EQ(all.at("danger.net.plain.hit_given_told_safe"), 0.5);
  EXPECT_EQ(all.at("danger.net.plain.hit_given_told_safe.n"), 2);
  EXPECT_GT(all.at("danger.net.plain.hit_given_told_safe.hi"), 0.99);  // two drives tell little
  EXPECT_EQ(all.at("danger.net.one.told_safe_given_hit"), 1.0);
  EXPECT_EQ(all.at("danger.net.several.told_safe_given_hit"), 0.0);
  EXPECT_EQ(all.at("danger.net.several.pincer.n"), 1);
  EXPECT_EQ(all.at("danger.net.several.pincer_told"), 1.0);
  EXPECT_EQ(all.at("danger.net.several.pincer_told_alone"), 0.0);
  EXPECT_FALSE(all.contains("danger.net.hit_given_told_safe"));
  EXPECT_EQ(all.size(), 1U + 3U * 21U);
}

TEST(CheckReport, WithMarginsHasEachBinAndAll) {
  const nlohmann::json all = json_of(check_report(three(), some_margins(), 2.5));
  // -0.25 + 0.3 is not safe any more: only the one that is safe is told so.
  EXPECT_EQ(all.at("danger.net.hit_given_told_safe"), 0.0);
  EXPECT_EQ(all.at("danger.net.hit_given_told_safe.n"), 1);
  EXPECT_EQ(all.at("danger.net.plain.hit_given_told_safe.n"), 2);
  EXPECT_EQ(all.at("danger.net.turning.below_20_mps.good_grip.one.margin_m"), 0.3);
  EXPECT_EQ(all.at("danger.net.turning.below_20_mps.good_grip.one.hit_given_told_safe.n"), 1);
  EXPECT_EQ(all.at("danger.net.straight.from_20_mps.slippery.several.margin_m"), 1000.0);
  EXPECT_FALSE(all.contains("danger.net.plain.margin_m"));
}

TEST(CheckReport, IsATableForPeople) {
  const std::string text = text_of(check_report(three(), some_margins(), 2.5));
  EXPECT_THAT(text, testing::StartsWith("a value takes 2.50 us, 32 at once\n"));
  EXPECT_THAT(text, HasSubstr("\nall, no margin                                   0    50.000 "));
  EXPECT_THAT(text, HasSubstr("\nturning.below_20_mps.good_grip.one            0.30     0.000 "));
  EXPECT_THAT(text, HasSubstr("\nturning.below_20_mps.good_grip.several        none     0.000 "));
  EXPECT_THAT(text, HasSubstr("\nall, each with its margin                              0.000 "));
  EXPECT_THAT(text, testing::EndsWith(
                        "\npincers, which each obstacle alone leaves a way out of: 1 of 1 "
                        "situations with several obstacles; told unsafe 1, by the highest single "
                        "value 1\n"));
  // The time, two lines of head, 1 + 16 + 1 + 2 rows, an empty line and the sentence.
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 25);
}

TEST(CheckReport, AMarginOfNothingIsTold) {
  std::array<double, learned_danger::num_bins> metres{};
  const std::string text = text_of(check_report(three(), learned_danger::Margins(metres), 2.5));
  EXPECT_THAT(text, HasSubstr("\nturning.below_20_mps.good_grip.one            0.00 "));
}

TEST(CheckReport, OfNothingHasNoShares) {
  const nlohmann::json all = json_of(check_report({}, std::nullopt, 1.0));
  EXPECT_EQ(all.at("danger.net.plain.hit_given_told_safe"), 0.0);
  EXPECT_EQ(all.at("danger.net.plain.hit_given_told_safe.n"), 0);
  EXPECT_EQ(all.at("danger.net.plain.hit_given_told_safe.hi"), 1.0);
}

}  // namespace
}  // namespace saca::danger_study::check_report_test
