#include "saca/lab/suites/estimates.h"

#include <gtest/gtest.h>

namespace saca::suites::estimates_test {
namespace {

using nlohmann::json;

constexpr eval::Estimate quarter{.value = 0.25, .low = 0.125, .high = 0.5, .n = 8};

TEST(Estimates, AreReadWithTheirIntervals) {
  EXPECT_EQ(with_interval(quarter, 3), "0.250 (0.125 to 0.500)");
  EXPECT_EQ(with_interval(quarter, 1, 100.0), "25.0 (12.5 to 50.0)");
  EXPECT_EQ(percent_of(quarter), "25.0");
}

TEST(Estimates, ADashStandsForNone) {
  EXPECT_EQ(with_interval({}, 3), "-");
  EXPECT_EQ(percent_of({}), "-");
}

TEST(Estimates, AreFourNumbersForPrograms) {
  json out = json::object();
  add_estimate(out, "a.harm", quarter);
  EXPECT_EQ(out,
            json({{"a.harm", 0.25}, {"a.harm.lo", 0.125}, {"a.harm.hi", 0.5}, {"a.harm.n", 8}}));
}

TEST(Estimates, OfNothingAreNotThere) {
  json out = json::object();
  add_estimate(out, "a.harm", {});
  EXPECT_TRUE(out.empty());
}

}  // namespace
}  // namespace saca::suites::estimates_test
