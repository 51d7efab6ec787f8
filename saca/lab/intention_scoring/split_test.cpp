#include "saca/lab/intention_scoring/split.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "saca/base/core/contract.h"

namespace saca::intention_scoring::split_test {
namespace {

Sequence sequence_of(const std::string& site, const std::string& group, std::size_t num_rare) {
  Sequence sequence{.name = group, .site = site, .group = group};
  sequence.labels.assign(50, 0);
  std::fill_n(sequence.labels.begin(), num_rare, std::uint8_t{3});
  return sequence;
}

std::vector<Sequence> many() {
  std::vector<Sequence> all;
  for (const std::string site : {"a", "b"}) {
    for (std::size_t group = 0; group < 20; ++group) {
      for (int k = 0; k < 3; ++k) {
        all.push_back(sequence_of(site, site + std::to_string(group), group));
      }
    }
  }
  return all;
}

TEST(Parts, NeverDivideAGroup) {
  const auto all = many();
  const auto parts = parts_of(all, 5);
  std::map<std::string, int> part_of;
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(part_of.emplace(all[i].group, parts[i]).first->second, parts[i]);
  }
}

TEST(Parts, HoldAboutAsMuchOfWhatIsRareOfEachSite) {
  const auto all = many();
  const auto parts = parts_of(all, 5);
  std::map<std::pair<std::string, int>, std::size_t> rare;
  for (std::size_t i = 0; i < all.size(); ++i) {
    rare[{all[i].site, parts[i]}] += static_cast<std::size_t>(
        std::count(all[i].labels.begin(), all[i].labels.end(), std::uint8_t{3}));
  }
  ASSERT_EQ(rare.size(), 10U);
  for (const auto& [key, count] : rare) {
    EXPECT_NEAR(static_cast<double>(count), 3.0 * 190.0 / 5.0, 12.0);  // 0 + ... + 19, three each
  }
}

TEST(Parts, DoNotDependOnTheOrder) {
  auto all = many();
  const auto parts = parts_of(all, 4);
  std::map<std::string, int> part_of;
  for (std::size_t i = 0; i < all.size(); ++i) {
    part_of[all[i].group] = parts[i];
  }
  std::reverse(all.begin(), all.end());
  const auto again = parts_of(all, 4);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(part_of[all[i].group], again[i]);
  }
}

TEST(Parts, SplitLosesNothing) {
  const auto all = many();
  std::set<std::string> tested;
  for (int part = 0; part < 3; ++part) {
    const Split split = split_off(all, part, 3);
    EXPECT_EQ(split.part.size() + split.rest.size(), all.size());
    for (const Sequence& each : split.part) {
      tested.insert(each.group);
    }
  }
  EXPECT_EQ(tested.size(), 40U);
  EXPECT_THROW((void)split_off(all, 3, 3), ContractViolation);
  EXPECT_TRUE(parts_of({}, 2).empty());
}

}  // namespace
}  // namespace saca::intention_scoring::split_test
