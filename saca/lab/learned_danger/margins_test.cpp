#include "saca/lab/learned_danger/margins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>

namespace saca::learned_danger::margins_test {
namespace {

// The chance of at most k hits in n at the bound is what is left of the confidence.
TEST(Margins, BoundIsExactForSharesThatWereCounted) {
  EXPECT_NEAR(upper_bound({0, 13'809}, 1.0 - 1e-6), 1e-3, 1e-6) << "1 - (1e-6)^(1/n)";
  EXPECT_NEAR(upper_bound({5, 10}, 0.95), 0.7776, 1e-4) << "Clopper and Pearson's table";
  EXPECT_EQ(upper_bound({10, 10}, 0.95), 1.0);
  EXPECT_EQ(upper_bound({0, 0}, 0.95), 1.0);
}

TEST(Margins, BinsHaveNamesOfTheirOwn) {
  EXPECT_EQ(bin_names()[bin_of(true, 19.9, 0.3, 1)], "straight.below_20_mps.slippery.one");
  EXPECT_EQ(bin_names()[bin_of(false, 20.0, 0.5, 2)], "turning.from_20_mps.good_grip.several");
  EXPECT_EQ(bin_names()[bin_of(true, 29.9, 0.49, 3)], "straight.from_20_mps.slippery.several");
  EXPECT_EQ(bin_names()[bin_of(false, 0.0, 1.0, 1)], "turning.below_20_mps.good_grip.one");
  EXPECT_EQ(std::set<std::string>(bin_names().begin(), bin_names().end()).size(), num_bins);
}

// 20,000 situations at each of three levels; hits only where 1 m or less is told.
TEST(Margins, TheLeastWithWhichHitsAreRare) {
  PredictedSafe told;
  for (int i = 0; i < 20'000; ++i) {
    told.add(-0.31, i < 300);
    told.add(-1.01, i < 200);
    told.add(-7.0, false);
  }
  // 200 of 40,000 are too many; 0 of 20,000 are few enough.
  ASSERT_TRUE(told.margin().has_value());
  EXPECT_NEAR(*told.margin(), 1.05, 1e-9);
  EXPECT_EQ(told.hits_with(21).count, 0);
  EXPECT_EQ(told.hits_with(20).count, 200);
  EXPECT_EQ(told.hits_with(0).of, 60'000);
}

TEST(Margins, AreNoneWithoutEnoughTrials) {
  PredictedSafe few;
  for (int i = 0; i < 10'000; ++i) {
    few.add(-20.0, false);
  }
  EXPECT_FALSE(few.margin().has_value()) << "13,809 are needed";
  PredictedSafe none_is_hit;
  for (int i = 0; i < 14'000; ++i) {
    none_is_hit.add(-20.0, false);
  }
  EXPECT_EQ(none_is_hit.margin(), 0.0);
}

// At 0.1 % four of 400 have a chance of 0.08 %, three one of 0.8 %.
TEST(Margins, ABinWithTooManyHitsOfTheFarthestNeedNotBeCountedOn) {
  const auto told = [](int hits, double metres) {
    PredictedSafe all;
    for (int i = 0; i < 400; ++i) {
      all.add(-metres, i < hits);
    }
    return all;
  };
  EXPECT_FALSE(told(4, 6.0).may_have_margin());
  EXPECT_TRUE(told(3, 6.0).may_have_margin());
  EXPECT_TRUE(told(400, 4.0).may_have_margin()) << "5 m may be enough";
  EXPECT_TRUE(PredictedSafe().may_have_margin());
}

// What a margin leaves out is told safe by it or less: no rounding lets a hit through.
TEST(Margins, LeaveOutWhatTheyAreFittedTo) {
  for (const double told : {-0.05, -0.1, -0.15, -0.149999, -1.0, -2.35}) {
    PredictedSafe all;
    all.add(told, true);
    std::size_t level = 0;
    while (level < PredictedSafe::num_levels && all.hits_with(level).count > 0) {
      ++level;
    }
    const double margin = PredictedSafe::step * static_cast<double>(level);
    EXPECT_GE(told + margin, 0.0) << told;
    EXPECT_LE(told + margin, PredictedSafe::step + 1e-9) << told;
  }
}

TEST(Margins, CountsComeBackFromTheirNumbers) {
  PredictedSafe told;
  told.add(-0.3, true);
  told.add(-9.0, false);
  const auto back = PredictedSafe::from(told.numbers());
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->numbers(), told.numbers());
  EXPECT_FALSE(PredictedSafe::from({1, 2, 3}).has_value());
  std::vector<int> more_hits = told.numbers();
  more_hits[PredictedSafe::num_levels] = 1;
  EXPECT_FALSE(PredictedSafe::from(more_hits).has_value());
}

TEST(Margins, StandAmongTheWords) {
  std::array<double, num_bins> metres{};
  for (std::size_t i = 0; i < num_bins; ++i) {
    metres[i] = 0.05 * static_cast<double>(i);
  }
  metres[3] = Margins::none;
  std::map<std::string, std::string> words{{"car", "any"}};
  EXPECT_FALSE(Margins::from(words, "w").value().has_value());
  Margins(metres).add_to(words);
  const auto back = Margins::from(words, "w");
  ASSERT_TRUE(back.has_value() && back.value().has_value());
  EXPECT_NEAR(back.value()->at(true, 35.0, 0.8, 2), 0.35, 1e-9);
  EXPECT_EQ(back.value()->at(true, 5.0, 0.8, 2), Margins::none);

  words["margin.straight.below_20_mps.slippery.one"] = "much";
  EXPECT_NE(
      Margins::from(words, "some.file").error().message.find("some.file: margin.straight.below_20"),
      std::string::npos);
  words.erase("margin.straight.below_20_mps.slippery.one");
  EXPECT_NE(Margins::from(words, "w").error().message.find("1 are missing"), std::string::npos);
}

}  // namespace
}  // namespace saca::learned_danger::margins_test
