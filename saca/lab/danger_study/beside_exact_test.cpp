#include "saca/lab/danger_study/beside_exact.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <utility>
#include <vector>

#include "saca/lab/danger_study/weights_for_test.h"
#include "saca/thinking/danger/value_table.h"

namespace saca::danger_study::beside_exact_test {
namespace {

/// A value of -1 m wherever the point mass is.
learned_danger::ExactPointMass flat_value() {
  const double pi = std::numbers::pi;
  const danger::Grid grid{
      {{.name = "x", .first = -60.0, .last = 20.0, .points = 5},
       {.name = "y", .first = -20.0, .last = 20.0, .points = 5},
       {.name = "course", .first = -pi, .last = pi, .points = 8, .edge = danger::Edge::periodic},
       {.name = "speed", .first = 0.0, .last = 20.0, .points = 5}}};
  const std::vector<float> values(danger::num_cells(grid), -1.0F);
  return {.problem = {.system = {.grip = 0.9, .tightest_curvature = 0.2, .drive_share = 0.5},
                      .ego = {.length = 4.0, .width = 2.0},
                      .obstacle = {.length = 4.0, .width = 2.0}},
          .text = "name = \"flat\"\n",
          .view = danger::View::obstacle,
          .table = danger::ValueTable(grid, values)};
}

std::string drawn(const BesideExactRequest& request) {
  auto picture = beside_exact_png(blind_network(), flat_value(), request);
  EXPECT_TRUE(picture.has_value());
  return picture.has_value() ? std::move(picture).value() : "";
}

TEST(BesideExact, IsAPngWithARowForEachSpeed) {
  const std::string one = drawn({.weights = "w", .table = "t", .speeds = {8.0}});
  EXPECT_THAT(one, testing::StartsWith("\x89PNG\r\n\x1a\n"));
  const std::string two = drawn({.weights = "w", .table = "t", .speeds = {8.0, 9.0}});
  // The height, in the header as 4 bytes from the 20th on, grows; the width does not.
  EXPECT_EQ(one.substr(16, 4), two.substr(16, 4));
  EXPECT_LT(one.substr(20, 4), two.substr(20, 4));
}

TEST(BesideExact, NamesTheWeightsByTheirFileAndTheCaseByItsName) {
  const BesideExactRequest request{.weights = "a/w.safetensors", .table = "t", .speeds = {8.0}};
  BesideExactRequest elsewhere = request;
  elsewhere.weights = "b/c/w.safetensors";
  elsewhere.table = "u";
  EXPECT_EQ(drawn(request), drawn(elsewhere));
  elsewhere.weights = "b/c/other.safetensors";
  EXPECT_NE(drawn(request), drawn(elsewhere));
}

}  // namespace
}  // namespace saca::danger_study::beside_exact_test
