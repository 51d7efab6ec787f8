#include "saca/lab/report/authors_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/base/core/units.h"

namespace saca::report::authors_page_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A network whose value is (x + 50) / 50 where x > -50, else 0.
verification::AuthorsNetwork scaled_x() {
  const std::map<std::string, verification::NpyArray> arrays{
      {"MLP_0_Dense_0_kernel", {{4, 1}, {1.0, 0.0, 0.0, 0.0}}},
      {"MLP_0_Dense_0_bias", {{1}, {0.0}}},
      {"MLP_0_Dense_1_kernel", {{1, 1}, {1.0}}},
      {"MLP_0_Dense_1_bias", {{1}, {0.0}}},
      {"OutputVDense_kernel", {{1, 1}, {1.0}}},
      {"OutputVDense_bias", {{1}, {0.0}}}};
  return verification::AuthorsNetwork::from(arrays, "made here").value();
}

danger::ValueAt flat_value() {
  const double pi = std::numbers::pi;
  const danger::Grid grid{
      {{.name = "x", .first = -60.0, .last = 20.0, .points = 5},
       {.name = "y", .first = -20.0, .last = 20.0, .points = 5},
       {.name = "course", .first = -pi, .last = pi, .points = 8, .edge = danger::Edge::periodic},
       {.name = "speed", .first = 0.0, .last = 20.0, .points = 5}}};
  const std::vector<float> values(num_cells(grid), -1.0F);
  return [table = danger::ValueTable(grid, values)](const danger::State& state) {
    return table.at(state);
  };
}

TEST(AuthorsMap, HasTheNetworksValuesAtTheMiddlesAndItsRange) {
  const ValueMap map = authors_map(scaled_x(), {-100.0, 100.0}, {-10.0, 10.0}, {8, 4}, {0.1, 5.0});
  ASSERT_EQ(map.values.size(), 32U);
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      const Vec2 at = map.middle(column, row);
      const double wanted = at.x > -50.0 ? (at.x + 50.0) / 50.0 : 0.0;
      EXPECT_NEAR(map.values[map.index(column, row)], wanted, 1e-6);
      const bool in_range = at.x >= -50.0 && at.x <= 0.0;  // y is at most 7.5 m
      EXPECT_EQ(map.inside[map.index(column, row)] != 0, in_range) << at.x << ", " << at.y;
    }
  }
}

TEST(AuthorsMap, BeyondTheRangeOfYawNothingIsInside) {
  const ValueMap map =
      authors_map(scaled_x(), {-40.0, -10.0}, {-1.0, 1.0}, {2, 2}, {from_degrees(41.0), 5.0});
  EXPECT_THAT(map.inside, testing::Each(0));
}

TEST(AuthorsMap, RefusesEmptyRanges) {
  EXPECT_THROW((void)authors_map(scaled_x(), {1.0, 1.0}, {0.0, 1.0}, {2, 2}, {0.0, 1.0}),
               ContractViolation);
}

TEST(AuthorsPage, ShowsEachViewTwiceAndEachSpeedOnce) {
  verification::AuthorsComparison comparison;
  comparison.all = {.states = 200, .unsafe = 50, .false_safe = 10, .false_alarm = 30};
  comparison.by_speed = {{.speed = 7.0, .agreement = comparison.all}};
  const auto page = authors_page({.case_name = "a <b> case",
                                  .network_name = "net.npz",
                                  .outline = {},
                                  .views = {{0.0, 5.0}, {from_degrees(20.0), 10.0}}},
                                 flat_value(), scaled_x(), comparison);
  ASSERT_TRUE(page.has_value()) << page.error().message;
  const std::string& html = page.value();
  std::size_t pictures = 0;
  for (std::size_t at = html.find("<img"); at != std::string::npos;
       at = html.find("<img", at + 1)) {
    ++pictures;
  }
  EXPECT_EQ(pictures, 4U);
  EXPECT_THAT(html, HasSubstr("10 m/s, course 20 deg"));
  // of 200 states: 25 % unsafe, 80 % alike, 10 of 50 falsely safe, 30 of 150 false alarms
  EXPECT_THAT(html, HasSubstr("<tr><th>7</th><td>200</td><td>25.0 %</td><td>80.0 %</td>"
                              "<td>20.0 %</td><td>20.0 %</td>"));
  EXPECT_THAT(html, HasSubstr("<tr><th>all</th><td>200</td>"));
  EXPECT_THAT(html, HasSubstr("a &lt;b&gt; case"));
  EXPECT_THAT(html, Not(HasSubstr("http")));  // needs no other file
  EXPECT_LT(html.size(), 2'000'000U);
}

}  // namespace
}  // namespace saca::report::authors_page_test
