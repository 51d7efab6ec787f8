#include "saca/onboard/match/similarity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <vector>

#include "saca/onboard/match/example_scenes.h"
#include "tests/support/count_allocations.h"

namespace saca::match::similarity_test {
namespace {

using world::Scene;

// Frames are turned and shifted by up to 500 m: 500 * 2^-53 m is 6e-14 m; a difference of 1e-12
// scales is 1e-13 of similarity.
constexpr double rounding = 1e-11;

static_assert(noexcept(similarity(Scene{}, Scene{})));

Scene mirrored(const Scene& scene) {
  const auto flip = [](Pose X) { return Pose{{X.p.x, -X.p.y}, -X.yaw}; };
  const auto flip_vector = [](Vec2 v) { return Vec2{v.x, -v.y}; };
  Scene result = scene;
  result.ego.X_WB = flip(scene.ego.X_WB);
  result.ego.v_B = flip_vector(scene.ego.v_B);
  result.ego.yaw_rate = -scene.ego.yaw_rate;
  result.road.X_WL = flip(scene.road.X_WL);
  result.road.curvature = -scene.road.curvature;
  result.road.left_edge = -scene.road.right_edge;
  result.road.right_edge = -scene.road.left_edge;
  std::swap(result.road.left_beyond, result.road.right_beyond);
  std::swap(result.road.oncoming_left, result.road.oncoming_right);
  for (world::Actor& actor : result.actors) {
    actor.X_WA = flip(actor.X_WA);
    actor.v_W = flip_vector(actor.v_W);
  }
  return result;
}

// ---- By hand

TEST(Similarity, FallsByATenthForSevenTenthsOfAMetrePerSecondOfEgoSpeed) {
  Scene faster = empty_road();
  faster.ego.v_B.x += 1.4;
  EXPECT_NEAR(similarity(empty_road(), faster), 0.9 * 0.9, 1e-12);
}

TEST(Similarity, FallsByATenthForFifteenPercentOfStoppingDistance) {
  Scene wetter = empty_road();
  wetter.grip *= std::exp(-0.15);
  EXPECT_NEAR(similarity(empty_road(), wetter), 0.9, 1e-12);
}

/// 0.9 to the power of the root of these squares.
double alike(std::initializer_list<double> differences) {
  double sum = 0.0;
  for (const double one : differences) {
    sum += one * one;
  }
  return std::pow(0.9, std::sqrt(sum));
}

TEST(Similarity, FallsWithWhereAnActorIsAndWillBe) {
  Scene scene = empty_road();
  scene.actors.push_back(pedestrian(1, {15.0, 0.0}));
  Scene other = scene;
  other.actors[0].X_WA.p = {15.6, 0.8};  // now, in 1 s across, in 2 s along
  EXPECT_NEAR(similarity(scene, other), alike({0.6 / 6.0, 0.8 / 4.0, 0.8 / 0.7, 0.6 / 8.0}), 1e-12);
  other = scene;
  other.actors[0].v_W = {0.5, -0.7};
  EXPECT_NEAR(similarity(scene, other), alike({0.5 / 3.5, 0.7 / 4.5, 0.7 / 0.7, 1.0 / 8.0}), 1e-12);
  other.actors[0].X_WA.p = {14.0, 0.7};  // who moves there will be there: nothing is left then
  EXPECT_NEAR(similarity(scene, other),
              alike({1.0 / 6.0, 0.7 / 4.0, 0.0, 0.0, 0.5 / 3.5, 0.7 / 4.5}), 1e-12);
  other = scene;
  other.actors[0].a_W = {-6.0, 1.0};  // its braking is not looked at
  EXPECT_NEAR(similarity(scene, other), alike({1.0 / 1.25}), 1e-12);
}

TEST(Similarity, FallsForSomebodyALanesWidthOutOfReach) {
  Scene standing = empty_road();
  standing.ego.v_B = {0.0, 0.0};  // reaches nothing but where it is
  Scene with = standing;
  with.actors.push_back(pedestrian(1, {0.0, 3.5 + 0.5 * 1.9 + 0.3}));
  EXPECT_NEAR(similarity(standing, with), alike({0.75}), 1e-12);
}

TEST(Similarity, FallsMoreForSomebodyUnexpectedInTheWay) {
  Scene with = empty_road();
  with.actors.push_back(pedestrian(1, {15.0, 0.0}));
  EXPECT_NEAR(similarity(empty_road(), with), alike({3.0}), 1e-12);
  with.actors[0].existence = 0.5;  // perhaps not there at all
  EXPECT_NEAR(similarity(empty_road(), with), alike({1.5}), 1e-12);
  with.actors[0].existence = 1.0;
  with.actors.push_back(pedestrian(2, {18.0, 0.0}));
  EXPECT_NEAR(similarity(empty_road(), with), alike({3.0, 3.0}), 1e-12);
}

// ---- What a user of the gates expects

TEST(Similarity, OfASceneAndItsForecastIsAboveTheLowerGate) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> any(-std::numbers::pi, std::numbers::pi);
  for (int i = 0; i < 300; ++i) {
    const Scene scene = i == 0 ? crossing_truck() : random_scene(rng, i % 9);
    Scene forecast = scene;
    forecast.ego.v_B.x += std::copysign(0.3, any(rng));
    for (world::Actor& actor : forecast.actors) {
      actor.X_WA.p = actor.X_WA.p + rotated({0.3, 0.0}, any(rng));
      actor.v_W = actor.v_W + rotated({0.3, 0.0}, any(rng));
    }
    EXPECT_GT(similarity(scene, forecast), 0.7) << "scene " << i;
  }
}

TEST(Similarity, OfASecondPedestrianInTheEscapePathIsBelowTheGate) {
  Scene scene = crossing_truck();
  scene.actors.push_back(pedestrian(2, {14.0, 3.5}));
  EXPECT_LT(similarity(crossing_truck(), scene), 0.8);
}

TEST(Similarity, OfTheSameLayoutAtEightAndFourteenIsBelowBothGates) {
  for (const Scene& scene : {empty_road(), crossing_truck()}) {
    Scene slower = scene;
    slower.ego.v_B.x = 8.0;
    EXPECT_LT(similarity(scene, slower), 0.7);
  }
}

TEST(Similarity, OfMirroredScenesIsLowUnlessTheyAreSymmetric) {
  EXPECT_LT(similarity(crossing_truck(), mirrored(crossing_truck())), 0.7);
  Scene symmetric = empty_road();
  symmetric.road.right_edge = -symmetric.road.left_edge;
  symmetric.road.oncoming_right = symmetric.road.oncoming_left;
  symmetric.actors.push_back(pedestrian(1, {15.0, 2.0}));
  symmetric.actors.push_back(pedestrian(2, {15.0, -2.0}));
  EXPECT_DOUBLE_EQ(similarity(symmetric, mirrored(symmetric)), 1.0);
}

TEST(Similarity, DoesNotCareForThoseWhoCannotMatter) {
  Scene with = empty_road();
  with.actors.push_back(car(1, {{80.0, 0.0}, 0.0}, 30.0));  // draws away
  EXPECT_GT(similarity(empty_road(), with), 0.999);
}

// ---- Properties

TEST(Similarity, IsOneOnlyForTheSame) {
  std::mt19937 rng(2);
  for (int i = 0; i < 200; ++i) {
    const Scene a = random_scene(rng, i % 9);
    const Scene b = random_scene(rng, i % 9);
    EXPECT_EQ(similarity(a, a), 1.0);
    EXPECT_GE(similarity(a, b), 0.0);
    EXPECT_LT(similarity(a, b), 1.0);
    EXPECT_EQ(similarity(a, b), similarity(b, a));
  }
}

// However a scene is changed by a little, what is like it stays about as like; also where a road
// user begins to be matched with another one, or to matter at all.
TEST(Difference, HasNoJumps) {
  std::mt19937 rng(17);
  std::normal_distribution<double> normal;
  constexpr double step = 1e-6;  // [m], [m/s], [rad], [m/s^2]
  double most = 0.0;
  for (int i = 0; i < 400; ++i) {
    const Scene a = random_scene(rng, i % 7);
    const Scene b = random_scene(rng, (i + i / 7) % 7);
    Scene moved = b;
    moved.ego.X_WB.p.x += step * normal(rng);
    moved.ego.X_WB.p.y += step * normal(rng);
    moved.ego.v_B.x += step * normal(rng);
    moved.grip += step;
    for (world::Actor& actor : moved.actors) {
      actor.X_WA.p.x += step * normal(rng);
      actor.X_WA.p.y += step * normal(rng);
      actor.X_WA.yaw += step * normal(rng);
      actor.v_W.x += step * normal(rng);
      actor.v_W.y += step * normal(rng);
      actor.a_W.x += step * normal(rng);
    }
    const auto from_a = [&](const Scene& other) {
      const Features of_a = features(a);
      const Features of_other = features(other);
      const auto actors = [](const Features& one) {
        return std::span(one.actors.begin(), one.actors.size());
      };
      return difference(of_a.ego, actors(of_a), of_other.ego, actors(of_other));
    };
    most = std::max(most, std::abs(from_a(moved) - from_a(b)));
  }
  EXPECT_LT(most, 1e-3) << "a thousand times the step";
}

TEST(Similarity, IsTheSameFromEveryWorldFrame) {
  std::mt19937 rng(3);
  for (int i = 0; i < 200; ++i) {
    const Scene a = random_scene(rng, i % 9);
    Scene b = a;
    b.ego.v_B.x += 0.5;
    for (world::Actor& actor : b.actors) {
      actor.X_WA.p = actor.X_WA.p + Vec2{0.4, 0.1};
    }
    const double expected = similarity(a, b);
    const Scene turned = moved(b, {{-120.0, 340.0}, 2.5});
    EXPECT_NEAR(similarity(a, turned), expected, rounding);
    EXPECT_NEAR(similarity(turned, b), 1.0, rounding);
  }
}

TEST(Similarity, DoesNotDependOnWhichPointDescribesTheLane) {
  std::mt19937 rng(4);
  for (int i = 0; i < 200; ++i) {
    const Scene scene = random_scene(rng, i % 9);
    Scene other = scene;
    other.road.X_WL = world::from_lane(scene.road, {17.0, 0.0, 0.0});
    EXPECT_NEAR(similarity(scene, other), 1.0, rounding);
  }
}

TEST(Similarity, DoesNotDependOnTheOrderOrNamesOfActors) {
  std::mt19937 rng(5);
  for (int i = 0; i < 100; ++i) {
    const Scene scene = random_scene(rng, 8);
    Scene other = scene;
    std::shuffle(other.actors.begin(), other.actors.end(), rng);
    std::uint8_t id = 100;
    for (world::Actor& actor : other.actors) {
      actor.id = id++;
    }
    EXPECT_EQ(similarity(scene, other), 1.0);
  }
}

TEST(Similarity, FallsWithEveryDifferenceThatMatters) {
  Scene scene = crossing_truck();
  scene.road.right_edge = -4.0;
  const std::vector<std::function<void(Scene&, double)>> changes{
      [](Scene& s, double x) { s.ego.v_B.x += x; },
      [](Scene& s, double x) { s.ego.v_B.y += x; },
      [](Scene& s, double x) { s.ego.X_WB.p.y += 0.5 * x; },
      [](Scene& s, double x) { s.ego.X_WB.yaw += 0.1 * x; },
      [](Scene& s, double x) { s.ego.yaw_rate += 0.2 * x; },
      [](Scene& s, double x) { s.ego_footprint.length += x; },
      [](Scene& s, double x) { s.grip -= 0.05 * x; },
      [](Scene& s, double x) { s.road.left_edge -= 0.5 * x; },
      [](Scene& s, double x) { s.road.right_edge += 0.5 * x; },
      [](Scene& s, double x) { s.road.lane_width -= 0.2 * x; },
      [](Scene& s, double x) { s.road.curvature += 0.005 * x; },
      [](Scene& s, double x) { s.actors[0].X_WA.p.x += x; },
      [](Scene& s, double x) { s.actors[0].X_WA.p.y -= x; },
      [](Scene& s, double x) { s.actors[0].X_WA.yaw += 0.2 * x; },
      [](Scene& s, double x) { s.actors[0].footprint.length += x; },
      [](Scene& s, double x) { s.actors[0].v_W.y += x; },
      [](Scene& s, double x) { s.actors[1].v_W.x += x; },
  };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    double previous = 1.0;
    for (const double size : {0.5, 1.0, 1.5, 2.0}) {
      Scene other = scene;
      changes[i](other, size);
      const double alike = similarity(scene, other);
      EXPECT_LT(alike, previous) << "change " << i << " of size " << size;
      previous = alike;
    }
  }
}

