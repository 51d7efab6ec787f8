#include "saca/lab/sim/line_of_sight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace saca::sim::line_of_sight_test {
namespace {

using world::Actor;
using world::ActorKind;

constexpr world::Footprint ego{world::Shape::box, 4.6, 1.8, -0.1};
constexpr double front = -0.1 + 2.3;  // of the ego, ahead of its centre of mass [m]

constexpr Vec2 van_centre{20.0, -3.0};
constexpr double van_length = 5.4;
constexpr double van_width = 2.0;
constexpr Vec2 walker_centre{24.0, -3.0};
constexpr double walker_size = 0.5;

Actor van() {
  return {.id = 1,
          .kind = ActorKind::van,
          .footprint = {world::Shape::box, van_length, van_width},
          .mass = 2'000.0,
          .X_WA = {van_centre, 0.0}};
}
Actor walker() {
  return {.id = 1,
          .kind = ActorKind::pedestrian,
          .footprint = {world::Shape::ellipse, walker_size, walker_size},
          .mass = 75.0,
          .X_WA = {walker_centre, 0.0}};
}

// Where the front of an ego that drives along the x axis first sees the walker past the van's
// front left corner: the line from the eye, at y = 0, to a point p crosses the height of the van's
// left side at that corner. The roof is behind the front, so it sees later.
double first_sight() {
  const Vec2 corner = van_centre + Vec2{0.5 * van_length, 0.5 * van_width};
  const double r = 0.5 * walker_size;
  const std::array<Vec2, 5> points{Vec2{0.0, 0.0}, {r, 0.0}, {-r, 0.0}, {0.0, r}, {0.0, -r}};
  double first = 1e9;
  for (const Vec2 away : points) {
    const Vec2 p = walker_centre + away;
    const double share = corner.y / p.y;  // of the way from the eye to p
    first = std::min(first, (corner.x - share * p.x) / (1.0 - share));
  }
  return first - front;
}

bool sees(const Pose& X_WB, std::vector<Actor> bodies, std::size_t whom) {
  return in_sight(X_WB, ego, bodies[whom], bodies);
}

TEST(LineOfSight, AVanHidesAWalkerUntilTheGeometryLetsHimBeSeen) {
  for (double x = -30.0; x < first_sight(); x += 0.5) {
    EXPECT_FALSE(sees({{x, 0.0}, 0.0}, {van(), walker()}, 1)) << x;
  }
  constexpr double close = 1e-4;  // [m]; the sight line is 1e-6 m wide
  EXPECT_FALSE(sees({{first_sight() - close, 0.0}, 0.0}, {van(), walker()}, 1));
  EXPECT_TRUE(sees({{first_sight() + close, 0.0}, 0.0}, {van(), walker()}, 1));
  EXPECT_TRUE(sees({{-30.0, 0.0}, 0.0}, {van(), walker()}, 0));
}

TEST(LineOfSight, IsTheSameInAMirrorAndInATurnedWorld) {
  constexpr double close = 1e-4;
  for (const double side : {-close, close}) {
    const double x = first_sight() + side;
    std::vector<Actor> mirrored{van(), walker()};
    for (Actor& actor : mirrored) {
      actor.X_WA.p.y = -actor.X_WA.p.y;
    }
    EXPECT_EQ(sees({{x, 0.0}, 0.0}, mirrored, 1), side > 0.0);
    for (const double angle : {0.5 * std::numbers::pi, -0.5 * std::numbers::pi, 2.0}) {
      const Pose X_WV{{1'000.0, -500.0}, angle};
      std::vector<Actor> turned{van(), walker()};
      for (Actor& actor : turned) {
        actor.X_WA = X_WV * actor.X_WA;
      }
      EXPECT_EQ(sees(X_WV * Pose{{x, 0.0}, 0.0}, turned, 1), side > 0.0) << angle;
    }
  }
}

TEST(LineOfSight, ARoundBodyHidesWhatLiesInItsShadow) {
  // A disc of radius 1, 10 m ahead of the front and 12.3 m ahead of the roof's middle: an eye at
  // distance r of it sees past at the angle asin(1 / r). The roof is first to see what is 20 m off.
  Actor disc{.id = 2,
             .kind = ActorKind::obstacle,
             .footprint = {world::Shape::ellipse, 2.0, 2.0},
             .mass = 1e3,
             .X_WA = {{front + 10.0, 0.0}, 0.0}};
  const double tangent =
      std::min(20.0 * std::tan(std::asin(1.0 / 10.0)), 22.3 * std::tan(std::asin(1.0 / 12.3)));
  Actor spot = walker();
  spot.footprint = {world::Shape::ellipse, 1e-3, 1e-3};
  spot.X_WA.p = {front + 20.0, tangent + 0.01};
  EXPECT_TRUE(sees({}, {disc, spot}, 1));
  spot.X_WA.p.y = tangent - 0.01;
  EXPECT_FALSE(sees({}, {disc, spot}, 1));
}

TEST(LineOfSight, AWallHidesWhatLiesBehindItAndIsSeenItself) {
  // From (front + 10, -3) to (front + 10, 3): the front sees past its end what lies 20 m ahead and
  // more than 6 m aside; for the roof, 2.3 m farther back, it is 3 * 22.3 / 12.3 = 5.44 m.
  const Actor wall{.id = 1,
                   .kind = ActorKind::obstacle,
                   .footprint = {.shape = world::Shape::segment, .length = 6.0},
                   .mass = 1e4,
                   .X_WA = {{front + 10.0, 0.0}, 0.5 * std::numbers::pi}};
  Actor spot = walker();
  spot.footprint = {world::Shape::ellipse, 1e-3, 1e-3};
  for (const double side : {-1.0, 1.0}) {
    spot.X_WA.p = {front + 20.0, side * (3.0 * 22.3 / 12.3 - 0.01)};
    EXPECT_FALSE(sees({}, {wall, spot}, 1));
    spot.X_WA.p.y = side * (3.0 * 22.3 / 12.3 + 0.01);
    EXPECT_TRUE(sees({}, {wall, spot}, 1));
  }
  EXPECT_TRUE(sees({}, {wall, spot}, 0));
  Actor hidden_wall = wall;
  hidden_wall.id = 2;
  hidden_wall.footprint.length = 5.0;
  hidden_wall.X_WA.p.x += 1.0;
  EXPECT_FALSE(sees({}, {wall, hidden_wall}, 1));
}

TEST(LineOfSight, TheRoofSeesWhatTheFrontDoesNot) {
  // A narrow post right before the front hides the road from it, but not from the roof's middle,
  // where it covers atan(0.05 / 2.5) to either side: 0.8 m of the 40 m ahead.
  const Actor post{.id = 1,
                   .kind = ActorKind::obstacle,
                   .footprint = {world::Shape::box, 0.2, 0.1},
                   .mass = 1e3,
                   .X_WA = {{front + 0.11, 0.0}, 0.0}};
  Actor aside = walker();
  aside.X_WA.p = {front + 40.0, 3.0};
  EXPECT_TRUE(sees({}, {post, aside}, 1));
  aside.X_WA.p = {front + 40.0, 0.2};
  EXPECT_FALSE(sees({}, {post, aside}, 1));
}

TEST(LineOfSight, OneWhoCoversTheEyesIsSeenAndHidesTheRest) {
  Actor on_top = van();
  on_top.X_WA = {};
  EXPECT_TRUE(sees({}, {on_top, walker()}, 0));
  EXPECT_FALSE(sees({}, {on_top, walker()}, 1));
  Actor point = walker();
  point.X_WA.p = {front, 0.0};
  EXPECT_TRUE(sees({}, {point}, 0));
}

}  // namespace
}  // namespace saca::sim::line_of_sight_test
