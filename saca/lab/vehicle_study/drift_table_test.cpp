#include "saca/lab/vehicle_study/drift_table.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "saca/lab/installation/here_for_test.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/drive.h"

namespace saca::vehicle_study::drift_table_test {
namespace {

using nlohmann::json;

DriftCell cell() {
  return {"a_car", 12.0, 0.5,
          DriftEndings{{0.75, 0.5, 0.875}, {10.0, 10.5, 11.25}, {1.0, 1.5, 2.0}}};
}

TEST(DriftTable, IsOfSixGripsAndSixSpeedsRefusedWhereTheCarCannot) {
  const manoeuvre::Car car = prepare::default_car();
  std::vector<DriftCell> cells;
  table_drifts("a_car", car, {.count = 1}, [&](const DriftCell& one) { cells.push_back(one); });
  ASSERT_EQ(cells.size(), 36U);
  EXPECT_EQ(cells.front().speed, 10.0);
  EXPECT_EQ(cells.back().grip, 1.0);
  for (const DriftCell& one : cells) {
    world::Scene scene;
    scene.ego.v_B = {one.speed, 0.0};
    scene.grip = one.grip;
    const manoeuvre::Plan drift{manoeuvre::PolicyId::t_drift_left, std::nullopt};
    EXPECT_EQ(one.endings.has_value(), !manoeuvre::refusal(car, drift, scene).has_value());
    if (one.endings) {  // one draw: all of its percentiles are the same
      EXPECT_EQ(one.endings->forward.p05, one.endings->forward.p95);
      EXPECT_GT(one.endings->forward.p50, 0.0);
    }
  }
}

TEST(DriftTable, FiguresHaveCarSpeedAndGripInTheirNames) {
  json figures;
  add_to(figures, cell());
  EXPECT_EQ(figures.size(), 9U);
  EXPECT_EQ(figures.at("t_drift.within_10_deg.share.a_car.v12.mu0.5"), 0.75);
  EXPECT_EQ(figures.at("t_drift.within_10_deg.low.a_car.v12.mu0.5"), 0.5);
  EXPECT_EQ(figures.at("t_drift.forward_m.p05.a_car.v12.mu0.5"), 10.0);
  EXPECT_EQ(figures.at("t_drift.sideways_m.p95.a_car.v12.mu0.5"), 2.0);
  json refused;
  add_to(refused, {"a_car", 25.0, 1.0, std::nullopt});
  EXPECT_EQ(refused, json({{"t_drift.refused.a_car.v25.mu1.0", true}}));
}

TEST(DriftTable, ALineForPeople) {
  EXPECT_EQ(text_of(cell()),
            "a_car               12   0.5    75.0 ( 50.0 to  87.5)     10.00   10.50   11.25     "
            "1.00   1.50   2.00\n");
  EXPECT_EQ(text_of({"a_car", 25.0, 1.0, std::nullopt}),
            "a_car               25   1.0   refused\n");
  EXPECT_THAT(drift_table_head({.count = 20}), testing::StartsWith("\nT-drift, 20 draws each; "));
}

TEST(DriftTable, OfSeveralCarsIsToldAsItGrows) {
  json figures;
  std::string told;
  const auto tell = [&](const std::string& lines) { told += lines; };
  const auto here = installation::here_for_test();
  ASSERT_EQ(add_drift_table(here, {"compact_rwd_ev"}, {.count = 1}, figures, tell), std::nullopt);
  EXPECT_EQ(told.find(drift_table_head({.count = 1})), 0U);
  EXPECT_EQ(figures["t_drift.n"], 1);
  EXPECT_GT(figures.size(), 36U);
  const auto problem = add_drift_table(here, {"none"}, {.count = 1}, figures, tell);
  ASSERT_TRUE(problem.has_value());
  EXPECT_THAT(problem->message, testing::HasSubstr("none: no car"));
}

}  // namespace
}  // namespace saca::vehicle_study::drift_table_test
