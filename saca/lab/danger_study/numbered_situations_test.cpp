#include "saca/lab/danger_study/numbered_situations.h"

#include <gtest/gtest.h>

#include <set>

namespace saca::danger_study::numbered_situations_test {
namespace {

std::vector<std::uint64_t> seeds(const NumberedSituations& all, int first, int count) {
  return worked_out<std::uint64_t>(all, first, count, [](std::uint64_t seed) { return seed; });
}

TEST(NumberedSituations, AreTheSameHoweverTheyAreParted) {
  const auto at_once = seeds({"check", 1, 1}, 0, 10);
  EXPECT_EQ(seeds({"check", 1, 3}, 0, 10), at_once);
  auto parted = seeds({"check", 1, 1}, 0, 4);
  for (const std::uint64_t seed : seeds({"check", 1, 1}, 4, 6)) {
    parted.push_back(seed);
  }
  EXPECT_EQ(parted, at_once);
  EXPECT_EQ(at_once[7], fnv1a("check 1 7"));
  EXPECT_TRUE(seeds({"check", 1, 1}, 3, 0).empty());
}

TEST(NumberedSituations, AreOthersOfAnotherNameOrSeed) {
  std::set<std::uint64_t> all;
  for (const NumberedSituations& one :
       {NumberedSituations{"check", 1, 1}, {"check", 2, 1}, {"margins", 1, 1}}) {
    for (const std::uint64_t seed : seeds(one, 0, 100)) {
      all.insert(seed);
    }
  }
  EXPECT_EQ(all.size(), 300U);
}

}  // namespace
}  // namespace saca::danger_study::numbered_situations_test