TEST(Similarity, FallsWhenKindsOfThingsDiffer) {
  const std::vector<std::function<void(Scene&)>> changes{
      [](Scene& s) { s.road.topology = world::Topology::one_way; },
      [](Scene& s) { s.road.left_beyond = world::Beyond::barrier; },
      [](Scene& s) { s.road.right_beyond = world::Beyond::trees; },
      [](Scene& s) { s.road.oncoming_left = false; },
      [](Scene& s) { s.road.oncoming_right = true; },
      [](Scene& s) { s.actors[0].kind = world::ActorKind::pedestrian; },
  };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Scene other = crossing_truck();
    changes[i](other);
    EXPECT_LT(similarity(crossing_truck(), other), 0.91) << "change " << i;
  }
}

TEST(Similarity, FallsTheMoreTheNearerTheUnexpectedComes) {
  double previous = 1.0;
  for (const double y : {12.0, 10.0, 8.0, 6.0}) {  // the ego reaches 3.5 + 0.95 to the left
    Scene with = empty_road();
    with.actors.push_back(pedestrian(1, {15.0, y}));
    const double alike = similarity(empty_road(), with);
    EXPECT_LT(alike, previous) << y;
    previous = alike;
  }
}

// Oracle: all ways to pair some of one side with some of the other.
double least_sum(const std::vector<std::vector<double>>& pair2, const std::vector<double>& alone2_a,
                 const std::vector<double>& alone2_b, std::size_t i, std::vector<bool> used) {
  if (i == alone2_a.size()) {
    double sum = 0.0;
    for (std::size_t j = 0; j < alone2_b.size(); ++j) {
      sum += used[j] ? 0.0 : alone2_b[j];
    }
    return sum;
  }
  double best = alone2_a[i] + least_sum(pair2, alone2_a, alone2_b, i + 1, used);
  for (std::size_t j = 0; j < alone2_b.size(); ++j) {
    if (!used[j]) {
      std::vector<bool> next = used;
      next[j] = true;
      best = std::min(best, pair2[i][j] + least_sum(pair2, alone2_a, alone2_b, i + 1, next));
    }
  }
  return best;
}

