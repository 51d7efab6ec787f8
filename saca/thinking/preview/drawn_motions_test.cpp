#include "saca/thinking/preview/drawn_motions.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "saca/base/core/contract.h"
#include "saca/thinking/intent/likely_motions.h"
#include "tests/support/scenes.h"

namespace saca::preview::drawn_motions_test {
namespace {

using intent::Intention;
using world::Scene;

constexpr std::size_t count = 64;

intent::Belief belief_in(Intention intention, double probability = 1.0) {
  intent::Belief belief;
  for (intent::IntentPosterior& posterior : belief.at) {
    posterior.fill(0.0);
    posterior[static_cast<std::size_t>(Intention::maintain)] = 1.0 - probability;
    posterior[static_cast<std::size_t>(intention)] += probability;
  }
  return belief;
}

/// The ego, and a car 40 m ahead in its lane at 10 m/s.
Scene with_a_car(double sideways = 0.0) {
  Scene scene = test::ego_at(20.0);
  scene.road.left_edge = 8.75;
  scene.road.right_edge = -8.75;
  scene.actors.push_back(test::car(1, {40.0, 0.0}, {10.0, sideways}));
  return scene;
}

/// Where the first actor is then, in each draw.
std::vector<Vec2> places(const std::vector<JointMotion>& motions, double time) {
  std::vector<Vec2> all;
  all.reserve(motions.size());
  for (const JointMotion& motion : motions) {
    all.push_back(world::pose_at(motion.tracks.at(0), time).p);
  }
  return all;
}

intent::Beliefs believing(const intent::Belief& belief) {
  intent::Beliefs beliefs;
  beliefs.push_back(belief);
  return beliefs;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) {
    sum += value;
  }
  return sum / static_cast<double>(values.size());
}
double sd_of(const std::vector<double>& values) {
  const double mean = mean_of(values);
  double sum = 0.0;
  for (const double value : values) {
    sum += (value - mean) * (value - mean);
  }
  return std::sqrt(sum / static_cast<double>(values.size()));
}
std::vector<double> along(const std::vector<Vec2>& places) {
  std::vector<double> all;
  all.reserve(places.size());
  for (const Vec2 p : places) {
    all.push_back(p.x);
  }
  return all;
}
std::vector<double> across(const std::vector<Vec2>& places) {
  std::vector<double> all;
  all.reserve(places.size());
  for (const Vec2 p : places) {
    all.push_back(p.y);
  }
  return all;
}

TEST(DrawnMotions, OfNobodyAreAlikeAndWeighOneTogether) {
  const auto motions = drawn_motions(test::ego_at(20.0), {}, intent::MotionLaw{}, 3);
  ASSERT_EQ(motions.size(), 3);
  for (const JointMotion& motion : motions) {
    EXPECT_TRUE(motion.tracks.empty());
    EXPECT_DOUBLE_EQ(motion.probability, 1.0 / 3.0);
  }
}

TEST(DrawnMotions, OfWhoIsSeenExactlyBeginWhereItIs) {
  const auto motions =
      drawn_motions(with_a_car(), believing(belief_in(Intention::brake, 0.5)), {}, count);
  for (const Vec2 p : places(motions, 0.0)) {
    EXPECT_EQ(norm(p - Vec2{40.0, 0.0}), 0.0);
  }
}

// A straight road along x: along is x, across is y, and one is not taken for the other.
TEST(DrawnMotions, HaveTheSpreadThatTheLawTellsAlongAndAcross) {
  Scene scene = with_a_car();
  scene.actors[0].position_sd = 0.3;
  scene.actors[0].velocity_sd = 0.2;
  const auto motions = drawn_motions(scene, believing(belief_in(Intention::maintain)), {}, count);
  const intent::Forecast law =
      intent::motion_under(scene, scene.actors[0], Intention::maintain, 5.0, {});
  for (const double time : {0.0, 1.0, 4.0}) {
    const world::Spread told = spread_at(law.spread, time);
    const auto seen = places(motions, time);
    // The middles of 64 equal parts of a normal law have 0.98 of its spread.
    EXPECT_NEAR(sd_of(along(seen)), told.along_sd, 0.03 * told.along_sd) << time;
    EXPECT_NEAR(sd_of(across(seen)), told.across_sd, 0.03 * told.across_sd) << time;
    EXPECT_NEAR(mean_of(along(seen)), 40.0 + 10.0 * time, 1e-6) << time;
    EXPECT_NEAR(mean_of(across(seen)), 0.0, 1e-6) << time;
  }
  const world::Spread late = spread_at(law.spread, 4.0);
  ASSERT_GT(late.along_sd, 3.0 * late.across_sd)
      << "else the two could be confused and nobody would see";
}

// Errors along and across fill the plane: of 64 draws, two to six are in each of 16 fields that are
// alike likely; of independent ones, one field or another would be empty or have eight.
TEST(DrawnMotions, LeaveNoGaps) {
  Scene scene = with_a_car();
  scene.actors[0].position_sd = 1.0;
  for (std::uint8_t id = 1; id <= 20; ++id) {
    scene.actors[0].id = id;
    std::array<int, 16> in_field{};
    for (const Vec2 p :
         places(drawn_motions(scene, believing(belief_in(Intention::maintain)), {}, count), 0.0)) {
      const auto quarter = [](double z) -> std::size_t {
        return z < -0.6745 ? 0 : z < 0.0 ? 1 : z < 0.6745 ? 2 : 3;
      };
      ++in_field[4 * quarter(p.x - 40.0) + quarter(p.y)];
    }
    const auto [fewest, most] = std::minmax_element(in_field.begin(), in_field.end());
    EXPECT_GE(*fewest, 2) << static_cast<int>(id);
    EXPECT_LE(*most, 6) << static_cast<int>(id);
  }
}

TEST(DrawnMotions, HoldEachIntentionAsOftenAsItIsBelieved) {
  const auto motions =
      drawn_motions(with_a_car(), believing(belief_in(Intention::lane_left, 0.25)), {}, count);
  const auto far = across(places(motions, 9.0));
  // Seen exactly, who stays in its lane stays on its line: three of four.
  EXPECT_EQ(std::count_if(far.begin(), far.end(), [](double y) { return std::abs(y) < 1e-9; }), 48);
}

// Moves to the side are drawn as often as they are likely, and end where they are said to.
TEST(DrawnMotions, OfWhoDriftsEndWhereItsMovesMay) {
  const Scene scene = with_a_car(2.0);
  const auto belief = belief_in(Intention::maintain);
  const auto likely = intent::likely_motions(scene, scene.actors[0], belief);
  double mean = 0.0;
  double square = 0.0;
  for (const intent::LikelyMotion& one : likely) {
    const double way = one.aside ? one.aside->way(9.0) : 0.0;
    const double sd = one.aside ? one.aside->left_sd : 0.0;
    mean += one.probability * way;
    square += one.probability * (way * way + sd * sd);
  }
  const auto far = across(places(drawn_motions(scene, believing(belief), {}, count), 9.0));
  EXPECT_NEAR(mean_of(far), mean, 0.1);
  EXPECT_NEAR(sd_of(far), std::sqrt(square - mean * mean), 0.15);
}

TEST(DrawnMotions, OfWhoDriftsAreMirroredInTheMirror) {
  const auto left =
      drawn_motions(with_a_car(0.8), believing(belief_in(Intention::maintain)), {}, count);
  const auto right =
      drawn_motions(with_a_car(-0.8), believing(belief_in(Intention::maintain)), {}, count);
  auto y_left = across(places(left, 5.0));
  auto y_right = across(places(right, 5.0));
  EXPECT_NEAR(mean_of(y_left), -mean_of(y_right), 0.06);
  EXPECT_NEAR(sd_of(y_left), sd_of(y_right), 0.12);
}

TEST(DrawnMotions, DependOnNamesNotOnOrder) {
  Scene scene = with_a_car();
  scene.actors[0].position_sd = 0.3;
  scene.actors.push_back(test::car(2, {60.0, 3.5}, {15.0, 0.0}));
  scene.actors[1].position_sd = 0.3;
  intent::Beliefs beliefs = believing(belief_in(Intention::brake, 0.5));
  beliefs.push_back(belief_in(Intention::lane_right, 0.5));
  const auto motions = drawn_motions(scene, beliefs, {}, 8);
  std::swap(scene.actors[0], scene.actors[1]);
  std::swap(beliefs[0], beliefs[1]);
  const auto swapped = drawn_motions(scene, beliefs, {}, 8);
  for (std::size_t k = 0; k < motions.size(); ++k) {
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(norm(world::pose_at(motions[k].tracks[i], 2.0).p -
                     world::pose_at(swapped[k].tracks[1 - i], 2.0).p),
                0.0);
    }
  }
}

