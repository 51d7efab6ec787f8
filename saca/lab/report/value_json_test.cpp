#include "saca/lab/report/value_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/lab/report/record_page.h"

namespace saca::report::value_json_test {
namespace {

using danger::Edge;
using danger::Grid;
using danger::Snapshots;
using danger::Solution;
using nlohmann::json;

constexpr double pi = std::numbers::pi;

Grid small_grid() {
  return {
      {{.name = "x", .first = -9.0, .last = 6.0, .points = 9, .stretch = 2.0},
       {.name = "y", .first = 0.0, .last = 4.0, .points = 5, .edge = Edge::mirrored, .turned = 2},
       {.name = "course", .first = -pi, .last = pi, .points = 6, .edge = Edge::periodic},
       {.name = "speed", .first = 0.0, .last = 30.0, .points = 4}}};
}

Solution solved_on(const Grid& grid, std::size_t times) {
  Solution solved{
      .grid = grid,
      .problem = "name = \"a\"\n[obstacle]\nshape = \"box\"\nlength_m = 4\nwidth_m = 2\n",
      .complete = true};
  Snapshots<float> values;
  for (std::size_t time = 0; time < times; ++time) {
    solved.times.push_back(0.5 * static_cast<double>(time));
    values.emplace_back();
    for (std::size_t i = 0; i < danger::num_cells(grid); ++i) {
      const auto k = static_cast<double>(i * (time + 1));
      values.back().push_back(static_cast<float>(12.0 * std::sin(k) - 9.0));
    }
  }
  solved.values = values;
  return solved;
}

/// By RFC 4648.
std::vector<int> decoded(const std::string& text) {
  std::vector<int> bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') {
      break;
    }
    const int digit = c >= 'A' && c <= 'Z'   ? c - 'A'
                      : c >= 'a' && c <= 'z' ? c - 'a' + 26
                      : c >= '0' && c <= '9' ? c - '0' + 52
                      : c == '+'             ? 62
                                             : 63;
    bits = bits << 6U | static_cast<unsigned>(digit);
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes.push_back(static_cast<int>(bits >> static_cast<unsigned>(count) & 255U));
    }
  }
  return bytes;
}

/// As docs/formats.md tells it.
double meant(int byte, const json& page) {
  const double root = (byte - 128) / 127.0;
  const json& extent = page["extent"];
  return root * root *
         (root >= 0.0 ? extent["highest"].get<double>() : extent["lowest"].get<double>());
}

TEST(ValueJson, HoldsEveryValueWithinItsRoundingAndWithItsSign) {
  const Solution solved = solved_on(small_grid(), 3);
  const json page =
      json::parse(value_json(solved, {.title = "a", .others = {}, .time = 1, .zoom = 2.5}));
  const std::vector<int> bytes = decoded(page["values"]);
  const std::size_t cells = danger::num_cells(solved.grid);
  ASSERT_EQ(bytes.size(), 3 * cells);
  const double rounding = page["rounding"];
  EXPECT_LT(rounding, 0.2);  // 21 m / 127
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const double value = static_cast<double>(std::get<0>(solved.values)[i / cells][i % cells]);
    ASSERT_NEAR(meant(bytes[i], page), value, rounding);
    ASSERT_EQ(bytes[i] >= 128, value >= 0.0);
  }
  EXPECT_EQ(page["start"]["time"], 1);
  EXPECT_EQ(page["start"]["zoom"], 2.5);
  EXPECT_EQ(page["times_s"], json::array({0.0, 0.5, 1.0}));
  EXPECT_EQ(page["outline"].size(), 4U);
}

TEST(ValueJson, IsFinestAboutZero) {
  Solution solved = solved_on(small_grid(), 1);
  for (float& value : std::get<0>(solved.values)[0]) {
    value = std::fmod(value, 0.3F);
  }
  std::get<0>(solved.values)[0][0] = -40.0F;
  std::get<0>(solved.values)[0][1] = 2.0F;
  const json page = json::parse(value_json(solved, {}));
  const std::vector<int> bytes = decoded(page["values"]);
  for (std::size_t i = 2; i < bytes.size(); ++i) {  // within a step of the root: 2 sqrt(v V) / 254
    EXPECT_NEAR(meant(bytes[i], page), static_cast<double>(std::get<0>(solved.values)[0][i]),
                std::sqrt(0.3 * 40.0) / 127.0 + 40.0 / 127.0 / 127.0);
  }
}

