#include "saca/base/core/static_vector.h"

#include <gtest/gtest.h>

#include <numeric>

namespace saca::static_vector_test {
namespace {

TEST(StaticVector, HoldsWhatWasPushed) {
  StaticVector<int, 3> numbers;
  EXPECT_TRUE(numbers.empty());
  numbers.push_back(4);
  numbers.push_back(5);
  EXPECT_EQ(numbers.size(), 2U);
  EXPECT_EQ(std::accumulate(numbers.begin(), numbers.end(), 0), 9);
}

TEST(StaticVector, RefusesOneTooManyAndReadingPastTheEnd) {
  StaticVector<int, 1> numbers;
  numbers.push_back(1);
  EXPECT_THROW(numbers.push_back(2), ContractViolation);
  EXPECT_THROW((void)numbers[1], ContractViolation);
}

TEST(StaticVector, IsEqualByWhatItHolds) {
  StaticVector<int, 3> one;
  StaticVector<int, 3> other;
  one.push_back(4);
  other.push_back(4);
  other.push_back(5);
  EXPECT_FALSE(one == other);
  one.push_back(5);
  EXPECT_TRUE(one == other);
  one.clear();
  other.clear();
  EXPECT_TRUE(one == other) << "what was held counts no more";
}

TEST(StaticVector, IsTriviallyCopyable) {
  EXPECT_TRUE((std::is_trivially_copyable_v<StaticVector<double, 8>>));
}

}  // namespace
}  // namespace saca::static_vector_test
