#include "saca/onboard/forecast/chain_harm.h"

#include <gtest/gtest.h>

#include <vector>

#include "saca/thinking/rollout/encounters_for_test.h"

namespace saca::forecast::chain_harm_test {
namespace {

world::Scene two_cars() {
  rollout::Encounter encounter;
  encounter.add_car({{20.0, 0.0}, 0.0}, {});
  encounter.add_car({{40.0, 0.0}, 0.0}, {});
  return encounter.scene;
}

collision::Impact impact(std::optional<std::size_t> actor, collision::Injury ego,
                         collision::Injury other) {
  collision::Impact one;
  one.contact.actor = actor;
  one.ego = ego;
  one.other = other;
  return one;
}

const collision::HarmModel& tariff() {
  static const collision::HarmModel it = rollout::shipped_harm();
  return it;
}

// 1.5 people in each car; a death counts four on top.
TEST(ChainHarm, OfOneImpactIsThatOfAllItsPeople) {
  const std::vector<collision::Impact> impacts{impact(0, {0.2, 0.05}, {0.1, 0.02})};
  EXPECT_NEAR(expected_harm(impacts, two_cars(), tariff()), 1.5 * (0.3 + 4.0 * 0.07), 1e-12);
  EXPECT_EQ(expected_harm({}, two_cars(), tariff()), 0.0);
}

// 1 - 0.8 x 0.5 = 0.6 for the ego's severe, 1 - 0.95 x 0.9 = 0.145 for its killed.
TEST(ChainHarm, ChancesOfComingThroughMultiplyForThePeopleOfOneBody) {
  const std::vector<collision::Impact> impacts{impact(0, {0.2, 0.05}, {0.1, 0.0}),
                                               impact(1, {0.5, 0.1}, {0.3, 0.0})};
  EXPECT_NEAR(expected_harm(impacts, two_cars(), tariff()), 1.5 * (0.6 + 4.0 * 0.145 + 0.1 + 0.3),
              1e-12);
  const std::vector<collision::Impact> twice{impact(0, {}, {0.2, 0.05}), impact(0, {}, {0.5, 0.1})};
  EXPECT_NEAR(expected_harm(twice, two_cars(), tariff()), 1.5 * (0.6 + 4.0 * 0.145), 1e-12);
}

// The second follows from the first, so both must be there: 0.5 x 0.4. A third impact with one of
// them needs nobody more.
TEST(ChainHarm, AnImpactComesOnlyIfAllBeforeItDid) {
  world::Scene scene = two_cars();
  scene.actors[0].existence = 0.5;
  scene.actors[1].existence = 0.4;
  std::vector<collision::Impact> impacts{impact(0, {}, {0.1, 0.0}), impact(1, {}, {0.3, 0.0})};
  EXPECT_NEAR(expected_harm(impacts, scene, tariff()), 1.5 * (0.5 * 0.1 + 0.2 * 0.3), 1e-12);
  impacts.push_back(impact(0, {}, {0.2, 0.0}));
  EXPECT_NEAR(expected_harm(impacts, scene, tariff()),
              1.5 * (0.5 * 0.1 + 0.2 * 0.3 + 0.2 * (1.0 - 0.9 * 0.8 - 0.1)), 1e-12);
  // What the road's edge does, it does in any case, unless it came after.
  EXPECT_NEAR(expected_harm(std::vector<collision::Impact>{impact(std::nullopt, {0.1, 0.0}, {})},
                            scene, tariff()),
              0.15, 1e-12);
}

}  // namespace
}  // namespace saca::forecast::chain_harm_test
