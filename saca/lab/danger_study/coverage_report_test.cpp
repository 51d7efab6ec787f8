#include "saca/lab/danger_study/coverage_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "saca/base/core/file.h"
#include "saca/lab/learned_danger/exact.h"
#include "saca/lab/learned_danger/table_for_test.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/danger/car_limits.h"

namespace saca::danger_study::coverage_report_test {
namespace {

using learned_danger::Part;
using testing::HasSubstr;

const std::vector<learned_danger::Coverage> two_bins{{.slowest = 0.0,
                                                      .fastest = 10.0,
                                                      .least_grip = 0.2,
                                                      .most_grip = 0.4,
                                                      .states = 20,
                                                      .others = 400,
                                                      .median = 0.125,
                                                      .p90 = 0.5},
                                                     {.slowest = 10.0,
                                                      .fastest = 20.0,
                                                      .least_grip = 0.8,
                                                      .most_grip = 1.0,
                                                      .states = 3,
                                                      .others = 32,
                                                      .median = 1.0,
                                                      .p90 = 1.5}};

TEST(CoverageReport, NamesFiguresByTheBin) {
  const nlohmann::json all = json_of(two_bins);
  EXPECT_EQ(all.size(), 8U);
  EXPECT_EQ(all.at("danger.coverage.from_0_mps.grip_from_0.2.median"), 0.125);
  EXPECT_EQ(all.at("danger.coverage.from_0_mps.grip_from_0.2.p90"), 0.5);
  EXPECT_EQ(all.at("danger.coverage.from_10_mps.grip_from_0.8.states"), 3);
  EXPECT_EQ(all.at("danger.coverage.from_10_mps.grip_from_0.8.others"), 32);
}

TEST(CoverageReport, IsATableForPeople) {
  EXPECT_EQ(text_of(two_bins),
            "from the exact best demand to the nearest of what was done in the 32 states most "
            "alike, on the unit disc of demands\n"
            "       m/s       grip   median     90 %  states   among\n"
            "   0 to 10  0.2 to 0.4    0.125    0.500      20     400\n"
            "  10 to 20  0.8 to 1.0    1.000    1.500       3      32\n");
}

/// Drives of one look each towards a square at rest, all of which do the same.
Part drives(const learned_danger::SquareAtRest& solved, int count) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> ahead(4.5, 6.5);
  Part part{.car = "any"};
  for (int i = 0; i < count; ++i) {
    learned_danger::State state{.ego = {.v_B = {8.5, 0.0}}, .grip = 0.9};
    state.obstacles.push_back({.body = solved.square, .X_WO = {{ahead(random), 0.2}, 0.0}});
    part.transitions.add({.observation = learned_danger::observation(state),
                          .demand = {-1.0, 0.0},
                          .is_cut_off = true});
    ++part.transitions.drives;
  }
  return part;
}

/// The square's table, as if it were of the usual car.
struct UsualCar {
  manoeuvre::Car car = prepare::default_car();
  learned_danger::SquareAtRest solved{.limits = danger::avoidance_of(car, 0.9),
                                      .ego = manoeuvre::footprint(car)};
};

TEST(CoverageReport, GoesThroughAllParts) {
  const UsualCar usual;
  const auto path = std::filesystem::path(testing::TempDir()) / "coverage_part.h5";
  const auto none =
      coverage_of(drives(usual.solved, 300), {path, path}, usual.car, usual.solved.model,
                  {.display = long_work::ProgressDisplay::silent});
  ASSERT_FALSE(none.has_value());
  EXPECT_THAT(none.error().message, HasSubstr(path.string())) << "the second one is not there";
  const auto one =
      coverage_of(drives(usual.solved, 300), {path}, usual.car, usual.solved.model,
                  {.states = 5, .others = 100, .display = long_work::ProgressDisplay::silent});
  ASSERT_TRUE(one.has_value()) << one.error().message;
  ASSERT_EQ(one.value().size(), 1U);
  EXPECT_EQ(one.value()[0].states, 5U);
  EXPECT_EQ(one.value()[0].slowest, 0.0);
}

TEST(CoverageReport, WantsStatesThatATableKnows) {
  const manoeuvre::Car car = prepare::default_car();
  const danger::DangerModel model(danger::avoidance_of(car, 0.9), manoeuvre::footprint(car), {});
  const auto none = coverage_of({}, {"only"}, car, model,
                                {.folder = "d", .display = long_work::ProgressDisplay::silent});
  ASSERT_FALSE(none.has_value());
  EXPECT_EQ(none.error().code, Error::Code::out_of_range);
  EXPECT_THAT(none.error().message, testing::StartsWith("d: want states near the boundary"));
}

}  // namespace
}  // namespace saca::danger_study::coverage_report_test