TEST(Difference, TakesTheBestOfAllAssignments) {
  std::mt19937 rng(6);
  std::uniform_real_distribution<double> threat(0.0, 4.0);
  const EgoFeatures ego{.usable = true};
  int num_searched = 0;
  for (int i = 0; i < 400; ++i) {
    Features a = features(random_scene(rng, 1 + i % 5));
    Features b = features(random_scene(rng, 1 + i / 5 % 5));
    // Near each other, so that there is something to choose between.
    std::vector<double> alone_a;
    std::vector<double> alone_b;
    for (auto [side, alone] : {std::pair{&a, &alone_a}, std::pair{&b, &alone_b}}) {
      for (ActorFeatures& actor : side->actors) {
        actor.kind = world::ActorKind::car;
        actor.p_rel_L = 0.05 * actor.p_rel_L;
        actor.v_rel_L = 0.05 * actor.v_rel_L;
        actor.threat = threat(rng);
        alone->push_back(0.75 * actor.threat * 0.75 * actor.threat);
      }
    }
    std::vector<std::vector<double>> pair(alone_a.size(), std::vector<double>(alone_b.size()));
    for (std::size_t j = 0; j < alone_a.size(); ++j) {
      for (std::size_t k = 0; k < alone_b.size(); ++k) {
        ActorFeatures one = a.actors[j];
        ActorFeatures other = b.actors[k];
        one.threat = other.threat = 1e6;  // must be paired
        const double apart = difference(ego, {&one, 1}, ego, {&other, 1});
        pair[j][k] = apart * apart;
      }
    }
    const double expected =
        std::sqrt(least_sum(pair, alone_a, alone_b, 0, std::vector<bool>(alone_b.size(), false)));
    EXPECT_NEAR(difference(ego, {a.actors.begin(), a.actors.size()}, ego,
                           {b.actors.begin(), b.actors.size()}),
                expected, 1e-9);
    num_searched += expected > 0.0 ? 1 : 0;
  }
  EXPECT_GT(num_searched, 300);
}

