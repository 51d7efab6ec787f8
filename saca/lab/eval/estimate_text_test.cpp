#include "saca/lab/eval/estimate_text.h"

#include <gtest/gtest.h>

namespace saca::eval::estimate_text_test {
namespace {

TEST(EstimateText, IsItsMeanWithTheInterval) {
  const Estimate quarter{.value = 0.25, .low = 0.125, .high = 0.5, .n = 8};
  EXPECT_EQ(with_interval(quarter, 3), "0.250 (0.125 to 0.500)");
  EXPECT_EQ(with_interval(quarter, 1, 100.0), "25.0 (12.5 to 50.0)");
  EXPECT_EQ(with_interval(quarter, 0, 100.0), "25 (12 to 50)") << "of two as near the even one";
  EXPECT_EQ(percent_of(quarter), "25.0");
  EXPECT_EQ(with_interval({}, 3), "-");
  EXPECT_EQ(percent_of({}), "-");
}

TEST(EstimateText, ItsFiguresHaveItsName) {
  nlohmann::json figures;
  add_estimate(figures, "harm", {.value = 0.25, .low = -0.5, .high = 1.0, .n = 8});
  add_estimate(figures, "nothing", {});
  EXPECT_EQ(figures,
            (nlohmann::json{{"harm", 0.25}, {"harm.lo", -0.5}, {"harm.hi", 1.0}, {"harm.n", 8}}));
}

}  // namespace
}  // namespace saca::eval::estimate_text_test