TEST(DrawnMotions, WhoStandsAndObstaclesHaveDrawsToo) {
  Scene scene = test::ego_at(20.0);
  scene.actors.push_back(test::car(1, {40.0, 0.0}));
  scene.actors.push_back(test::car(2, {60.0, 0.0}));
  scene.actors[1].kind = world::ActorKind::obstacle;
  scene.actors.push_back(test::car(3, {50.0, 5.0}));
  scene.actors[2].kind = world::ActorKind::pedestrian;
  intent::Beliefs beliefs;
  for (int i = 0; i < 3; ++i) {
    beliefs.push_back(belief_in(Intention::maintain));
  }
  for (const JointMotion& motion : drawn_motions(scene, beliefs, {}, 5)) {
    ASSERT_EQ(motion.tracks.size(), 3);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(norm(motion.tracks[i].X_WA.back().p - scene.actors[i].X_WA.p), 0.0);
    }
  }
}

TEST(DrawnMotions, RefuseBeliefsOfOthersAndNoDraw) {
  EXPECT_THROW((void)drawn_motions(with_a_car(), {}, {}, 4), ContractViolation);
  EXPECT_THROW((void)drawn_motions(with_a_car(), believing(belief_in(Intention::maintain)), {}, 0),
               ContractViolation);
}