TEST(Difference, IsMadeOfItsParts) {
  std::mt19937 rng(8);
  for (int i = 0; i < 100; ++i) {
    const Scene a = random_scene(rng, i % 5);
    const Scene b = random_scene(rng, i / 5 % 6);
    double sum = 0.0;
    double before = std::numeric_limits<double>::infinity();
    for (const DifferencePart& part : difference_parts(a, b)) {
      EXPECT_LE(part.size, before);
      before = part.size;
      sum += part.size * part.size;
    }
    EXPECT_NEAR(std::pow(0.9, std::sqrt(sum)), similarity(a, b), 1e-12);
  }
}

TEST(Difference, NamesItsParts) {
  Scene scene = empty_road();
  scene.actors.push_back(pedestrian(1, {15.0, 0.0}));
  Scene other = scene;
  other.grip *= std::exp(-0.15);
  other.actors[0].id = 7;
  other.actors[0].X_WA.p.y = 0.7;
  other.actors.push_back(pedestrian(2, {15.0, -3.0}));
  const auto parts = difference_parts(scene, other);
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_EQ(parts[0].what, "nobody for pedestrian2");
  EXPECT_NEAR(parts[0].size, 3.0, 1e-12);
  EXPECT_EQ(parts[1].what, "pedestrian1 for pedestrian7");
  EXPECT_NEAR(parts[1].size, std::hypot(1.0, 0.7 / 4.0), 1e-12);
  EXPECT_EQ(parts[2].what, "grip");
  EXPECT_NEAR(parts[2].size, 1.0, 1e-12);
  EXPECT_EQ(difference_parts(other, scene)[0].what, "pedestrian2 for nobody");
  EXPECT_TRUE(difference_parts(scene, scene).empty());
}

