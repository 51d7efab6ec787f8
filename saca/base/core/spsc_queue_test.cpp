#include "saca/base/core/spsc_queue.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <random>
#include <string>
#include <thread>

#include "tests/support/count_allocations.h"

namespace saca::spsc_queue_test {
namespace {

TEST(SpscQueue, HasNothingAtFirst) {
  SpscQueue<int> queue(3);
  EXPECT_EQ(queue.front(), nullptr);
  EXPECT_EQ(queue.pop(), std::nullopt);
  EXPECT_EQ(queue.num_rejected(), 0U);
}

// The same calls on a list without a bound, of which what does not fit is left out by hand.
TEST(SpscQueue, IsABoundedListWhateverTheOrderOfCalls) {
  constexpr std::size_t capacity = 5;
  std::mt19937 random(1);
  SpscQueue<std::string> queue(capacity);
  std::deque<std::string> list;
  std::size_t num_rejected = 0;
  for (int i = 0; i < 10'000; ++i) {
    if (random() % 2 == 0) {
      const std::string value =
          "a text that is longer than what fits without memory " + std::to_string(i);
      queue.push(value);
      if (list.size() < capacity) {
        list.push_back(value);
      } else {
        ++num_rejected;
      }
    } else if (list.empty()) {
      ASSERT_EQ(queue.pop(), std::nullopt);
    } else {
      ASSERT_EQ(*queue.front(), list.front());
      ASSERT_EQ(queue.pop(), list.front());
      list.pop_front();
    }
    ASSERT_EQ(queue.num_rejected(), num_rejected);
  }
  EXPECT_GT(num_rejected, 100U);
}

TEST(SpscQueue, MovesWhatCannotBeCopied) {
  SpscQueue<std::unique_ptr<int>> queue(1);
  queue.push(std::make_unique<int>(7));
  queue.push(std::make_unique<int>(8));  // does not fit
  EXPECT_EQ(**queue.pop(), 7);
  EXPECT_EQ(queue.front(), nullptr);
  EXPECT_EQ(queue.num_rejected(), 1U);
}

TEST(SpscQueue, NeedsRoomForOne) {
  EXPECT_THROW(SpscQueue<int>(0), ContractViolation);
}

// Values of several cache lines, every word of which says which one it is.
using Wide = std::array<std::uint64_t, 32>;

TEST(SpscQueue, AllocatesNothing) {
  SpscQueue<Wide> queue(4);
  const std::size_t before = num_allocations;
  for (int i = 0; i < 9; ++i) {
    queue.push({});
  }
  (void)queue.pop();
  EXPECT_EQ(num_allocations, before);
}

// Between threads: what comes out is whole, in order, and together with what was rejected all that
// was pushed.
TEST(SpscQueue, CarriesWholeValuesInOrderBetweenThreads) {
  constexpr std::uint64_t num_values = 50'000;
  SpscQueue<Wide> queue(16);
  std::jthread producer([&queue] {
    Wide value{};
    for (std::uint64_t i = 1; i <= num_values; ++i) {
      value.fill(i);
      queue.push(value);
    }
  });
  std::uint64_t num_taken = 0;
  std::uint64_t last = 0;
  int num_torn = 0;
  int num_out_of_order = 0;
  while (num_taken + queue.num_rejected() < num_values) {
    if (const auto value = queue.pop()) {
      for (const std::uint64_t word : *value) {
        num_torn += word == value->front() ? 0 : 1;
      }
      num_out_of_order += value->front() > last ? 0 : 1;
      last = value->front();
      ++num_taken;
    }
  }
  EXPECT_EQ(num_torn, 0);
  EXPECT_EQ(num_out_of_order, 0);
  EXPECT_GE(num_taken, 16U);
  EXPECT_EQ(queue.pop(), std::nullopt);
}

}  // namespace
}  // namespace saca::spsc_queue_test