// Turned by a right angle, along is y: about each track by the situation's spread, from the trigger
// on.
TEST(DrawnMotions, OfASituationAreAboutItsTracks) {
  Situation situation;
  situation.scene_at_trigger = with_a_car();
  Scene& scene = situation.scene_at_trigger;
  scene.time = 2.0;
  scene.actors[0].v_W = {0.0, 10.0};
  world::Track track{.start = 0.0, .step = 0.05, .X_WA = {}};
  for (int k = 0; k <= 200; ++k) {
    track.X_WA.push_back({{40.0, -20.0 + 0.5 * k}, 0.5 * std::numbers::pi});
  }
  scene.actors[0].X_WA = pose_at(track, 2.0);
  situation.tracks = {track};
  situation.spreads = {{.start = 2.0, .step = 2.0, .at = {{1.0, 0.1}, {3.0, 0.2}}}};
  const auto motions = drawn_motions(situation, count);
  ASSERT_EQ(motions.size(), count);
  EXPECT_EQ(motions[0].tracks[0].start, 2.0);
  for (const double time : {2.0, 4.0}) {
    const auto seen = places(motions, time);
    const world::Spread told = spread_at(situation.spreads[0], time);
    EXPECT_NEAR(sd_of(across(seen)), told.along_sd, 0.03 * told.along_sd) << time;
    EXPECT_NEAR(sd_of(along(seen)), told.across_sd, 0.03 * told.across_sd) << time;
    EXPECT_NEAR(mean_of(across(seen)), -20.0 + 10.0 * time, 1e-6) << time;
    EXPECT_NEAR(mean_of(along(seen)), 40.0, 1e-6) << time;
  }
  situation.spreads.clear();
  EXPECT_THROW((void)drawn_motions(situation, count), ContractViolation);
}

}  // namespace
}  // namespace saca::preview::drawn_motions_test
