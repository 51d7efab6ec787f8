#include "saca/core/spsc_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <random>
#include <thread>

namespace saca {
namespace {

TEST(SpscQueue, IsEmptyAtFirst) {
  SpscQueue<int, 3> queue;
  int value = 7;
  EXPECT_FALSE(queue.pop(value));
  EXPECT_EQ(value, 7);
}

TEST(SpscQueue, HoldsAsMuchAsItSaysAndNoMore) {
  SpscQueue<int, 3> queue;
  EXPECT_TRUE(queue.push(1));
  EXPECT_TRUE(queue.push(2));
  EXPECT_TRUE(queue.push(3));
  EXPECT_FALSE(queue.push(4));
  int value = 0;
  for (int i = 1; i <= 3; ++i) {
    ASSERT_TRUE(queue.pop(value));
    EXPECT_EQ(value, i);
  }
  EXPECT_FALSE(queue.pop(value));
}

// Oracle: std::deque under the same pushes and pops.
TEST(SpscQueue, KeepsTheOrder) {
  std::mt19937 rng(1);
  SpscQueue<int, 5> queue;
  std::deque<int> expected;
  for (int i = 0; i < 10'000; ++i) {
    if (rng() % 2 == 0) {
      const bool has_room = expected.size() < queue.capacity();
      ASSERT_EQ(queue.push(i), has_room);
      if (has_room) {
        expected.push_back(i);
      }
    } else {
      int value = -1;
      ASSERT_EQ(queue.pop(value), !expected.empty());
      if (!expected.empty()) {
        ASSERT_EQ(value, expected.front());
        expected.pop_front();
      }
    }
  }
}

using Wide = std::array<std::uint64_t, 16>;
constexpr std::uint64_t num_values = 50'000;

TEST(SpscQueue, LosesDoublesAndTearsNothingBetweenThreads) {
  SpscQueue<Wide, 7> queue;
  std::jthread producer([&queue] {
    Wide value{};
    for (std::uint64_t i = 1; i <= num_values; ++i) {
      value.fill(i);
      while (!queue.push(value)) {
        std::this_thread::yield();
      }
    }
  });
  Wide value{};
  int num_wrong = 0;
  for (std::uint64_t i = 1; i <= num_values; ++i) {
    while (!queue.pop(value)) {
      std::this_thread::yield();
    }
    num_wrong +=
        std::all_of(value.begin(), value.end(), [i](std::uint64_t word) { return word == i; }) ? 0
                                                                                               : 1;
  }
  EXPECT_EQ(num_wrong, 0);
  EXPECT_FALSE(queue.pop(value));
}

}  // namespace
}  // namespace saca
