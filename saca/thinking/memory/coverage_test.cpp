#include "saca/thinking/memory/coverage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saca/onboard/match/example_scenes.h"
#include "saca/onboard/match/similarity.h"

namespace saca::memory::coverage_test {
namespace {

constexpr double quarter = std::numbers::pi / 2.0;

world::Scene with(const world::Actor& actor) {
  world::Scene scene = match::empty_road();
  scene.actors.push_back(actor);
  return scene;
}

TEST(Situation, IsTheWayAndKindOfWhomTheEgoMeets) {
  EXPECT_EQ(situation_of(match::empty_road()), Situation::nobody);
  EXPECT_EQ(situation_of(with(match::car(1, {{20.0, 0.0}, 0.0}, 3.0))), Situation::same_direction);
  EXPECT_EQ(situation_of(with(match::truck(1, {{30.0, 3.0}, 2.0 * quarter}, 10.0))),
            Situation::oncoming);
  EXPECT_EQ(situation_of(with(match::car(1, {{15.0, 8.0}, -quarter}, 8.0))), Situation::crossing);
  EXPECT_EQ(situation_of(with(match::car(1, {{15.0, -8.0}, quarter}, 8.0))), Situation::crossing);
  EXPECT_EQ(situation_of(with(match::pedestrian(1, {10.0, 1.0}))), Situation::pedestrian);
}

TEST(Situation, IsThatOfTheGreatestThreat) {
  world::Scene scene = with(match::car(1, {{10.0, 0.0}, 0.0}, 2.0));
  scene.actors.push_back(match::pedestrian(2, {80.0, 20.0}));
  EXPECT_EQ(situation_of(scene), Situation::same_direction);
}

TEST(Situation, IsSeenAlongTheLane) {
  world::Scene scene = with(match::car(1, {{20.0, 0.0}, 0.0}, 3.0));
  scene.road.X_WL = {{0.0, 0.0}, quarter};  // the lane runs across what the car heads for
  scene.ego.X_WB.yaw = quarter;
  EXPECT_EQ(situation_of(scene), Situation::crossing);
}

Case of(match::CaseId id, const world::Scene& scene, PolicyHarms harms = {}) {
  Case one;
  one.id = id;
  one.scene = scene;
  one.told = harms;
  return one;
}

double difference_of(const world::Scene& a, const world::Scene& b) {
  const match::Features of_a = match::features(a);
  const match::Features of_b = match::features(b);
  return match::difference(of_a.ego, {of_a.actors.begin(), of_a.actors.size()}, of_b.ego,
                           {of_b.actors.begin(), of_b.actors.size()});
}

TEST(Coverage, CountsEveryCaseOnceInItsCell) {
  const world::Scene lead = with(match::car(1, {{20.0, 0.0}, 0.0}, 3.0));  // the ego at 14 m/s
  world::Scene fast = lead;
  fast.ego.v_B.x = 30.0;
  fast.grip = 0.3;
  PolicyHarms steer_is_better{};
  steer_is_better.fill(0.5);
  steer_is_better[3] = 0.0;
  PolicyHarms all_alike{};
  all_alike.fill(0.1);
  std::vector<Case> cases{of(1, lead, all_alike), of(2, lead, steer_is_better),
                          of(3, fast, steer_is_better), of(4, match::empty_road(), all_alike)};
  cases.push_back(of(5, lead, all_alike));
  cases.back().trust = Trust::quarantined;
  const auto cells = coverage(cases);
  ASSERT_EQ(cells.size(), all_situations.size() * (speed_classes.size() + 1));
  std::size_t counted = 0;
  for (const CoverageCell& cell : cells) {
    counted += cell.cases;
    if (cell.situation == Situation::same_direction && cell.speed_class == 2) {  // 14 m/s on
      EXPECT_EQ(cell.cases, 2U);
      EXPECT_EQ(cell.braking_as_good, 1U);
      EXPECT_EQ(cell.slippery, 0U);
      EXPECT_EQ(cell.to_nearest, 0.0);
    }
    if (cell.situation == Situation::same_direction && cell.speed_class == 3) {
      EXPECT_EQ(cell.cases, 1U);
      EXPECT_EQ(cell.braking_as_good, 0U);
      EXPECT_EQ(cell.slippery, 1U);
      const double to_lead = difference_of(fast, lead);
      EXPECT_NEAR(cell.to_nearest, std::min(to_lead, difference_of(fast, match::empty_road())),
                  1e-4);
    }
    EXPECT_EQ(std::isnan(cell.to_nearest), cell.cases == 0);
  }
  EXPECT_EQ(counted, 4U);
}

TEST(Coverage, OfNothingIsEmptyCells) {
  for (const CoverageCell& cell : coverage({})) {
    EXPECT_EQ(cell.cases, 0U);
  }
}

}  // namespace
}  // namespace saca::memory::coverage_test
