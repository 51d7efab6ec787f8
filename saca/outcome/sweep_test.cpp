#include "saca/outcome/sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "saca/manoeuvre/atlas_for_test.h"
#include "saca/outcome/approach.h"
#include "saca/outcome/edge.h"
#include "saca/outcome/encounters_for_test.h"

namespace saca::outcome {
namespace {

using manoeuvre::atlas_plan;
using manoeuvre::atlas_scene;
using manoeuvre::AtlasPath;
using manoeuvre::PolicyId;
using manoeuvre::small_atlas;

// The same way as poses every 5 ms, for the exact search that other tests hold to brute force.
world::Track sampled(const AtlasEgo& ego, double until) {
  world::Track track{.start = ego.scene().time, .step = 0.005, .X_WA = {}};
  for (int k = 0; k * track.step <= until; ++k) {
    track.X_WA.push_back(ego.at(k * track.step).X_WB);
  }
  return track;
}

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
  track = steady(actor.X_WA, actor.v_W, 0.1 * u(rng), 8.0);
  track.start = scene.time;
  return scene;
}

TEST(Sweep, FindsTheContactsAndTheClearanceOfTheExactSearch) {
  std::mt19937_64 rng(2);
  int touched = 0;
  for (int i = 0; i < 160; ++i) {
    world::Track track;
    const world::Scene scene = random_scene(rng, track);
    const auto policy = manoeuvre::all_policies[static_cast<std::size_t>(i) % 8];
    const AtlasPath path = small_atlas().path(atlas_plan(policy, scene.ego.v_B.x), scene);
    const AtlasEgo ego(path, scene);
    const double until = path.rests ? 8.0 : std::min(8.0, ego.last_look());
    const world::Track mine = sampled(ego, until);
    const Approach truth =
        approach(Mover(scene.ego_footprint, mine), Mover(scene.actors[0].footprint, track),
                 scene.time, scene.time + until, far_away);
    const Meeting told = meeting(ego, 0, track, boxes_of(track, scene.time), far_away, 1e9);
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
      // Along the axes of two boxes that pass corner to corner less is seen than there is.
      EXPECT_NEAR(told.clearance, truth.distance, 0.1 + 0.35 * truth.distance) << i;
      EXPECT_EQ(told.probability, 0.0);
    }
  }
  EXPECT_GT(touched, 20);
}

TEST(Sweep, BoxesHoldTheTrack) {
  std::mt19937_64 rng(4);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int i = 0; i < 30; ++i) {
    world::Track track =
        steady({{u(rng), u(rng)}, u(rng)}, {20.0 * u(rng), 20.0 * u(rng)}, 0.0, 6.0);
    for (std::size_t k = 0; k < track.X_WA.size(); ++k) {
      track.X_WA[k].p.y += std::sin(2.0 * track.step * static_cast<double>(k));  // sways
    }
    track.start = 2.0 + u(rng);
    const Boxes boxes = boxes_of(track, 2.0);
    for (double time = std::max(0.0, track.start - 2.0); time < 14.0; time += 0.013) {
      const auto piece = static_cast<std::size_t>(
          std::min(time / Boxes::piece, static_cast<double>(Boxes::count - 1)));
      const Vec2 p_W = pose_at(track, 2.0 + time).p;
      EXPECT_TRUE(p_W.x >= boxes.low[piece].x && p_W.x <= boxes.high[piece].x &&
                  p_W.y >= boxes.low[piece].y && p_W.y <= boxes.high[piece].y)
          << time;
    }
  }
}

TEST(Sweep, TheEgosBoxesHoldItsWay) {
  for (const PolicyId policy : manoeuvre::all_policies) {
    for (const double curvature : {0.0, 0.004}) {
      world::Scene scene = atlas_scene(12.5, 0.85);
      scene.road.curvature = curvature;
      const AtlasPath path = small_atlas().path(atlas_plan(policy, 12.5), scene);
      const AtlasEgo ego(path, scene);
      for (double time = 0.0; time < std::min(12.0, ego.last_look()); time += 0.017) {
        const auto piece = static_cast<std::size_t>(time / Boxes::piece);
        const Vec2 p_W = ego.at(time).X_WB.p;
        EXPECT_TRUE(p_W.x >= ego.boxes().low[piece].x && p_W.x <= ego.boxes().high[piece].x &&
                    p_W.y >= ego.boxes().low[piece].y && p_W.y <= ego.boxes().high[piece].y)
            << name(policy) << " at " << time;
      }
    }
  }
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
    const world::Track track = steady(actor.X_WA, {}, 0.0, 5.0);
    const AtlasPath path = small_atlas().path({PolicyId::no_intervention, std::nullopt}, scene);
    const Meeting told = meeting(AtlasEgo(path, scene), 0, track, boxes_of(track, 0.0), 100.0, 1e9);
    const double normal = 0.5 * std::erfc(gap / (0.3 * std::sqrt(2.0)));
    EXPECT_NEAR(told.probability, normal, gap < 0.0 ? 0.03 : 0.01) << gap;
  }
}

TEST(Sweep, AnEdgeIsCrossedWhenEdgeApproachSaysSo) {
  for (const double curvature : {0.0, 0.004}) {
    world::Scene scene = atlas_scene(12.5, 0.85);
    scene.road.curvature = curvature;
    scene.road.left_edge = 3.1;
    scene.road.right_edge = -2.0;
    const AtlasPath path = small_atlas().path(atlas_plan(PolicyId::aes_left, 12.5), scene);
    const AtlasEgo ego(path, scene);
    const world::Track mine = sampled(ego, ego.last_look());
    const EdgeApproach left =
        edge_approach(scene.road, Side::left, scene.ego_footprint, mine, far_away);
    const Meeting told = edge_meeting(ego, Side::left, far_away);
    ASSERT_TRUE(left.crossing && told.contact);
    EXPECT_NEAR(*told.contact, *left.crossing, 5e-3);
    const EdgeApproach right =
        edge_approach(scene.road, Side::right, scene.ego_footprint, mine, far_away);
    const Meeting other = edge_meeting(ego, Side::right, far_away);
    EXPECT_EQ(other.contact, std::nullopt);
    EXPECT_NEAR(other.clearance, right.room, 0.02);
  }
}

}  // namespace
}  // namespace saca::outcome
