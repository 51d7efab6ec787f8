#include "saca/onboard/forecast/edge_sweep.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saca/onboard/atlas/atlas_for_test.h"
#include "saca/onboard/collision/edge.h"
#include "saca/onboard/forecast/atlas_ego_for_test.h"

namespace saca::forecast::edge_sweep_test {
namespace {

using atlas::atlas_plan;
using atlas::atlas_scene;
using atlas::AtlasPath;
using atlas::small_atlas;
using manoeuvre::PolicyId;

TEST(EdgeSweep, AnEdgeIsCrossedWhenEdgeApproachSaysSo) {
  for (const double curvature : {0.0, 0.004}) {
    world::Scene scene = atlas_scene(12.5, 0.85);
    scene.road.curvature = curvature;
    scene.road.left_edge = 3.1;
    scene.road.right_edge = -2.0;
    const AtlasPath path = small_atlas().path(atlas_plan(PolicyId::aes_left, 12.5), scene);
    const AtlasEgo ego(path, scene);
    const world::Track mine = sampled(ego, ego.last_sample());
    const collision::EdgeApproach left = collision::edge_approach(
        scene.road, collision::Side::left, scene.ego_footprint, mine, collision::far_away);
    const ContactForecast told =
        edge_contact_forecast(ego, collision::Side::left, collision::far_away);
    ASSERT_TRUE(left.crossing && told.contact);
    EXPECT_NEAR(*told.contact, *left.crossing, 5e-3);
    const collision::EdgeApproach right = collision::edge_approach(
        scene.road, collision::Side::right, scene.ego_footprint, mine, collision::far_away);
    const ContactForecast other =
        edge_contact_forecast(ego, collision::Side::right, collision::far_away);
    EXPECT_EQ(other.contact, std::nullopt);
    EXPECT_NEAR(other.clearance, right.clearance, 0.02);
  }
}

// The ego's side touches the edge in the mean; grip that it has more or less of does not move it
// aside when it goes straight on.
TEST(EdgeSweep, WhatIsNotSensitiveToGripIsSure) {
  world::Scene scene = atlas_scene(12.5, 0.85);
  scene.grip_sd = 0.05;
  scene.road.left_edge = 1.0;
  const AtlasPath path = small_atlas().path(atlas_plan(PolicyId::no_intervention, 12.5), scene);
  const ContactForecast beside =
      edge_contact_forecast(AtlasEgo(path, scene), collision::Side::left, collision::far_away);
  EXPECT_EQ(beside.contact, std::nullopt);
  EXPECT_EQ(beside.probability, 0.0);
  EXPECT_NEAR(beside.clearance, 0.1, 1e-6);
  scene.road.left_edge = 0.8;
  const ContactForecast beyond =
      edge_contact_forecast(AtlasEgo(path, scene), collision::Side::left, collision::far_away);
  EXPECT_EQ(beyond.contact, 0.0);
  EXPECT_EQ(beyond.probability, 1.0);
}

// A lane change whose farthest side, as the atlas tells it, lies on the edge: half of what wrong
// grip does takes it beyond, where it does something aside at all.
TEST(EdgeSweep, ProbabilityFallsWithTheRoom) {
  world::Scene scene = atlas_scene(12.5, 0.85);
  scene.grip_sd = 0.08;
  const AtlasPath path = small_atlas().path(atlas_plan(PolicyId::aes_left, 12.5), scene);
  scene.road.left_edge = 60.0;
  const double farthest =
      60.0 - edge_contact_forecast(AtlasEgo(path, scene), collision::Side::left, 100.0).clearance;
  double before = 1.1;
  for (const double room : {-0.3, -0.05, -0.01, 0.01, 0.3, 2.0}) {
    scene.road.left_edge = farthest + room;
    const ContactForecast told =
        edge_contact_forecast(AtlasEgo(path, scene), collision::Side::left, collision::far_away);
    EXPECT_EQ(told.contact.has_value(), room < 0.0) << room;
    EXPECT_LE(told.probability, before) << room;
    before = told.probability;
  }
  EXPECT_LT(before, 1e-3);
}

}  // namespace
}  // namespace saca::forecast::edge_sweep_test
