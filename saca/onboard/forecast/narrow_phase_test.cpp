#include "saca/onboard/forecast/narrow_phase.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saca/onboard/atlas/atlas_for_test.h"
#include "saca/thinking/rollout/encounters_for_test.h"

namespace saca::forecast::narrow_phase_test {
namespace {

using atlas::AtlasPath;
using manoeuvre::PolicyId;

// Straight on at 12.5 m/s towards a car that stands 30 m ahead, both 4.5 m long.
struct Approaching {
  world::Scene scene = atlas::atlas_scene(12.5, 0.85);
  world::Track track;
  AtlasPath path;

  explicit Approaching(world::Footprint other, double place_sd = 0.0) {
    world::Actor actor{.id = 1, .footprint = other, .mass = 1500.0};
    actor.X_WA.p = {30.0, 0.2};
    actor.position_sd = place_sd;
    scene.actors.push_back(actor);
    track = rollout::steady(actor.X_WA, {}, 0.0, 5.0);
    path = atlas::small_atlas().path({PolicyId::no_intervention, std::nullopt}, scene);
  }
};

TEST(NarrowPhase, SeesGapAndClosingSpeed) {
  const Approaching now({.length = 4.5, .width = 1.8});
  const AtlasEgo ego(now.path, now.scene);
  const PoseSamples samples = pose_samples_of(now.track, now.scene.actors[0].footprint, 0.0, {});
  const NarrowPhase both(ego, 0, now.track, samples);
  for (const double time : {0.0, 1.0, 2.0}) {
    const NarrowPhase::PairState sample = both.state_at(time);
    const double way = ego.at(time).X_WB.p.x;
    EXPECT_NEAR(sample.gap.size, 30.0 - 4.5 - way, 1e-9);
    EXPECT_EQ(sample.size, sample.gap.size);
    EXPECT_EQ(both.gap_at(time), sample.size);
    EXPECT_NEAR(sample.closing, ego.at(time).v_W.x, 1e-3);
  }
  EXPECT_FALSE(both.spreads());
}

// A disc of half a metre before the corner of the ego: the axes see no gap where there is one.
TEST(NarrowPhase, IsExactAboutWhatIsRound) {
  Approaching now({world::Shape::ellipse, 1.0, 1.0, 0.0});
  now.track = rollout::steady({{2.25 + 0.4, 0.9 + 0.4}, 0.0}, {}, 0.0, 5.0);
  const AtlasEgo ego(now.path, now.scene);
  const PoseSamples samples = pose_samples_of(now.track, now.scene.actors[0].footprint, 0.0, {});
  const NarrowPhase both(ego, 0, now.track, samples);
  EXPECT_NEAR(both.gap_at(0.0), std::hypot(0.4, 0.4) - 0.5, 1e-9);
}

TEST(NarrowPhase, ScoresInStandardDeviations) {
  const Approaching now({.length = 4.5, .width = 1.8}, 2.0);
  const AtlasEgo ego(now.path, now.scene);
  const PoseSamples samples = pose_samples_of(now.track, now.scene.actors[0].footprint, 0.0, {});
  const NarrowPhase both(ego, 0, now.track, samples);
  EXPECT_TRUE(both.spreads());
  EXPECT_NEAR(both.scores(both.state_at(0.0)).most, 25.5 / 2.0, 1e-9);
  EXPECT_GE(both.sd_until(1.0), 2.0);
}

// Along the ego's axis a body that points elsewhere has variance a^2 cos^2 + b^2 sin^2.
TEST(NarrowPhase, TurnsTheSpreadAlongAndAcrossWithTheBody) {
  Approaching now({.length = 4.0, .width = 2.0});
  const double turned = 0.3;
  now.track = rollout::steady({{30.0, 0.0}, turned}, {}, 0.0, 5.0);
  const AtlasEgo ego(now.path, now.scene);
  const PoseSamples samples = pose_samples_of(now.track, now.scene.actors[0].footprint, 0.0, {});
  const world::SpreadOverTime spread{.start = 0.0, .step = 2.0, .at = {{1.0, 0.1}, {3.0, 0.5}}};
  const NarrowPhase both(ego, 0, now.track, samples, &spread);
  EXPECT_TRUE(both.spreads());
  for (const double time : {0.0, 1.0, 2.0}) {
    const NarrowPhase::PairState sample = both.state_at(time);
    const double along = 1.0 + time;
    const double across = 0.1 + 0.2 * time;
    const double sd = std::hypot(along * std::cos(turned), across * std::sin(turned));
    const double half = 2.0 * std::cos(turned) + 1.0 * std::sin(turned);
    const double gap = 30.0 - half - 2.25 - ego.at(time).X_WB.p.x;
    EXPECT_NEAR(both.scores(sample).of_axis[0].size, gap / sd, 1e-6 * gap / sd);
    EXPECT_GE(both.sd_until(time), along);
    // Of all errors that are nearer by 1 m along x, the mean: the covariance's first column over
    // its first number.
    const double mixed = (along * along - across * across) * std::sin(turned) * std::cos(turned);
    const Vec2 off = both.doubt(sample).displacement_per_metre({1.0, 0.0});
    EXPECT_NEAR(off.x, -1.0, 1e-9);
    EXPECT_NEAR(off.y, -mixed / (sd * sd), 1e-9);
  }
}

TEST(NarrowPhase, NarrowsToTheLeastBetweenNeighbours) {
  const Window window{.from = 0.0, .to = 5.0};
  for (const double least : {0.85, 0.97, 1.03, 1.18}) {
    double best = 1e9;
    double found = 0.0;
    narrow(window, span_at(1.01), 8, [&](double time) {
      const double value = std::abs(time - least);
      if (value >= best) {
        return false;
      }
      best = value;
      found = time;
      return true;
    });
    EXPECT_NEAR(found, least, 0.03);
  }
}

}  // namespace
}  // namespace saca::forecast::narrow_phase_test