TEST(ValueJson, LeavesOutPointsEvenlyButNoEnd) {
  Grid grid = small_grid();
  grid.axes[0].points = 61;
  const Solution solved = solved_on(grid, 2);
  const json page = json::parse(value_json(solved, {}, 4000));
  std::size_t cells = 1;
  for (std::size_t d = 0; d < 4; ++d) {
    const json& axis = page["axes"][d];
    cells *= axis["coordinates"].size();
    EXPECT_EQ(axis["points"], grid.axes[d].points);
    EXPECT_DOUBLE_EQ(axis["coordinates"][0], danger::coordinate(grid.axes[d], 0));
    if (grid.axes[d].edge != Edge::periodic) {
      EXPECT_DOUBLE_EQ(axis["coordinates"].back(), grid.axes[d].last);
    }
  }
  EXPECT_LE(2 * cells, 4000U);
  const std::vector<int> bytes = decoded(page["values"]);
  ASSERT_EQ(bytes.size(), 2 * cells);
  const double last = static_cast<double>(std::get<0>(solved.values)[1][60]);
  const std::size_t place = cells + page["axes"][0]["coordinates"].size() - 1;
  EXPECT_NEAR(meant(bytes[place], page), last, page["rounding"]);
}

TEST(ValueJson, KeepsTheFirstAndTheLastOfManySnapshots) {
  const json page =
      json::parse(value_json(solved_on(small_grid(), 40), {.title = "", .others = {}, .time = 39}));
  EXPECT_LE(page["times_s"].size(), 12U);
  EXPECT_EQ(page["times_s"].front(), 0.0);
  EXPECT_EQ(page["times_s"].back(), 19.5);
  EXPECT_EQ(page["start"]["time"], page["times_s"].size() - 1);
}

TEST(ValueJson, IsWhatThePageTakes) {
  EXPECT_TRUE(value_report(value_json(solved_on(small_grid(), 1), {})).has_value());
}

TEST(ValueJson, ReadsAnglesInDegrees) {
  EXPECT_DOUBLE_EQ(read_unit("course").factor * pi, 180.0);
  EXPECT_EQ(read_unit("heading").unit, "deg");
  EXPECT_EQ(read_unit("speed").unit, "m/s");
  EXPECT_EQ(read_unit("pressure").unit, "");
}

TEST(ValueJson, ShowsTheGridsOwnAxes) {
  const Solution solved = solved_on(small_grid(), 1);
  EXPECT_TRUE(json::parse(value_json(solved, {}))["shown"].is_null());
  EXPECT_EQ(shown_axes(solved, 1.0)[0].first, -9.0);
}

TEST(ValueJson, ShowsWhatTheEgoSeesInTheObstaclesFrame) {
  Grid grid = small_grid();
  grid.axes[0] = {.name = "ahead", .first = -6.0, .last = 9.0, .points = 9};
  grid.axes[1].name = "left";
  grid.axes[2].name = "turned";
  Solution solved = solved_on(grid, 1);
  solved.problem =
      "schema = \"saca.avoidance/1\"\nname = \"a\"\nseen_from = \"ego\"\nsnapshots_s = [1.0]\n"
      "[car]\ngrip = 0.9\ntightest_curvature_1pm = 0.2\ndrive_share = 0.5\n"
      "[ego]\nshape = \"box\"\nlength_m = 4\nwidth_m = 2\ncentre_m = 0\n"
      "[obstacle]\nshape = \"box\"\nlength_m = 4\nwidth_m = 2\nspeed_mps = 0\n"
      "[grid.ahead]\nfirst_m = -6\nlast_m = 9\npoints = 9\n[grid.left]\nlast_m = 4\npoints = 5\n"
      "[grid.turned]\npoints = 6\n[grid.speed]\nlast_mps = 30\npoints = 4\n";
  const danger::State others{0.0, 0.0, 0.5 * pi, 12.0};
  const json page = json::parse(value_json(solved, {.title = "a", .others = others}));
  EXPECT_EQ(page["axes"][0]["name"], "ahead");  // as they are kept
  EXPECT_EQ(page["axes"][2]["unit"], "deg");
  const json& shown = page["shown"];
  ASSERT_EQ(shown.size(), 4U);
  EXPECT_EQ(shown[0]["name"], "x");
  EXPECT_EQ(shown[1]["name"], "y");
  EXPECT_EQ(shown[2]["name"], "course");
  EXPECT_EQ(shown[3]["name"], "speed");
  EXPECT_NEAR(shown[0]["coordinates"][0], -4.0, 1e-9);  // across the course
  EXPECT_NEAR(shown[1]["coordinates"][0], -9.0, 1e-9);  // the obstacle 9 m ahead
  EXPECT_NEAR(shown[1]["coordinates"][1], 6.0, 1e-9);
  EXPECT_EQ(shown[2]["edge"], "periodic");
  EXPECT_EQ(page["start"]["others"][2], 0.5 * pi);
}

TEST(ValueJson, RefusesWhatItCannotShow) {
  const Solution solved = solved_on({{small_grid().axes[3]}}, 1);
  EXPECT_THROW((void)value_json(solved, {}), ContractViolation);
  EXPECT_THROW((void)value_json(solved_on(small_grid(), 1), {.title = "", .others = {}, .time = 1}),
               ContractViolation);
}

}  // namespace
}  // namespace saca::report::value_json_test
