#include "saca/base/core/result.h"

#include <gtest/gtest.h>

#include <memory>

namespace saca::result_test {
namespace {

Result<int> half(int number) {
  if (number % 2 != 0) {
    return Error{Error::Code::out_of_range, "odd"};
  }
  return number / 2;
}

TEST(Result, HoldsAValue) {
  const Result<int> result = half(8);
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(result.value(), 4);
  EXPECT_THROW((void)result.error(), ContractViolation);
}

TEST(Result, HoldsAnError) {
  const Result<int> result = half(7);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, Error::Code::out_of_range);
  EXPECT_THROW((void)result.value(), ContractViolation);
}

TEST(Result, GivesAwayWhatCannotBeCopied) {
  Result<std::unique_ptr<int>> result = std::make_unique<int>(3);
  const std::unique_ptr<int> owned = std::move(result).value();
  EXPECT_EQ(*owned, 3);
}

}  // namespace
}  // namespace saca::result_test
