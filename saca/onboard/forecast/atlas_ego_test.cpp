#include "saca/onboard/forecast/atlas_ego.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "saca/onboard/atlas/atlas_for_test.h"

namespace saca::forecast::atlas_ego_test {
namespace {

using atlas::atlas_plan;
using atlas::atlas_scene;
using atlas::AtlasPath;
using atlas::small_atlas;

world::Scene turned_scene(double curvature) {
  world::Scene scene = atlas_scene(12.5, 0.85);
  scene.road.curvature = curvature;
  scene.road.X_WL = {{40.0, -25.0}, 2.0};
  scene.ego.X_WB = from_lane(scene.road, {3.0, 0.2, 0.0});
  scene.ego_footprint.centre_x = 0.3;
  return scene;
}

TEST(AtlasEgo, SamplesStandWhereItIs) {
  for (const auto policy : manoeuvre::all_policies) {
    for (const double curvature : {0.0, 0.004, -0.004}) {
      const world::Scene scene = turned_scene(curvature);
      const AtlasPath path = small_atlas().path(atlas_plan(policy, 12.5), scene);
      const AtlasEgo ego(path, scene);
      for (std::size_t k = 0; k <= num_spans; ++k) {
        const Pose X_WB = ego.at(sample_time(k)).X_WB;
        const Vec2 middle_W = X_WB * Vec2{0.3, 0.0} - scene.ego.X_WB.p;
        // Straight between samples: a t^2 / 8 = 10 * 0.07^2 / 8, and the same share of the turn.
        EXPECT_NEAR(static_cast<double>(ego.samples().x[k]), middle_W.x, 0.02)
            << manoeuvre::name(policy);
        EXPECT_NEAR(static_cast<double>(ego.samples().y[k]), middle_W.y, 0.02)
            << manoeuvre::name(policy);
        EXPECT_NEAR(static_cast<double>(ego.samples().cosine[k]), std::cos(X_WB.yaw), 0.01);
        EXPECT_NEAR(static_cast<double>(ego.samples().sine[k]), std::sin(X_WB.yaw), 0.01);
      }
    }
  }
}

// Its velocity is how its place changes, on straight roads and in bends, beyond the end too.
TEST(AtlasEgo, VelocityIsTheSlopeOfItsPlace) {
  for (const auto policy : manoeuvre::all_policies) {
    for (const double curvature : {0.0, 0.004}) {
      const world::Scene scene = turned_scene(curvature);
      const AtlasPath path = small_atlas().path(atlas_plan(policy, 12.5), scene);
      const AtlasEgo ego(path, scene);
      for (const double time : {0.3, 0.9, 1.7, path.end + 0.5}) {
        if (time > ego.last_sample()) {
          continue;
        }
        constexpr double h = 1e-5;
        const Vec2 slope = (0.5 / h) * (ego.at(time + h).X_WB.p - ego.at(time - h).X_WB.p);
        EXPECT_NEAR(norm(slope - ego.at(time).v_W), 0.0, 2e-3)
            << manoeuvre::name(policy) << " at " << time;
      }
    }
  }
}

TEST(AtlasEgo, SensitivitiesAtTheSamplesAreThoseOfTheTime) {
  for (const auto policy : manoeuvre::all_policies) {
    world::Scene scene = turned_scene(0.003);
    scene.grip_sd = 0.06;
    const AtlasPath path = small_atlas().path(atlas_plan(policy, 12.5), scene);
    const AtlasEgo ego(path, scene);
    double most = 0.0;
    for (std::size_t k = 0; k <= num_spans; ++k) {
      const AtlasEgo::Sensitivities with_sensitivity = ego.with_sensitivity(sample_time(k));
      EXPECT_NEAR(static_cast<double>(ego.sensitivity_at_samples().less_x[k]),
                  with_sensitivity.less_W.x, 2e-3);
      EXPECT_NEAR(static_cast<double>(ego.sensitivity_at_samples().less_y[k]),
                  with_sensitivity.less_W.y, 2e-3);
      EXPECT_NEAR(static_cast<double>(ego.sensitivity_at_samples().more_x[k]),
                  with_sensitivity.more_W.x, 2e-3);
      EXPECT_NEAR(static_cast<double>(ego.sensitivity_at_samples().more_y[k]),
                  with_sensitivity.more_W.y, 2e-3);
      most = std::max({most, norm(with_sensitivity.less_W), norm(with_sensitivity.more_W)});
    }
    EXPECT_LE(most, ego.most_moved_by_grip() + 1e-3);
  }
}

// Drawn: half normal distributions on either side of 0.
TEST(AtlasEgo, HalvesHaveTheMomentsOfDraws) {
  std::mt19937_64 rng(1);
  std::normal_distribution<double> normal;
  double sum = 0.0;
  double squares = 0.0;
  constexpr int count = 200'000;
  for (int i = 0; i < count; ++i) {
    const double z = normal(rng);
    const double value = z < 0.0 ? -z * -0.7 : z * 0.3;
    sum += value;
    squares += value * value;
  }
  const Moments told = of_halves(-0.7, 0.3);
  EXPECT_NEAR(told.mean, sum / count, 0.005);
  EXPECT_NEAR(told.variance, squares / count - told.mean * told.mean, 0.005);
}

}  // namespace
}  // namespace saca::forecast::atlas_ego_test
