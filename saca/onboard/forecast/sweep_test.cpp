#include "saca/onboard/forecast/sweep.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "saca/base/core/percentile.h"
#include "saca/onboard/atlas/atlas_for_test.h"
#include "saca/onboard/collision/approach.h"
#include "saca/onboard/forecast/atlas_ego_for_test.h"
#include "saca/thinking/rollout/encounters_for_test.h"

namespace saca::forecast::sweep_test {
namespace {

using atlas::atlas_plan;
using atlas::atlas_scene;
using atlas::AtlasPath;
using atlas::small_atlas;
using manoeuvre::PolicyId;

// A scene with somebody who crosses, comes or drives along, on a straight track.
world::Scene random_scene(std::mt19937_64& rng, world::Track& track) {
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  world::Scene scene = atlas_scene(12.5 + 0.5 * u(rng), 0.85);
  scene.time = 3.0;
  scene.ego.X_WB = {{20.0 * u(rng), 5.0 * u(rng)}, u(rng)};
  scene.road.X_WL = scene.ego.X_WB;
  const bool walks = u(rng) > 0.4;
  world::Actor actor{.id = 1, .mass = 1500.0};
  actor.footprint = walks ? world::Footprint{world::Shape::ellipse, 0.6, 0.5, 0.0}
                          : world::Footprint{world::Shape::box, 4.5, 1.8, 0.2};
  const Pose X_LA{{16.0 + 10.0 * u(rng), 5.0 * u(rng)}, 3.0 * u(rng)};
  actor.X_WA = scene.ego.X_WB * X_LA;
  actor.v_W = rotated({walks ? 1.5 : 7.0, 0.0}, actor.X_WA.yaw);
  scene.actors.push_back(actor);
  track = rollout::steady(actor.X_WA, actor.v_W, 0.1 * u(rng), 8.0);
  track.start = scene.time;
  return scene;
}

ContactForecast forecast(const AtlasEgo& ego, const world::Track& track, double of_interest) {
  const world::Scene& scene = ego.scene();
  const std::array samples{
      pose_samples_of(track, scene.actors[0].footprint, scene.time, scene.ego.X_WB.p)};
  return meetings(ego, std::span(&track, 1), samples, {}, of_interest, 1e9)[0];
}

TEST(Sweep, FindsTheContactsAndTheClearanceOfTheExactSearch) {
  std::mt19937_64 rng(2);
  int touched = 0;
  std::vector<double> off;
  for (int i = 0; i < 160; ++i) {
    world::Track track;
    const world::Scene scene = random_scene(rng, track);
    const auto policy = manoeuvre::all_policies[static_cast<std::size_t>(i) % 8];
    const AtlasPath path = small_atlas().path(atlas_plan(policy, scene.ego.v_B.x), scene);
    const AtlasEgo ego(path, scene);
    const double until = path.rests ? 8.0 : std::min(8.0, ego.last_sample());
    const world::Track mine = sampled(ego, until);
    const collision::Approach truth =
        collision::approach(collision::Mover(scene.ego_footprint, mine),
                            collision::Mover(scene.actors[0].footprint, track), scene.time,
                            scene.time + until, collision::far_away);
    const ContactForecast told = forecast(ego, track, collision::far_away);
    const bool graze = !truth.contact && truth.distance < 0.02;
    if (graze) {
      continue;
    }
    ASSERT_EQ(told.contact.has_value(), truth.contact.has_value())
        << i << " distance " << truth.distance;
    if (truth.contact) {
      ++touched;
      EXPECT_NEAR(scene.time + *told.contact, *truth.contact, 2e-3) << i;
      EXPECT_EQ(told.clearance, 0.0);
      EXPECT_EQ(told.probability, 1.0);
    } else if (truth.distance < 5.0) {
      // Where two boxes pass corner to corner, the gap along their axes, which says where to look,
      // is least a little earlier or later than the distance.
      EXPECT_NEAR(told.clearance, truth.distance, 0.05 + 0.15 * truth.distance) << i;
      off.push_back(std::abs(told.clearance - truth.distance));
      ASSERT_TRUE(told.nearest_at) << i;
      EXPECT_NEAR(world::separation(scene.ego_footprint, ego.at(*told.nearest_at).X_WB,
                                    scene.actors[0].footprint,
                                    world::pose_at(track, scene.time + *told.nearest_at))
                      .distance,
                  told.clearance, 0.01)
          << i;
      EXPECT_EQ(told.probability, 0.0);
    }
  }
  EXPECT_GT(touched, 20);
  EXPECT_LT(percentile(off, 0.9), 0.05);
}

// A car stands beside the way of an ego that goes straight on, `gap` away; where it stands is known
// to 0.3 m. What the place along the road does not matter for is normal in the one across.
TEST(Sweep, ProbabilityIsThatOfTheNormalDistribution) {
  for (const double gap : {-0.3, 0.0, 0.15, 0.3, 0.6}) {
    world::Scene scene = atlas_scene(12.5, 0.85);
    world::Actor actor{.id = 1, .footprint = {.length = 4.5, .width = 1.8}, .mass = 1500.0};
    actor.X_WA.p = {30.0, 1.8 + gap};
    actor.position_sd = 0.3;
    scene.actors.push_back(actor);
    const world::Track track = rollout::steady(actor.X_WA, {}, 0.0, 5.0);
    const AtlasPath path = small_atlas().path({PolicyId::no_intervention, std::nullopt}, scene);
    const ContactForecast told = forecast(AtlasEgo(path, scene), track, 100.0);
    const double normal = 0.5 * std::erfc(gap / (0.3 * std::sqrt(2.0)));
    EXPECT_NEAR(told.probability, normal, gap < 0.0 ? 0.03 : 0.01) << gap;
  }
}

// Who may come later never changes whom the ego meets, and the nearest alone gives the clearance.
TEST(Sweep, ManyAreAsEachAlone) {
  std::mt19937_64 rng(11);
  int untouched = 0;
  for (int i = 0; i < 60; ++i) {
    std::vector<world::Track> tracks(4);
    world::Scene scene = random_scene(rng, tracks[0]);
    for (std::size_t k = 1; k < tracks.size(); ++k) {
      const world::Scene other = random_scene(rng, tracks[k]);
      world::Actor actor = other.actors[0];
      actor.id = static_cast<std::uint8_t>(k + 1);
      scene.actors.push_back(actor);
    }
    const auto policy = manoeuvre::all_policies[static_cast<std::size_t>(i) % 8];
    const AtlasPath path = small_atlas().path(atlas_plan(policy, scene.ego.v_B.x), scene);
    const AtlasEgo ego(path, scene);
    std::vector<PoseSamples> samples;
    std::optional<double> first;
    double least = collision::far_away;
    for (std::size_t k = 0; k < tracks.size(); ++k) {
      samples.push_back(
          pose_samples_of(tracks[k], scene.actors[k].footprint, scene.time, scene.ego.X_WB.p));
      world::Scene alone = scene;
      alone.actors.clear();
      alone.actors.push_back(scene.actors[k]);
      const ContactForecast told = forecast(AtlasEgo(path, alone), tracks[k], collision::far_away);
      if (told.contact && (!first || *told.contact < *first)) {
        first = told.contact;
      }
      least = std::min(least, told.clearance);
    }
    const ContactForecasts all = meetings(ego, tracks, samples, {}, collision::far_away, 1e9);
    std::optional<double> met;
    for (const ContactForecast& one : all) {
      met = one.contact && (!met || *one.contact < *met) ? one.contact : met;
    }
    ASSERT_EQ(met.has_value(), first.has_value()) << i;
    if (first) {
      EXPECT_DOUBLE_EQ(*met, *first);
    } else {
      ++untouched;
      double told = collision::far_away;
      for (const ContactForecast& one : all) {
        told = std::min(told, one.clearance);
      }
      // Each alone is looked at between other neighbours: what a search of its minimum leaves.
      EXPECT_NEAR(told, least, 0.02 + 0.02 * least) << i;
    }
  }
  EXPECT_GT(untouched, 5);
}

}  // namespace
}  // namespace saca::forecast::sweep_test
