#include "saca/lab/eval/particle_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "saca/base/core/quintic.h"
#include "tests/support/scenes.h"

namespace saca::eval::particle_filter_test {
namespace {

using world::Scene;

constexpr scenario::PerceptionModel usual{
    .position_sd = 0.2, .velocity_sd = 0.2, .correlation_time = 0.5};

/// Three lanes along x, the ego far behind at 20 m/s, and a car.
Scene scene_at(double time, Vec2 p_W, Vec2 v_W) {
  Scene scene = test::ego_at(20.0);
  scene.time = time;
  scene.ego.X_WB.p = {-500.0 + 20.0 * time, 0.0};
  scene.road.left_edge = 5.25;
  scene.road.right_edge = -5.25;
  scene.actors.push_back(test::car(1, p_W, v_W));
  scene.actors[0].position_sd = usual.position_sd;
  scene.actors[0].velocity_sd = usual.velocity_sd;
  return scene;
}

/// Watched every 0.1 s until `until`.
/// @param at  the scene at a time
LikelyPlaces watched(const std::function<Scene(double)>& at, double until,
                     const scenario::PerceptionModel& errors = usual, std::uint64_t seed = 1) {
  ParticleFilter filter(errors, seed);
  Scene scene;
  for (int k = 0; k <= std::lround(until / 0.1); ++k) {
    scene = at(0.1 * k);
    filter.look(scene);
  }
  return filter.places_of(scene, scene.actors[0]);
}

struct Moments {
  Vec2 mean;
  Vec2 sd;
};

/// Of a mixture along x and y, all courses being along x.
Moments moments(const std::vector<LikelyPlace>& places) {
  Moments told;
  double sum = 0.0;
  Vec2 squares;
  for (const LikelyPlace& one : places) {
    const Vec2 p = one.p_W;
    sum += one.probability;
    told.mean = told.mean + one.probability * p;
    squares =
        squares + one.probability * Vec2{p.x * p.x + one.spread.along_sd * one.spread.along_sd,
                                         p.y * p.y + one.spread.across_sd * one.spread.across_sd};
  }
  EXPECT_NEAR(sum, 1.0, 1e-9);
  told.sd = {std::sqrt(squares.x - told.mean.x * told.mean.x),
             std::sqrt(squares.y - told.mean.y * told.mean.y)};
  return told;
}

TEST(ParticleFilter, WhoKeepsSpeedAndLaneIsForetoldTo) {
  const auto steady = [](double t) { return scene_at(t, {15.0 * t, 0.0}, {15.0, 0.0}); };
  const LikelyPlaces places = watched(steady, 3.0);
  for (std::size_t k = 0; k < forecast_times.size(); ++k) {
    const Moments told = moments(places[k]);
    EXPECT_NEAR(told.mean.x, 15.0 * (3.0 + forecast_times[k]), 0.5 + 0.5 * forecast_times[k]);
    EXPECT_NEAR(told.mean.y, 0.0, 0.3);
    EXPECT_LT(score(places[k], {15.0 * (3.0 + forecast_times[k]), 0.0}).nll, 3.5);
  }
}

// A move of 3.5 m within 4 s, halfway through: straight on it would end at 1.64 m/s * 2 s + 1.75 m
// = 5.0 m, in the middle of no lane at 1.75 m.
TEST(ParticleFilter, AMoveToTheSideEndsInTheNextLane) {
  const auto changing = [](double t) {
    return scene_at(t, {15.0 * t, 3.5 * quintic((t - 1.0) / 4.0)},
                    {15.0, 3.5 * quintic_slope((t - 1.0) / 4.0) / 4.0});
  };
  const Moments told = moments(watched(changing, 3.0)[2]);
  EXPECT_NEAR(told.mean.y, 3.5, 0.8);
  const Moments before = moments(watched(changing, 1.0)[2]);  // nobody knows of it yet
  EXPECT_NEAR(before.mean.y, 0.0, 0.4);
  EXPECT_GT(before.sd.y, 0.5);  // but it may come
}

// 40 m ahead somebody stands; 15 m/s for 3 s would be 45 m.
TEST(ParticleFilter, NobodyIsForetoldToDriveThroughWhoStands) {
  const auto approaching = [](double t) {
    Scene scene = scene_at(t, {15.0 * t, 0.0}, {15.0, 0.0});
    scene.actors.push_back(test::car(2, {15.0 + 40.0 + 4.5, 0.0}, {}));
    return scene;
  };
  const auto [mean, sd] = moments(watched(approaching, 1.0).back());
  EXPECT_LT(mean.x, 15.0 + 40.0);
  EXPECT_GT(mean.x, 15.0 + 15.0);  // it was not seen to brake before
}

// Braking by 4 m/s2 for a second: after 2 s more it is 10 * 2 - 0.5 * 4 * 2^2 = 12 m on, and by
// constant velocity 20 m.
TEST(ParticleFilter, WhoBrakesForNoReasonThatIsSeenGoesOnBraking) {
  const auto braking = [](double t) {
    const double b = std::max(0.0, t - 1.0);
    return scene_at(t, {14.0 * t - 2.0 * b * b, 0.0}, {14.0 - 4.0 * b, 0.0});
  };
  const double here = 14.0 * 2.0 - 2.0;
  const double on = moments(watched(braking, 2.0)[2]).mean.x - here;
  EXPECT_NEAR(on, 12.0, 3.0);
}

// Errors that stay as they are do not average out, however long one looks; independent ones do: 21
// looks at who moves steadily. What the driver may do within 0.5 s adds 0.5 * 0.86 * 0.5^2 = 0.11
// m.
TEST(ParticleFilter, ErrorsThatStayAreNotAveragedOut) {
  const auto steady = [](double t) { return scene_at(t, {15.0 * t, 0.0}, {15.0, 0.0}); };
  scenario::PerceptionModel staying = usual;
  staying.correlation_time = 1e3;
  scenario::PerceptionModel independent = usual;
  independent.correlation_time = 0.0;
  const double with_staying = moments(watched(steady, 2.0, staying).front()).sd.y;
  const double with_independent = moments(watched(steady, 2.0, independent).front()).sd.y;
  EXPECT_NEAR(with_staying, std::hypot(0.2, 0.1), 0.08);
  EXPECT_LT(with_independent, 0.75 * with_staying);
}

TEST(ParticleFilter, TheSameSeedForetellsTheSame) {
  const auto steady = [](double t) { return scene_at(t, {15.0 * t, 0.0}, {15.0, 0.0}); };
  const auto once = watched(steady, 1.0, usual, 7);
  const auto again = watched(steady, 1.0, usual, 7);
  const auto other = watched(steady, 1.0, usual, 8);
  EXPECT_EQ(once.back().front().p_W.x, again.back().front().p_W.x);
  EXPECT_NE(once.back().front().p_W.x, other.back().front().p_W.x);
}

// Against the lanes: the mirror of along them.
TEST(ParticleFilter, OncomingTrafficIsForetoldInItsOwnDirection) {
  const auto oncoming = [](double t) { return scene_at(t, {300.0 - 15.0 * t, 3.5}, {-15.0, 0.0}); };
  const LikelyPlaces places = watched(oncoming, 2.0);
  EXPECT_NEAR(moments(places.back()).mean.x, 300.0 - 15.0 * 5.0, 2.5);
  EXPECT_NEAR(moments(places.back()).mean.y, 3.5, 0.5);
  EXPECT_NEAR(std::cos(places.back().front().course), -1.0, 1e-9);
}

TEST(ParticleFilter, WhoCrossesGoesStraight) {
  const auto crossing = [](double t) { return scene_at(t, {40.0, -20.0 + 5.0 * t}, {0.0, 5.0}); };
  const Scene last = crossing(1.0);
  const LikelyPlaces places = watched(crossing, 1.0);
  const LikelyPlaces straight = going_straight(last.actors[0]);
  ASSERT_EQ(places.back().size(), 1U);
  EXPECT_EQ(places.back()[0].p_W.y, straight.back()[0].p_W.y);
}

}  // namespace
}  // namespace saca::eval::particle_filter_test
