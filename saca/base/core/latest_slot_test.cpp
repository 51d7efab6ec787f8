#include "saca/base/core/latest_slot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <thread>

namespace saca::latest_slot_test {
namespace {

TEST(LatestSlot, HasNothingAtFirst) {
  LatestSlot<int> slot;
  int value = 7;
  EXPECT_FALSE(slot.take(value));
  EXPECT_EQ(value, 7);
}

TEST(LatestSlot, GivesEachValueOnce) {
  LatestSlot<int> slot;
  int value = 0;
  for (int i = 1; i < 10; ++i) {
    slot.publish(i);
    ASSERT_TRUE(slot.take(value));
    EXPECT_EQ(value, i);
    EXPECT_FALSE(slot.take(value));
  }
}

TEST(LatestSlot, GivesTheNewestOfSeveral) {
  LatestSlot<int> slot;
  int value = 0;
  for (int burst = 1; burst < 8; ++burst) {
    for (int i = 1; i <= burst; ++i) {
      slot.publish(10 * burst + i);
    }
    ASSERT_TRUE(slot.take(value));
    EXPECT_EQ(value, 11 * burst);
    EXPECT_FALSE(slot.take(value));
  }
}

// A value of several cache lines, every word of which says which one it is.
using Wide = std::array<std::uint64_t, 64>;
constexpr std::uint64_t num_values = 50'000;

TEST(LatestSlot, CarriesWholeValuesEverNewerBetweenThreads) {
  LatestSlot<Wide> slot;
  std::jthread producer([&slot] {
    Wide value{};
    for (std::uint64_t i = 1; i <= num_values; ++i) {
      value.fill(i);
      slot.publish(value);
    }
  });
  Wide value{};
  std::uint64_t newest = 0;
  int num_torn = 0;
  int num_older = 0;
  while (newest < num_values) {  // the last one always arrives
    if (slot.take(value)) {
      const auto differs = [&](std::uint64_t word) { return word != value[0]; };
      num_torn += std::any_of(value.begin(), value.end(), differs) ? 1 : 0;
      num_older += value[0] <= newest ? 1 : 0;
      newest = value[0];
    }
  }
  EXPECT_EQ(num_torn, 0);
  EXPECT_EQ(num_older, 0);
  EXPECT_EQ(newest, num_values);
  EXPECT_FALSE(slot.take(value));
}

}  // namespace
}  // namespace saca::latest_slot_test
