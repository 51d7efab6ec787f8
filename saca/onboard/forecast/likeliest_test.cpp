#include "saca/onboard/forecast/likeliest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "saca/onboard/atlas/atlas_for_test.h"
#include "saca/thinking/rollout/encounters_for_test.h"

namespace saca::forecast::likeliest_test {
namespace {

using atlas::AtlasPath;
using manoeuvre::PolicyId;

// Against samples every 5 ms: no instant is likelier by more than a tenth of a standard deviation,
// in nine of ten encounters.
TEST(Likeliest, IsTheSmallestScoreOfManySamples) {
  std::mt19937_64 rng(4);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  int off = 0;
  int counted = 0;
  for (int i = 0; i < 160; ++i) {
    world::Scene scene = atlas::atlas_scene(12.5, 0.85);
    scene.grip_sd = i % 2 == 0 ? 0.05 : 0.0;
    world::Actor actor{.id = 1, .footprint = {.length = 4.5, .width = 1.8}, .mass = 1500.0};
    actor.X_WA = {{18.0 + 8.0 * u(rng), 4.0 * u(rng)}, 3.0 * u(rng)};
    actor.v_W = rotated({5.0, 0.0}, actor.X_WA.yaw);
    actor.position_sd = 0.3;
    actor.velocity_sd = 0.3;
    scene.actors.push_back(actor);
    const world::Track track = rollout::steady(actor.X_WA, actor.v_W, 0.1 * u(rng), 3.2);
    const auto policy = manoeuvre::all_policies[static_cast<std::size_t>(i) % 8];
    const AtlasPath path = atlas::small_atlas().path(atlas::atlas_plan(policy, 12.5), scene);
    const AtlasEgo ego(path, scene);
    const PoseSamples samples = pose_samples_of(track, actor.footprint, 0.0, {});
    const NarrowPhase both(ego, 0, track, samples);
    const auto near = std::make_unique<PairSamples>();
    const Window window{.from = 0.0, .to = 3.2, .first = 0, .last = 3, .any = true};
    compare_samples(ego.samples(), samples, 0, 3, *near);
    ContactForecast found;
    find_likeliest(both, window, *near, found);
    double least = 1e9;
    for (double time = 0.0; time <= 3.2; time += 0.005) {
      least = std::min(least, both.scores(both.state_at(time)).most);
    }
    const double true_chance = 0.5 * std::erfc(least * std::sqrt(0.5));
    EXPECT_LE(found.probability, true_chance + 0.02) << i;
    if (std::abs(least) < 3.0) {
      ++counted;
      const double nearby = 0.5 * std::erfc((least + 0.1) * std::sqrt(0.5));
      off += found.probability < nearby ? 1 : 0;
    }
  }
  EXPECT_GT(counted, 40);
  EXPECT_LE(off, counted / 10);
}

// A stop on another grip is longer or shorter, not farther aside: who stands beside its way by
// 5 cm is not struck, though ahead of its end there are only 10 cm.
TEST(Likeliest, WhatGripDoesNotMoveAsideMissesWhoIsBeside) {
  world::Scene scene = atlas::atlas_scene(12.5, 0.85);
  scene.grip_sd = 0.06;
  const AtlasPath path = atlas::small_atlas().path({PolicyId::aeb, std::nullopt}, scene);
  const AtlasEgo ego(path, scene);
  const Pose rest = ego.at(path.end + 1.0).X_WB;
  const world::Footprint& body = scene.ego_footprint;
  const auto chance = [&](double ahead, double aside) {
    world::Scene with = scene;
    world::Actor actor{.id = 1, .footprint = {}, .mass = 1500.0};
    actor.footprint = body;
    actor.X_WA = {{rest.p.x + ahead, rest.p.y + aside}, 0.0};
    with.actors.push_back(actor);
    const world::Track track = rollout::steady(actor.X_WA, {}, 0.0, 3.2);
    const AtlasEgo among(path, with);
    const PoseSamples samples = pose_samples_of(track, actor.footprint, 0.0, {});
    const auto near = std::make_unique<PairSamples>();
    compare_samples(among.samples(), samples, 0, num_groups - 1, *near);
    ContactForecast found;
    find_likeliest(NarrowPhase(among, 0, track, samples),
                   {.from = 0.0, .to = 22.0, .first = 0, .last = num_groups - 1, .any = true},
                   *near, found);
    return found.probability;
  };
  EXPECT_LT(chance(body.length + 0.1, body.width + 0.05), 1e-4);
  EXPECT_LT(chance(body.length + 0.1, -body.width - 0.05), 1e-4);
  // Straight ahead it is, at rest, as likely as ways that long are.
  const AtlasEgo::Sensitivities with_sensitivity = ego.with_sensitivity(path.end + 5.0);
  const Moments longer = of_halves(with_sensitivity.less_W.x, with_sensitivity.more_W.x);
  EXPECT_NEAR(chance(body.length + 0.1, 0.0),
              0.5 * std::erfc((0.1 - longer.mean) / std::sqrt(2.0 * longer.variance)), 0.01);
}

// Nobody is near: nothing is likely.
TEST(Likeliest, OfWhoIsFarIsNothing) {
  world::Scene scene = atlas::atlas_scene(12.5, 0.85);
  world::Actor actor{.id = 1, .footprint = {.length = 4.5, .width = 1.8}, .mass = 1500.0};
  actor.X_WA = {{20.0, 12.0}, 0.0};
  actor.position_sd = 0.3;
  scene.actors.push_back(actor);
  const world::Track track = rollout::steady(actor.X_WA, {}, 0.0, 3.2);
  const AtlasPath path =
      atlas::small_atlas().path({PolicyId::no_intervention, std::nullopt}, scene);
  const AtlasEgo ego(path, scene);
  const PoseSamples samples = pose_samples_of(track, actor.footprint, 0.0, {});
  const auto near = std::make_unique<PairSamples>();
  compare_samples(ego.samples(), samples, 0, 3, *near);
  ContactForecast found;
  find_likeliest(NarrowPhase(ego, 0, track, samples),
                 {.from = 0.0, .to = 3.2, .first = 0, .last = 3, .any = true}, *near, found);
  EXPECT_EQ(found.probability, 0.0);
}

}  // namespace
}  // namespace saca::forecast::likeliest_test
