#include "saca/lab/eval/rss.h"

#include <gmock/gmock.h>

#include "saca/lab/eval/scenes_for_test.h"
#include "tests/support/scenes.h"

namespace saca::eval::rss_test {
namespace {

using manoeuvre::PolicyId;

// By hand from definition 1 of the paper: v_r = 20, v_f = 10, rho = 0.75, a = 3, b = 6 both:
// 20 * 0.75 + 0.5 * 3 * 0.75^2 + 22.25^2 / 12 - 10^2 / 12 = 15 + 0.84375 + 41.2552 - 8.3333.
TEST(Rss, TheFollowingDistanceIsThatOfThePaper) {
  EXPECT_NEAR(rss_following_distance(20.0, 10.0), 48.76562, 1e-5);
  EXPECT_EQ(rss_following_distance(5.0, 40.0), 0.0);  // it drives away
}

// Definition 2: each drives (v + v_rho) / 2 * rho + v_rho^2 / (2 b) before it stands.
TEST(Rss, TheOncomingDistanceIsTwoWaysToRest) {
  const auto way = [](double v) {
    return (v + 0.5 * 2.25) * 0.75 + (v + 2.25) * (v + 2.25) / 12.0;
  };
  EXPECT_NEAR(rss_oncoming_distance(15.0, 10.0), way(15.0) + way(10.0), 1e-12);
}

// Definition 6 with mu = 0.3, a = 1: each at rest aside gains 0.75 m/s while it responds.
TEST(Rss, TheDistanceAsideCountsBothAndNeverLessThanTheMargin) {
  const double each = 0.5 * 0.75 * 0.75 + 0.75 * 0.75 / 2.0;
  EXPECT_NEAR(rss_side_distance(0.0, 0.0), 0.3 + 2.0 * each, 1e-12);
  EXPECT_NEAR(rss_side_distance(-9.0, -9.0), 0.3, 1e-12);
  EXPECT_GT(rss_side_distance(0.0, 1.0), rss_side_distance(0.0, 0.0));
}

class RssMethod : public testing::Test {
 protected:
  std::optional<encounter::Action> step(Rss& rss, const world::Scene& scene) {
    return truth_.step(rss, scene);
  }
  static world::Scene with_car(double gap, double speed) {
    world::Scene scene = test::ego_at(20.0);
    scene.road.left_edge = 5.25;
    scene.actors.push_back(test::car(1, {2.35 + gap + 2.25, 0.0}, {speed, 0.0}));
    return scene;
  }

  UnseenTruth truth_;
};

TEST_F(RssMethod, BrakesWhereTheDistanceIsNotKeptAndLetsGoWhereItIs) {
  Rss rss(Rss::Response::braking);
  EXPECT_EQ(step(rss, with_car(49.0, 10.0)), std::nullopt);
  const auto brakes = step(rss, with_car(48.5, 10.0));
  ASSERT_TRUE(brakes.has_value());
  EXPECT_EQ(brakes->plan.policy, PolicyId::aeb);
  EXPECT_NEAR(brakes->deceleration, 0.774 * 9.81, 1e-12);
  EXPECT_EQ(step(rss, with_car(48.0, 10.0)), std::nullopt);  // it brakes already
  const auto goes = step(rss, with_car(60.0, 19.0));
  ASSERT_TRUE(goes.has_value());
  EXPECT_EQ(goes->plan.policy, PolicyId::no_intervention);
}

TEST_F(RssMethod, WhoIsBesideOrBehindIsNoDangerAhead) {
  Rss rss(Rss::Response::braking);
  world::Scene scene = test::ego_at(20.0);
  scene.actors.push_back(test::car(1, {10.0, 3.5 + 0.2}, {10.0, 0.0}));  // 1.85 m aside
  scene.actors.push_back(test::car(2, {-8.0, 0.0}, {25.0, 0.0}));
  EXPECT_EQ(step(rss, scene), std::nullopt);
}

// 10 m to a standing car at 20 m/s: no brake on a grip of 0.9 stops there (22.7 m).
TEST_F(RssMethod, SteersWhereBrakingComesTooLateAndALaneIsFree) {
  Rss rss(Rss::Response::braking_or_steering);
  const auto steers = step(rss, with_car(10.0, 0.0));
  ASSERT_TRUE(steers.has_value());
  EXPECT_EQ(steers->plan.policy, PolicyId::aes_left);
  EXPECT_EQ(step(rss, with_car(5.0, 0.0)), std::nullopt);  // once is enough

  Rss blocked(Rss::Response::braking_or_steering);
  world::Scene scene = with_car(10.0, 0.0);
  scene.actors.push_back(test::car(2, {-12.0, 3.5}, {25.0, 0.0}));
  EXPECT_EQ(step(blocked, scene)->plan.policy, PolicyId::aeb);

  Rss oncoming(Rss::Response::braking_or_steering);
  scene = with_car(10.0, 0.0);
  scene.road.oncoming_left = true;
  EXPECT_EQ(step(oncoming, scene)->plan.policy, PolicyId::aeb);
}

// It brakes for who is 40 m away, and 20 m later braking no longer does: from 20 m/s it needs 22.7
// m.
TEST_F(RssMethod, SteersWhereBrakingTurnsOutTooLate) {
  Rss rss(Rss::Response::braking_or_steering);
  EXPECT_EQ(step(rss, with_car(40.0, 0.0))->plan.policy, PolicyId::aeb);
  EXPECT_EQ(step(rss, with_car(23.0, 0.0)), std::nullopt);
  const auto steers = step(rss, with_car(22.0, 0.0));
  ASSERT_TRUE(steers.has_value());
  EXPECT_EQ(steers->plan.policy, PolicyId::aes_left);
  EXPECT_EQ(step(rss, with_car(10.0, 0.0)), std::nullopt);

  Rss braking(Rss::Response::braking);
  EXPECT_EQ(step(braking, with_car(40.0, 0.0))->plan.policy, PolicyId::aeb);
  EXPECT_EQ(step(braking, with_car(10.0, 0.0)), std::nullopt);
}

// Who comes at 10 m/s comes 22.7 m nearer in the 2.27 s in which 20 m/s are braked away in 22.7 m.
TEST_F(RssMethod, WhoComesNearerMeanwhileIsReckonedWith) {
  const auto acts = [&](double gap) {
    Rss rss(Rss::Response::braking_or_steering);
    return step(rss, with_car(gap, -10.0))->plan.policy;
  };
  EXPECT_EQ(acts(46.0), PolicyId::aeb);
  EXPECT_EQ(acts(44.8), PolicyId::aes_left);
}

}  // namespace
}  // namespace saca::eval::rss_test
