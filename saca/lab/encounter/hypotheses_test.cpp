#include "saca/lab/encounter/hypotheses.h"

#include <gtest/gtest.h>

#include <numeric>

#include "saca/thinking/arbitration/forecaster.h"
#include "saca/thinking/intent/shipped_model.h"
#include "tests/support/scenes.h"

namespace saca::encounter::hypotheses_test {
namespace {

JudgedScene judged(const world::Scene& scene, bool by_atlas = false) {
  return {.begun = scene.time + 0.05,
          .scene = scene,
          .beliefs = intent::beliefs_at_sight(intent::shipped_model(), scene),
          .by_atlas = by_atlas};
}

double sum_of(const Hypotheses& hypotheses) {
  return std::accumulate(
      hypotheses.motions.begin(), hypotheses.motions.end(), 0.0,
      [](double sum, const HypotheticalMotion& one) { return sum + one.probability; });
}

/// An oncoming car, 60 m ahead in the other lane, that is perceived to half a metre.
world::Scene oncoming() {
  world::Scene scene = test::ego_at(15.0);
  scene.time = 3.0;
  scene.road.left_edge = 5.25;
  scene.road.oncoming_left = true;
  scene.actors.push_back(test::car(1, {60.0, 3.5}, {-12.0, 0.0}));
  scene.actors[0].position_sd = 0.5;
  return scene;
}

// They are what the forecaster holds every plan against: every 0.25 s of it, to the centimetre.
TEST(Hypotheses, AreTheDrawsOfTheForecaster) {
  const world::Scene scene = oncoming();
  const Hypotheses hypotheses = hypotheses_of(judged(scene));
  const auto draws = arbitration::draws_of(scene, judged(scene).beliefs);
  EXPECT_EQ(hypotheses.begun, 3.05);
  EXPECT_EQ(hypotheses.time, 3.0);
  ASSERT_EQ(hypotheses.motions.size(), draws.size()) << "no two of them are the same";
  for (std::size_t k = 0; k < draws.size(); ++k) {
    EXPECT_EQ(hypotheses.motions[k].probability, draws[k].probability);
    ASSERT_EQ(hypotheses.motions[k].paths.size(), 1U);
    const HypotheticalPath& path = hypotheses.motions[k].paths[0];
    EXPECT_EQ(path.actor, "car1");
    ASSERT_LE(path.X_WA.size(), 17U);  // 4 s
    for (std::size_t i = 0; i < 17; ++i) {
      const Pose shown = path.X_WA[std::min(i, path.X_WA.size() - 1)];
      const Pose meant = world::pose_at(draws[k].tracks[0], 3.0 + 0.25 * static_cast<double>(i));
      EXPECT_NEAR(shown.p.x, meant.p.x, 0.00501);
      EXPECT_NEAR(shown.p.y, meant.p.y, 0.00501);
      EXPECT_NEAR(wrap_angle(shown.yaw - meant.yaw), 0.0, 0.0088);  // half a degree
    }
  }
}

TEST(Hypotheses, OfWhatIsCertainAreOneAndStand) {
  world::Scene scene = test::ego_at(15.0);
  scene.actors.push_back(test::car(1, {40.0, 0.0}));
  scene.actors[0].kind = world::ActorKind::obstacle;
  const Hypotheses hypotheses = hypotheses_of(judged(scene));
  ASSERT_EQ(hypotheses.motions.size(), 1U);
  EXPECT_DOUBLE_EQ(hypotheses.motions[0].probability, 1.0);
  ASSERT_EQ(hypotheses.motions[0].paths[0].X_WA.size(), 1U);
  EXPECT_EQ(hypotheses.motions[0].paths[0].X_WA[0].p.x, 40.0);
}

// Where the reflex plane read the atlas, everybody went on: x = 60 m - 12 m/s t.
TEST(Hypotheses, OfTheAtlasAreThatTheOthersGoOn) {
  const Hypotheses hypotheses = hypotheses_of(judged(oncoming(), true));
  ASSERT_EQ(hypotheses.motions.size(), 1U);
  EXPECT_EQ(hypotheses.motions[0].probability, 1.0);
  const auto& path = hypotheses.motions[0].paths[0].X_WA;
  ASSERT_EQ(path.size(), 17U);
  for (std::size_t i = 0; i < path.size(); ++i) {
    EXPECT_NEAR(path[i].p.x, 60.0 - 12.0 * 0.25 * static_cast<double>(i), 0.00501);
    EXPECT_NEAR(path[i].p.y, 3.5, 0.00501);
  }
}

TEST(Hypotheses, HaveNoPathOfThoseBehindWhoReactToTheEgo) {
  world::Scene scene = oncoming();
  scene.actors.push_back(test::car(2, {-15.0, 0.0}, {15.0, 0.0}));
  const Hypotheses hypotheses = hypotheses_of(judged(scene));
  EXPECT_EQ(hypotheses.reacting, std::vector<std::string>{"car2"});
  for (const HypotheticalMotion& motion : hypotheses.motions) {
    ASSERT_EQ(motion.paths.size(), 1U);
    EXPECT_EQ(motion.paths[0].actor, "car1");
  }
}

TEST(Hypotheses, AreOfTheNearestTwelve) {
  world::Scene scene = oncoming();
  scene.actors.clear();
  for (std::uint8_t i = 1; i <= 20; ++i) {
    const double ahead = 10.0 * (21 - i);  // car20 is the nearest
    scene.actors.push_back(test::car(i, {ahead, 3.5}, {-12.0, 0.0}));
  }
  const Hypotheses hypotheses = hypotheses_of(judged(scene));
  EXPECT_NEAR(sum_of(hypotheses), 1.0, 1e-12);
  ASSERT_EQ(hypotheses.motions[0].paths.size(), 12U);
  for (std::size_t k = 0; k < 12; ++k) {
    EXPECT_EQ(hypotheses.motions[0].paths[k].actor, "car" + std::to_string(9 + k));
  }
}

TEST(Hypotheses, OfAnEmptyRoadAreOneWithoutPaths) {
  const Hypotheses hypotheses = hypotheses_of(judged(test::ego_at(15.0)));
  ASSERT_EQ(hypotheses.motions.size(), 1U);
  EXPECT_DOUBLE_EQ(hypotheses.motions[0].probability, 1.0);
  EXPECT_TRUE(hypotheses.motions[0].paths.empty());
}

}  // namespace
}  // namespace saca::encounter::hypotheses_test
