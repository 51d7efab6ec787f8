#include "saca/onboard/forecast/futures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "saca/onboard/atlas/atlas_for_test.h"
#include "saca/thinking/rollout/encounters_for_test.h"
#include "saca/thinking/rollout/roll_out.h"
#include "tests/support/count_allocations.h"

namespace saca::forecast::futures_test {
namespace {

using atlas::atlas_plan;
using atlas::atlas_scene;
using atlas::small_atlas;
using atlas::small_atlas_car;
using manoeuvre::all_policies;
using manoeuvre::PolicyId;

const collision::HarmModel& harm() {
  static const collision::HarmModel model = rollout::shipped_harm();
  return model;
}

struct Staged {
  world::Scene scene = atlas_scene(12.6, 0.86);
  std::vector<world::Track> tracks;

  void add(world::ActorKind kind, Pose X_WA, Vec2 v_W) {
    world::Actor actor{.id = static_cast<std::uint8_t>(tracks.size() + 1), .kind = kind};
    const bool walks = kind == world::ActorKind::pedestrian;
    actor.footprint = walks ? world::Footprint{world::Shape::ellipse, 0.5, 0.5, 0.0}
                            : world::Footprint{world::Shape::box, 4.5, 1.8, 0.0};
    actor.mass = walks ? 75.0 : 1500.0;
    actor.X_WA = X_WA;
    actor.v_W = v_W;
    scene.actors.push_back(actor);
    tracks.push_back(rollout::steady(X_WA, v_W, 0.0, 6.0));
  }
};

Staged random_stage(std::mt19937_64& rng) {
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  Staged stage;
  stage.scene.ego.v_B.x = 12.5 + 0.5 * u(rng);
  stage.scene.grip = 0.85 + 0.05 * u(rng);
  stage.scene.road.left_edge = 5.5 + u(rng);
  stage.scene.road.left_beyond = u(rng) > 0.0 ? world::Beyond::barrier : world::Beyond::kerb;
  const double yaw = std::numbers::pi * u(rng);
  stage.add(world::ActorKind::car, {{17.0 + 6.0 * u(rng), 2.0 * u(rng)}, yaw},
            rotated({4.0 + 3.0 * u(rng), 0.0}, yaw));
  stage.add(world::ActorKind::pedestrian, {{22.0 + 6.0 * u(rng), 4.0 * u(rng)}, 1.5},
            {0.1 * u(rng), 1.5 * u(rng)});
  return stage;
}

// Against full physics: nine of ten that disagree would be grazes, so one of 160 may.
TEST(Futures, AgreeWithRollOut) {
  std::mt19937_64 rng(1);
  int differ = 0;
  int hits = 0;
  for (int i = 0; i < 20; ++i) {
    const Staged stage = random_stage(rng);
    for (const PolicyId policy : all_policies) {
      const auto plan = atlas_plan(policy, stage.scene.ego.v_B.x);
      const Future told = future(small_atlas(), plan, stage.scene, stage.tracks, harm());
      const collision::Outcome truth = rollout::roll_out(small_atlas_car(), plan, stage.scene,
                                                         stage.tracks, stage.scene.grip, harm());
      ASSERT_EQ(told.outside, std::nullopt);
      if (told.contact.has_value() != truth.contact.has_value()) {
        ++differ;
        continue;
      }
      if (truth.contact) {
        ++hits;
        EXPECT_EQ(told.contact->actor, truth.contact->actor) << i << " " << manoeuvre::name(policy);
        EXPECT_NEAR(told.contact->relative_speed, truth.contact->relative_speed, 0.6);
        EXPECT_NEAR(told.contact->time, truth.contact->time, 0.06);
        EXPECT_EQ(told.probability, 1.0);
      } else {
        EXPECT_NEAR(told.clearance, truth.clearance, 0.3 + 0.3 * truth.clearance);
        EXPECT_EQ(told.probability, 0.0);
      }
    }
  }
  EXPECT_LE(differ, 1);
  EXPECT_GT(hits, 30);
}

// One impact alone: what happens then is the same function's doing.
TEST(Futures, HarmOfOneImpactIsThatOfRollOut) {
  Staged stage;
  stage.add(world::ActorKind::car, {{14.0, 0.3}, 0.0}, {});
  const auto plan = atlas_plan(PolicyId::no_intervention, 12.6);
  const Future told = future(small_atlas(), plan, stage.scene, stage.tracks, harm());
  const collision::Outcome truth = rollout::roll_out(small_atlas_car(), plan, stage.scene,
                                                     stage.tracks, stage.scene.grip, harm());
  ASSERT_TRUE(truth.contact && truth.later.empty());
  EXPECT_NEAR(told.harm, truth.harm, 0.02 * truth.harm);
  EXPECT_EQ(told.harm, told.harm_at_mean);
  stage.scene.actors[0].existence = 0.25;
  const Future doubtful = future(small_atlas(), plan, stage.scene, stage.tracks, harm());
  EXPECT_NEAR(doubtful.harm, 0.25 * told.harm, 1e-12);
  EXPECT_NEAR(doubtful.probability, 0.25, 1e-12);
}

struct ToldAndDrawn {
  double told = 0.0;   // harm of all that the mean misses and may be met
  double drawn = 0.0;  // likewise
  int counted = 0;
  int far_off = 0;
};
// Where the mean passes, what the other's place is not known by decides: against draws of that
// place, each a future of its own.
ToldAndDrawn told_and_drawn(world::Spread sd, int num_stages) {
  std::mt19937_64 rng(3);
  constexpr int num_draws = 400;
  std::normal_distribution<double> normal;
  const std::vector<world::SpreadOverTime> spreads{{.at = {sd}}};
  ToldAndDrawn sums;
  for (int i = 0; i < num_stages; ++i) {
    Staged stage = random_stage(rng);
    const world::Actor car = stage.scene.actors[0];  // it alone
    stage.scene.actors = {};
    stage.scene.actors.push_back(car);
    stage.tracks.resize(1);
    stage.scene.road.left_edge = 30.0;
    stage.scene.road.right_edge = -30.0;
    for (const PolicyId policy : all_policies) {
      const auto plan = atlas_plan(policy, stage.scene.ego.v_B.x);
      const Future told =
          future(small_atlas(), plan, stage.scene, stage.tracks, harm(), {.spreads = spreads});
      if (told.contact || told.probability < 0.05) {
        continue;
      }
      double sum = 0.0;
      for (int k = 0; k < num_draws; ++k) {
        Staged drawn = stage;
        const double along = sd.along_sd * normal(rng);
        const double across = sd.across_sd * normal(rng);
        const Vec2 off = rotated({along, across}, car.X_WA.yaw);
        drawn.scene.actors[0].X_WA.p = drawn.scene.actors[0].X_WA.p + off;
        for (Pose& pose : drawn.tracks[0].X_WA) {
          pose.p = pose.p + off;
        }
        sum += future(small_atlas(), plan, drawn.scene, drawn.tracks, harm()).harm;
      }
      const double drawn = sum / num_draws;
      ++sums.counted;
      sums.told += told.harm;
      sums.drawn += drawn;
      sums.far_off += told.harm < 0.4 * drawn || told.harm > 2.5 * drawn ? 1 : 0;
    }
  }
  return sums;
}

TEST(Futures, HarmOfWhoIsMissedAtTheMeanIsThatOfDraws) {
  for (const world::Spread sd : {world::Spread{0.5, 0.5}, world::Spread{1.2, 0.2}}) {
    const ToldAndDrawn sums = told_and_drawn(sd, 40);
    EXPECT_GT(sums.counted, 20);
    EXPECT_LE(sums.far_off, sums.counted / 5) << sd.along_sd;
    EXPECT_NEAR(sums.told, sums.drawn, 0.25 * sums.drawn) << sd.along_sd;
  }
}

// Turned by a right angle and moved, all is the same.
TEST(Futures, DoNotDependOnTheWorldsFrame) {
  std::mt19937_64 rng(8);
  const Pose X_VW{{100.0, -40.0}, 0.5 * std::numbers::pi};
  for (int i = 0; i < 10; ++i) {
    const Staged stage = random_stage(rng);
    Staged turned = stage;
    turned.scene.ego.X_WB = X_VW * stage.scene.ego.X_WB;
    turned.scene.road.X_WL = X_VW * stage.scene.road.X_WL;
    for (std::size_t k = 0; k < stage.tracks.size(); ++k) {
      turned.scene.actors[k].X_WA = X_VW * stage.scene.actors[k].X_WA;
      turned.scene.actors[k].v_W = rotated(stage.scene.actors[k].v_W, X_VW.yaw);
      for (Pose& pose : turned.tracks[k].X_WA) {
        pose = X_VW * pose;
      }
    }
    const Futures a =
        futures(small_atlas(), stage.scene, stage.tracks, harm(), {.shares = std::array{0.5}});
    const Futures b =
        futures(small_atlas(), turned.scene, turned.tracks, harm(), {.shares = std::array{0.5}});
    for (std::size_t p = 0; p < a.size(); ++p) {
      ASSERT_EQ(a[p].contact.has_value(), b[p].contact.has_value());
      EXPECT_NEAR(a[p].harm, b[p].harm, 1e-3 * (1.0 + a[p].harm));
      // The boxes that narrow the search lie along the world's axes.
      EXPECT_NEAR(a[p].clearance, b[p].clearance, 0.05 + 0.05 * a[p].clearance);
      if (a[p].contact) {
        EXPECT_NEAR(a[p].contact->time, b[p].contact->time, 1e-4);
        EXPECT_EQ(a[p].contact->ego_face, b[p].contact->ego_face);
      }
    }
  }
}

TEST(Futures, TheMirrorSwapsLeftAndRight) {
  std::mt19937_64 rng(9);
  for (int i = 0; i < 10; ++i) {
    Staged stage = random_stage(rng);
    stage.scene.road.right_edge = -stage.scene.road.left_edge - 1.0;
    Staged mirrored = stage;
    mirrored.scene.road.left_edge = -stage.scene.road.right_edge;
    mirrored.scene.road.right_edge = -stage.scene.road.left_edge;
    std::swap(mirrored.scene.road.left_beyond, mirrored.scene.road.right_beyond);
    for (std::size_t k = 0; k < stage.tracks.size(); ++k) {
      world::Actor& actor = mirrored.scene.actors[k];
      actor.X_WA = {{actor.X_WA.p.x, -actor.X_WA.p.y}, -actor.X_WA.yaw};
      actor.v_W.y = -actor.v_W.y;
      for (Pose& pose : mirrored.tracks[k].X_WA) {
        pose = {{pose.p.x, -pose.p.y}, -pose.yaw};
      }
    }
    const Futures a =
        futures(small_atlas(), stage.scene, stage.tracks, harm(), {.shares = std::array{0.5}});
    const Futures b = futures(small_atlas(), mirrored.scene, mirrored.tracks, harm(),
                              {.shares = std::array{0.5}});
    constexpr std::array<std::size_t, 8> mirror{0, 2, 1, 4, 3, 6, 5, 7};
    for (std::size_t p = 0; p < a.size(); ++p) {
      const Future& other = b[mirror[p]];
      ASSERT_EQ(a[p].contact.has_value(), other.contact.has_value()) << p;
      EXPECT_NEAR(a[p].harm, other.harm, 1e-3 * (1.0 + other.harm));
      EXPECT_NEAR(a[p].clearance, other.clearance, 0.02);
    }
  }
}

// A wall stands where the stop comes to within a metre of it. How often grip that is only known to
// 6 % takes the car there: drawn, driven and counted.
TEST(Futures, ProbabilityUnderUnknownGripIsThatOfDraws) {
  std::mt19937_64 rng(6);
  std::normal_distribution<double> normal;
  Staged stage;
  constexpr int count = 40;
  const auto plan = atlas_plan(PolicyId::aeb, 12.6);
  std::vector<double> ways;
  for (int i = 0; i < count; ++i) {
    const double grip = stage.scene.grip * (1.0 + 0.06 * normal(rng));
    ways.push_back(drive(small_atlas_car(), plan, stage.scene, grip, 10.0).track.X_WA.back().p.x);
  }
  stage.scene.grip_sd = 0.06 * stage.scene.grip;
  for (const double room : {9.6, 10.0, 10.6}) {
    Staged now = stage;
    now.add(world::ActorKind::car, {{2.25 + room + 2.25, 0.0}, 0.0}, {});
    const double drawn = static_cast<double>(std::count_if(
                             ways.begin(), ways.end(), [&](double way) { return way > room; })) /
                         count;
    const Future told = future(small_atlas(), plan, now.scene, now.tracks, harm());
    // Two standard deviations of a share of 40 are 0.16.
    EXPECT_NEAR(told.probability, drawn, 0.18) << room;
  }
}

TEST(Futures, TakeTheTargetSpeedThatHarmsLeast) {
  std::mt19937_64 rng(12);
  for (int i = 0; i < 10; ++i) {
    const Staged stage = random_stage(rng);
    const Futures all = futures(small_atlas(), stage.scene, stage.tracks, harm(),
                                {.shares = std::array{0.5, 0.0, 0.4}});
    for (const PolicyId policy : {PolicyId::es_b_left, PolicyId::es_b_right}) {
      const Future& best = all[manoeuvre::index(policy)];
      for (const double share : {0.5, 0.0, 0.4}) {
        const Future one = future(small_atlas(), atlas_plan(policy, stage.scene.ego.v_B.x, share),
                                  stage.scene, stage.tracks, harm());
        EXPECT_FALSE(better(one, best));
      }
    }
  }
}

// Of braking likewise, and the hardest of equals; without strengths there is full braking alone.
TEST(Futures, BrakeByTheStrengthThatHarmsLeast) {
  std::mt19937_64 rng(13);
  for (int i = 0; i < 30; ++i) {
    Staged stage = random_stage(rng);
    if (i % 2 == 0) {  // who comes from behind and does not brake
      stage.add(world::ActorKind::car, {{-9.0 - i, 0.0}, 0.0}, {11.0, 0.0});
    }
    const Future best = futures(small_atlas(), stage.scene, stage.tracks, harm())[0];
    for (const double strength : {1.0, 0.8, 0.6, 0.45, 0.3}) {
      const manoeuvre::Plan plan{.policy = PolicyId::aeb, .strength = strength};
      const Future one = future(small_atlas(), plan, stage.scene, stage.tracks, harm());
      EXPECT_FALSE(better(one, best)) << strength;
      EXPECT_TRUE(strength <= strength_of(best.plan) || better(best, one)) << strength;
    }
    const Futures published =
        futures(small_atlas(), stage.scene, stage.tracks, harm(), {.strengths = {}});
    EXPECT_EQ(published[0].plan, manoeuvre::full_braking);
  }
}

// Who brakes behind us with 4 m/s^2 runs into who stops with all the grip, not into who takes 0.45.
TEST(Futures, BrakeGentlyBeforeWhoFollows) {
  Staged stage;
  stage.scene.ego.v_B.x = 12.5;
  stage.scene.grip = 0.85;
  stage.add(world::ActorKind::car, {{-8.0, 0.0}, 0.0}, {12.5, 0.0});
  stage.tracks[0] = {.start = stage.scene.time, .step = 0.05, .X_WA = {}};
  for (int k = 0; k <= 200; ++k) {
    const double t = std::min(0.05 * k, 12.5 / 4.0);
    stage.tracks[0].X_WA.push_back({{-8.0 + 12.5 * t - 2.0 * t * t, 0.0}, 0.0});
  }
  EXPECT_TRUE(
      future(small_atlas(), manoeuvre::full_braking, stage.scene, stage.tracks, harm()).contact);
  const Future best = futures(small_atlas(), stage.scene, stage.tracks, harm())[0];
  EXPECT_FALSE(best.contact);
  EXPECT_LE(strength_of(best.plan), 0.45);
}

TEST(Futures, WhatCannotBeJudgedSaysWhy) {
  Staged stage;
  stage.add(world::ActorKind::car, {{14.0, 0.3}, 0.0}, {});
  const auto plan = atlas_plan(PolicyId::aeb, 12.6);
  const auto outside = [&](const world::Scene& scene, std::span<const world::Track> tracks) {
    return future(small_atlas(), plan, scene, tracks, harm()).outside;
  };
  EXPECT_EQ(outside(stage.scene, {}), atlas::AtlasLimit::no_number);
  std::vector<world::Track> tracks = stage.tracks;
  tracks[0].X_WA.back().p.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(outside(stage.scene, tracks), atlas::AtlasLimit::no_number);
  tracks[0].X_WA.clear();
  EXPECT_EQ(outside(stage.scene, tracks), atlas::AtlasLimit::no_number);
  world::Scene fast = stage.scene;
  fast.ego.v_B.x = 40.0;
  EXPECT_EQ(outside(fast, stage.tracks), atlas::AtlasLimit::speed);
  const Futures all = futures(small_atlas(), fast, stage.tracks, harm());
  for (const Future& one : all) {
    EXPECT_NE(one.outside, std::nullopt) << manoeuvre::name(one.plan.policy);
  }
  Future inside;
  inside.harm = 5.0;
  EXPECT_TRUE(better(inside, all[0]));
  EXPECT_FALSE(better(all[0], inside));
}

TEST(Futures, AllocateNothing) {
  std::mt19937_64 rng(3);
  Staged stage = random_stage(rng);
  while (stage.tracks.size() < world::max_actors) {
    const double x = 10.0 + 3.0 * static_cast<double>(stage.tracks.size());
    stage.add(world::ActorKind::car, {{x, x > 50.0 ? 0.5 : 3.6}, 0.0}, {6.0, 0.0});
  }
  stage.scene.actors[2].X_WA.p = {13.5, 0.2};  // where braking ends
  stage.tracks[2] = rollout::steady(stage.scene.actors[2].X_WA, {}, 0.0, 6.0);
  for (world::Actor& actor : stage.scene.actors) {
    actor.position_sd = 0.2;
  }
  stage.scene.grip_sd = 0.05;
  const collision::HarmModel& model = harm();
  const atlas::Atlas& atlas = small_atlas();
  const std::size_t before = num_allocations;
  const Futures all = futures(atlas, stage.scene, stage.tracks, model);
  EXPECT_EQ(num_allocations, before);
  EXPECT_EQ(all[0].outside, std::nullopt);
  EXPECT_GT(all[0].probability, 0.0);
}

}  // namespace
}  // namespace saca::forecast::futures_test