TEST(Difference, StopsAtTheLimit) {
  const Features a = features(empty_road());
  Scene faster = empty_road();
  faster.ego.v_B.x += 3.5;
  const Features b = features(faster);
  EXPECT_GE(difference(a.ego, {}, b.ego, {}, 2.0), 2.0);
  EXPECT_DOUBLE_EQ(difference(a.ego, {}, b.ego, {}, 6.0), 5.0);
}

// ---- Refusal, real time

TEST(Similarity, IsZeroForASceneThatIsNone) {
  Scene broken = crossing_truck();
  broken.actors[1].v_W.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(similarity(broken, crossing_truck()), 0.0);
  EXPECT_EQ(similarity(crossing_truck(), broken), 0.0);
  broken = crossing_truck();
  broken.grip = 0.0;
  EXPECT_EQ(similarity(broken, broken), 0.0);
}

TEST(Similarity, AllocatesNothing) {
  std::mt19937 rng(7);
  const Scene a = random_scene(rng, 32);
  const Scene b = random_scene(rng, 32);
  const std::size_t before = num_allocations;
  const double alike = similarity(a, b) + similarity(a, a);
  EXPECT_EQ(num_allocations, before);
  EXPECT_GE(alike, 1.0);
}

}  // namespace
}  // namespace saca::match::similarity_test
