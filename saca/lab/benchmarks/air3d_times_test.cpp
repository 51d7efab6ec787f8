#include "saca/lab/benchmarks/air3d_times.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/file.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/benchmarks/ticking_clock_for_test.h"
#include "saca/lab/levelset/solve.h"

namespace saca::benchmarks::air3d_times_test {
namespace {

using testing::HasSubstr;

constexpr const char* shipped = "data/reference/air3d_hj_reachability.json";

TEST(Air3dReference, IsThereForBothGrids) {
  for (const GameGrid& size : {coarse_game, fine_game}) {
    const auto found = air3d_reference(shipped, size);
    ASSERT_TRUE(found.has_value()) << found.error().message;
    EXPECT_EQ(found.value().at("precision"), "double");
    EXPECT_GT(found.value().at("tube_volume_m2_rad"), 0.0);
  }
}

TEST(Air3dReference, IsNotMadeUp) {
  EXPECT_THAT(air3d_reference(shipped, {3, 4, 5}).error().message,
              HasSubstr("want a solution of [3,4,5] points in doubles, got none"));
  EXPECT_EQ(air3d_reference("no_such.json", coarse_game).error().code, Error::Code::unreadable);
  const auto file = std::filesystem::path(testing::TempDir()) / "air3d_reference.json";
  for (const char* const text : {"no JSON", "[]", "{\"solutions\": [3, {}]}"}) {
    ASSERT_EQ(write_file(file, text), std::nullopt);
    EXPECT_EQ(air3d_reference(file, coarse_game).error().code, Error::Code::malformed) << text;
  }
  std::filesystem::remove(file);
}

// Errors are shares of the reference: here twice the least and half the greatest value that
// another way to the same solution has.
TEST(Air3dTimes, AreOfASolutionThatIsHeldAgainstTheReference) {
  const GameGrid size{14, 12, 10};
  const danger::Grid grid = levelset::air3d_grid(size.x, size.y, size.heading);
  const auto solved =
      levelset::solve(levelset::air3d_problem(grid), {.with_error = false}, std::nullopt, {});
  ASSERT_TRUE(solved.has_value());
  const std::vector<float> values = danger::snapshot(solved.value(), 0);
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  const nlohmann::json reference{{"tube_volume_m2_rad", levelset::tube_volume<float>(grid, values)},
                                 {"least_value_m", 2.0 * static_cast<double>(*least)},
                                 {"greatest_value_m", 0.5 * static_cast<double>(*greatest)}};
  const TickingClock clock;
  std::vector<std::string> noted;
  const auto times = air3d_times(size, reference, 1, clock,
                                 [&](const std::string& what) { noted.push_back(what); });
  ASSERT_TRUE(times.has_value());
  const nlohmann::json& all = times.value();
  const std::string place = "reach.air3d_14x12x10.";
  for (const std::string after : {"", ".double"}) {
    EXPECT_NEAR(all.at(place + "volume_error" + after).get<double>(), 0.0, 1e-3);
    EXPECT_NEAR(all.at(place + "least_value_error" + after).get<double>(), 0.5, 1e-3);
    EXPECT_NEAR(all.at(place + "greatest_value_error" + after).get<double>(), 1.0, 1e-3);
    EXPECT_NEAR(all.at(place + "seconds.t1" + after).get<double>(), 1e-3, 1e-12);
    EXPECT_GT(all.at(place + "ns_per_point_stage.t1" + after), 0.0);
    EXPECT_TRUE(all.contains(place + "seconds.t" + std::to_string(usual_threads()) + after));
  }
  ASSERT_EQ(noted.size(), 4U);
  EXPECT_EQ(noted[0], "air3D 14x12x10, float, threads: 1");
  EXPECT_THAT(noted[3], HasSubstr("double, threads: "));
}

}  // namespace
}  // namespace saca::benchmarks::air3d_times_test
