#include "saca/lab/report/beside_exact.h"

#include <gtest/gtest.h>

#include "saca/base/core/contract.h"

namespace saca::report::beside_exact_test {
namespace {

danger::ValueAt plane(double off) {
  return [off](const danger::State& at) {
    return danger::LookupResult{-at[0] - at[3] + off, 0.0, true};
  };
}

TEST(BesideExact, IsAPictureThatShowsDifferences) {
  const BesideExact page{"table", "weights", {}, {5.0, 10.0}, 0.0};
  const auto same = beside_exact_png(page, plane(0.0), plane(0.0));
  const auto other = beside_exact_png(page, plane(0.0), plane(0.7));
  ASSERT_TRUE(same.has_value() && other.has_value());
  EXPECT_EQ(same.value().substr(1, 3), "PNG");
  EXPECT_NE(same.value(), other.value());
  EXPECT_EQ(same.value(), beside_exact_png(page, plane(0.0), plane(0.0)).value());
  EXPECT_THROW((void)beside_exact_png({}, plane(0.0), plane(0.0)), ContractViolation);
}

}  // namespace
}  // namespace saca::report::beside_exact_test
