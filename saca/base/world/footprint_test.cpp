#include "saca/base/world/footprint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "saca/base/core/contract.h"

namespace saca::world::footprint_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr Footprint car{.length = 4.7, .width = 1.9, .centre_x = -0.1};
constexpr Footprint person{.shape = Shape::ellipse, .length = 0.3, .width = 0.5};

Footprint box(double length, double width) {
  return {.length = length, .width = width};
}
Footprint segment(double length) {
  return {.shape = Shape::segment, .length = length};
}
Footprint ellipse(double length, double width) {
  return {.shape = Shape::ellipse, .length = length, .width = width};
}

// Boundary points by their definition, with the corners of a box among them.
std::vector<Vec2> boundary(const Footprint& footprint, const Pose& X_WB, int num_points) {
  std::vector<Vec2> points;
  const double a = 0.5 * footprint.length;
  const double b = footprint.shape == Shape::segment ? 0.0 : 0.5 * footprint.width;
  for (int i = 0; i < num_points; ++i) {
    const double share = static_cast<double>(i) / num_points;
    Vec2 p{a * std::cos(2.0 * pi * share), b * std::sin(2.0 * pi * share)};
    if (footprint.shape != Shape::ellipse) {
      // Clockwise from the rear left corner, each side beginning with a corner.
      const auto side = static_cast<int>(4.0 * share);
      const double along = 2.0 * (4.0 * share - side) - 1.0;
      p = side == 0   ? Vec2{a * along, b}
          : side == 1 ? Vec2{a, -b * along}
          : side == 2 ? Vec2{-a * along, -b}
                      : Vec2{-a, b * along};
    }
    points.push_back(X_WB * (p + Vec2{footprint.centre_x, 0.0}));
  }
  return points;
}

bool holds(const Footprint& footprint, const Pose& X_WB, Vec2 p_W, double margin) {
  const Vec2 p = inverse(X_WB) * p_W - Vec2{footprint.centre_x, 0.0};
  const double a = 0.5 * footprint.length;
  const double b = footprint.shape == Shape::segment ? 0.0 : 0.5 * footprint.width;
  if (footprint.shape != Shape::ellipse) {
    return std::abs(p.x) <= a + margin && std::abs(p.y) <= b + margin;
  }
  return std::hypot(p.x / a, p.y / b) <= 1.0 + margin / std::min(a, b);
}

class Draw {
 public:
  explicit Draw(unsigned seed) : rng_(seed) {}
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(rng_);
  }
  Footprint footprint() {
    const double kind = (*this)(0.0, 1.0);
    const double length = std::exp((*this)(-1.5, 2.5));
    const double width = std::exp((*this)(-1.5, 1.5));
    const double centre_x = (*this)(-1.0, 1.0);
    if (kind < 0.2) {
      return {.shape = Shape::segment, .length = length, .centre_x = centre_x};
    }
    return {.shape = kind < 0.6 ? Shape::box : Shape::ellipse,
            .length = length,
            .width = width,
            .centre_x = centre_x};
  }
  Pose pose(double reach) {
    return {{(*this)(-reach, reach), (*this)(-reach, reach)}, (*this)(-pi, pi)};
  }

 private:
  std::mt19937 rng_;
};

TEST(Support, OfABoxIsItsCorner) {
  const Vec2 p = support(car, {{10.0, 5.0}, pi / 2.0}, {1.0, 3.0});
  EXPECT_NEAR(p.x, 10.95, 1e-12);  // facing north: half the width to the east
  EXPECT_NEAR(p.y, 7.25, 1e-12);   // 2.35 - 0.1 ahead
}

// x^2/4 + y^2 = 1 has the normal (1, 1) where (x/4, y) ~ (1, 1): x = 4/sqrt 5, y = 1/sqrt 5.
TEST(Support, OfAnEllipseIsWhereItsNormalPoints) {
  const Vec2 p = support(ellipse(4.0, 2.0), {}, {3.0, 3.0});
  EXPECT_NEAR(p.x, 4.0 / std::sqrt(5.0), 1e-12);
  EXPECT_NEAR(p.y, 1.0 / std::sqrt(5.0), 1e-12);
}

// Oracle: the farthest of many boundary points, exact to second order in their distance.
TEST(Support, IsTheFarthestBoundaryPoint) {
  Draw draw(1);
  for (int i = 0; i < 50; ++i) {
    const Footprint footprint = draw.footprint();
    const Pose X_WB = draw.pose(10.0);
    const Vec2 n = rotated({1.0, 0.0}, draw(-pi, pi));
    double farthest = -std::numeric_limits<double>::infinity();
    for (const Vec2 p : boundary(footprint, X_WB, 4000)) {
      farthest = std::max(farthest, dot(p, n));
    }
    EXPECT_NEAR(dot(support(footprint, X_WB, n), n), farthest, 1e-4);
    EXPECT_GE(dot(support(footprint, X_WB, n), n), farthest - 1e-12);
  }
}

TEST(BoundingRadius, ReachesTheFarthestPointAndNoFarther) {
  EXPECT_DOUBLE_EQ(bounding_radius(box(6.0, 8.0)), 5.0);
  EXPECT_DOUBLE_EQ(bounding_radius({Shape::ellipse, 4.0, 2.0, -1.0}), 3.0);
  Draw draw(2);
  for (int i = 0; i < 50; ++i) {
    const Footprint footprint = draw.footprint();
    double farthest = 0.0;
    for (const Vec2 p : boundary(footprint, {}, 4000)) {
      farthest = std::max(farthest, norm(p));
    }
    EXPECT_NEAR(bounding_radius(footprint), farthest, 1e-4);
    EXPECT_GE(bounding_radius(footprint), farthest - 1e-12);
  }
}

TEST(Separation, OfBoxesByHand) {
  const Separation ahead = separation(box(4.0, 2.0), {}, box(4.0, 2.0), {{10.0, 0.5}, 0.0});
  EXPECT_DOUBLE_EQ(ahead.distance, 6.0);
  EXPECT_DOUBLE_EQ(ahead.p_a_W.x, 2.0);
  EXPECT_DOUBLE_EQ(ahead.p_b_W.x, 8.0);
  EXPECT_DOUBLE_EQ(ahead.p_a_W.y, ahead.p_b_W.y);
  // Corner (2, 1) to corner (5, 5).
  EXPECT_DOUBLE_EQ(separation(box(4.0, 2.0), {}, box(4.0, 2.0), {{7.0, 6.0}, 0.0}).distance, 5.0);
  // A unit square on its corner, sqrt(1/2) from its centre, above the long side.
  const Separation tip = separation(box(9.0, 2.0), {}, box(1.0, 1.0), {{3.0, 4.0}, pi / 4.0});
  EXPECT_NEAR(tip.distance, 3.0 - std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(tip.p_a_W.x, 3.0, 1e-12);
  EXPECT_NEAR(tip.p_a_W.y, 1.0, 1e-12);
  // A cross: no corner of either lies inside the other.
  EXPECT_EQ(separation(box(9.0, 1.0), {}, box(9.0, 1.0), {{1.0, 0.0}, pi / 2.0}).distance, 0.0);
}

TEST(Separation, OfEllipsesAndBoxesByHand) {
  EXPECT_NEAR(separation(ellipse(2.0, 2.0), {}, ellipse(4.0, 4.0), {{6.0, 8.0}, 1.0}).distance, 7.0,
              1e-12);
  const Separation side = separation(car, {}, person, {{1.0, 3.0}, pi / 2.0});
  EXPECT_NEAR(side.distance, 3.0 - 0.95 - 0.15, 1e-12);
  EXPECT_NEAR(side.p_a_W.x, 1.0, 1e-12);
  EXPECT_NEAR(side.p_b_W.y, 2.85, 1e-12);
  // Disc against the corner (2, 1): 5 away, less the radius.
  EXPECT_NEAR(separation(box(4.0, 2.0), {}, ellipse(2.0, 2.0), {{5.0, 5.0}, 0.0}).distance, 4.0,
              1e-9);
  // Corner (0, 0) against x^2/4 + y^2 = 1 about (m + t n) with m its point of normal (1, 1), as
  // above.
  const Vec2 m{4.0 / std::sqrt(5.0), 1.0 / std::sqrt(5.0)};
  const Vec2 centre = -m - Vec2{0.3, 0.3};
  EXPECT_NEAR(
      separation(box(2.0, 2.0), {{1.0, 1.0}, 0.0}, ellipse(4.0, 2.0), {centre, 0.0}).distance,
      0.3 * std::sqrt(2.0), 1e-9);
}

TEST(Separation, OfSegmentsByHand) {
  EXPECT_DOUBLE_EQ(bounding_radius({Shape::segment, 6.0, 0.0, 1.0}), 4.0);
  const Vec2 end = support(segment(6.0), {{1.0, 2.0}, pi / 2.0}, {0.3, 1.0});
  EXPECT_NEAR(end.x, 1.0, 1e-12);
  EXPECT_NEAR(end.y, 5.0, 1e-12);
  // A wall beside the car, and one that points at its front.
  EXPECT_DOUBLE_EQ(separation(box(4.0, 2.0), {}, segment(30.0), {{3.0, 1.5}, 0.0}).distance, 0.5);
  EXPECT_NEAR(separation(box(4.0, 2.0), {}, segment(6.0), {{6.0, 0.2}, 0.0}).distance, 1.0, 1e-12);
  // One through the car's middle, one that cuts off a corner: no end lies inside.
  EXPECT_EQ(separation(box(4.0, 2.0), {}, segment(30.0), {{0.5, 0.0}, 1.0}).distance, 0.0);
  EXPECT_EQ(separation(box(4.0, 2.0), {}, segment(30.0), {{1.8, 0.8}, -pi / 4.0}).distance, 0.0);
  // The line x + y = 4 passes the corner (2, 1) at 1 / sqrt 2.
  EXPECT_NEAR(separation(box(4.0, 2.0), {}, segment(30.0), {{2.0, 2.0}, -pi / 4.0}).distance,
              std::sqrt(0.5), 1e-12);
  // A disc beside it, beyond its end at 45 degrees, and across it.
  EXPECT_NEAR(separation(segment(6.0), {}, ellipse(1.0, 1.0), {{1.0, -2.0}, 0.0}).distance, 1.5,
              1e-12);
  EXPECT_NEAR(separation(segment(6.0), {}, ellipse(2.0, 2.0), {{6.0, 3.0}, 0.0}).distance,
              std::sqrt(18.0) - 1.0, 1e-9);
  EXPECT_EQ(separation(segment(6.0), {}, ellipse(1.0, 1.0), {{1.0, 0.3}, 0.0}).distance, 0.0);
  // Two walls: across each other, a T with a gap, in one line.
  EXPECT_EQ(separation(segment(6.0), {}, segment(6.0), {{0.0, 1.0}, 1.0}).distance, 0.0);
  EXPECT_NEAR(separation(segment(6.0), {}, segment(6.0), {{1.0, 3.5}, pi / 2.0}).distance, 0.5,
              1e-12);
  EXPECT_DOUBLE_EQ(separation(segment(6.0), {}, segment(6.0), {{7.0, 0.0}, 0.0}).distance, 1.0);
}

TEST(Shape, NamesGoThereAndBack) {
  for (const Shape shape : {Shape::box, Shape::ellipse, Shape::segment}) {
    EXPECT_EQ(shape_from(name(shape)), shape);
  }
  EXPECT_EQ(shape_from("polygon"), std::nullopt);
}

TEST(Separation, IsZeroWhenTouchingConcentricOrIdentical) {
  for (const Footprint& footprint :
       {car, person, ellipse(5.0, 5.0), box(1e-3, 50.0), segment(7.0)}) {
    EXPECT_EQ(separation(footprint, {}, footprint, {}).distance, 0.0);
    EXPECT_EQ(separation(footprint, {{3.0, 1.0}, 1.0}, footprint, {{3.0, 1.0}, 1.0}).distance, 0.0);
    EXPECT_EQ(separation(footprint, {}, person, {}).distance, 0.0);
  }
  EXPECT_EQ(separation(box(4.0, 2.0), {}, box(4.0, 2.0), {{4.0, 0.0}, 0.0}).distance, 0.0);
  EXPECT_NEAR(separation(ellipse(4.0, 2.0), {}, ellipse(4.0, 2.0), {{4.0, 0.0}, 0.0}).distance, 0.0,
              1e-12);
  EXPECT_NEAR(separation(ellipse(4.0, 2.0), {}, box(4.0, 2.0), {{0.0, 2.0}, 0.0}).distance, 0.0,
              1e-12);
}

// Property: whichever way the bodies are named and wherever the world's axes lie; and both points
// lie on their bodies, as far apart as claimed.
TEST(Separation, IsSymmetricFrameInvariantAndAttained) {
  Draw draw(3);
  for (int i = 0; i < 5000; ++i) {
    const Footprint a = draw.footprint();
    const Footprint b = draw.footprint();
    const Pose X_WA = draw.pose(8.0);
    const Pose X_WB = draw.pose(8.0);
    const Separation found = separation(a, X_WA, b, X_WB);
    EXPECT_NEAR(separation(b, X_WB, a, X_WA).distance, found.distance, 1e-9);
    const Pose X_VW = draw.pose(1000.0);
    EXPECT_NEAR(separation(a, X_VW * X_WA, b, X_VW * X_WB).distance, found.distance, 1e-9);
    if (found.distance > 0.0) {
      EXPECT_NEAR(norm(found.p_b_W - found.p_a_W), found.distance, 1e-9);
      EXPECT_TRUE(holds(a, X_WA, found.p_a_W, 1e-8)) << i;
      EXPECT_TRUE(holds(b, X_WB, found.p_b_W, 1e-8)) << i;
    }
  }
}

// Oracle: a line across the way from point to point has all of each body on its own side. Together
// with the points lying on the bodies this proves that the distance is the smallest. Overlap is
// proven by a common point, looked for among the boundary points.
TEST(Separation, AgreesWithDenseSamplesOfTheBoundaries) {
  Draw draw(4);
  for (int i = 0; i < 300; ++i) {
    const Footprint a = draw.footprint();
    const Footprint b = draw.footprint();
    const Pose X_WA = draw.pose(3.0);
    const Pose X_WB = draw.pose(3.0);
    const Separation found = separation(a, X_WA, b, X_WB);
    const std::vector<Vec2> points_a = boundary(a, X_WA, 800);
    const std::vector<Vec2> points_b = boundary(b, X_WB, 800);
    const auto in_b = [&](Vec2 p) { return holds(b, X_WB, p, 1e-3); };
    const auto in_a = [&](Vec2 p) { return holds(a, X_WA, p, 1e-3); };
    if (found.distance == 0.0) {
      EXPECT_TRUE(std::any_of(points_a.begin(), points_a.end(), in_b) ||
                  std::any_of(points_b.begin(), points_b.end(), in_a))
          << i;
      continue;
    }
    const Vec2 n = (1.0 / found.distance) * (found.p_b_W - found.p_a_W);
    const double slack = 1e-6;  // the promised accuracy
    for (const Vec2 p : points_a) {
      ASSERT_LE(dot(n, p - found.p_a_W), slack) << i;
    }
    for (const Vec2 p : points_b) {
      ASSERT_GE(dot(n, p - found.p_b_W), -slack) << i;
    }
  }
}

// Needles of aspect ratio up to 1e4: the same proof, by support points.
TEST(Separation, StaysExactForExtremeAspectRatios) {
  Draw draw(5);
  for (int i = 0; i < 2000; ++i) {
    Footprint a = draw.footprint();
    Footprint b = draw.footprint();
    a.length = std::pow(10.0, draw(-2.0, 2.0));
    b.width = std::pow(10.0, draw(-2.0, 2.0));
    const Pose X_WA = draw.pose(30.0);
    const Pose X_WB = draw.pose(30.0);
    const Separation found = separation(a, X_WA, b, X_WB);
    if (found.distance > 1e-9) {
      const Vec2 n = (1.0 / found.distance) * (found.p_b_W - found.p_a_W);
      const double gap = dot(n, support(b, X_WB, -n) - support(a, X_WA, n));
      EXPECT_NEAR(gap, found.distance, 1e-6) << i;
    } else {
      // No direction of 3600 shows a gap.
      for (int k = 0; k < 3600; ++k) {
        const Vec2 n = rotated({1.0, 0.0}, k * pi / 1800.0);
        ASSERT_LE(dot(n, support(b, X_WB, -n) - support(a, X_WA, n)), 1e-6) << i;
      }
    }
  }
}

// Moved along the way between them, bodies meet exactly after the distance, not before.
TEST(Separation, ShrinksByWhatIsTravelled) {
  Draw draw(6);
  for (int i = 0; i < 1000; ++i) {
    const Footprint a = draw.footprint();
    const Footprint b = draw.footprint();
    const Pose X_WA = draw.pose(9.0);
    const Pose X_WB = draw.pose(9.0);
    const Separation found = separation(a, X_WA, b, X_WB);
    if (found.distance < 1e-3) {
      continue;
    }
    const Vec2 way = found.p_a_W - found.p_b_W;
    for (const double share : {0.5, 0.999, 0.999999}) {
      const Pose nearer{X_WB.p + share * way, X_WB.yaw};
      EXPECT_NEAR(separation(a, X_WA, b, nearer).distance, (1.0 - share) * found.distance, 1e-6);
    }
    if (a.shape == Shape::segment && b.shape == Shape::segment) {
      continue;  // without any depth their ends slip past each other
    }
    const double deeper = 1.0 + 1e-6 / found.distance;
    EXPECT_LE(separation(a, X_WA, b, {X_WB.p + deeper * way, X_WB.yaw}).distance, 1e-9);
  }
}

TEST(Separation, RefusesWhatIsNoBodyOrNoPose) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const Pose far{{50.0, 0.0}, 0.0};
  for (const double bad : {0.0, -1.0, nan, inf}) {
    EXPECT_THROW((void)separation(box(bad, 1.0), {}, car, far), ContractViolation);
    EXPECT_THROW((void)separation(car, {}, ellipse(1.0, bad), far), ContractViolation);
    EXPECT_THROW((void)bounding_radius(box(1.0, bad)), ContractViolation);
    EXPECT_THROW((void)support(box(bad, 1.0), {}, {1.0, 0.0}), ContractViolation);
  }
  EXPECT_THROW((void)separation(car, {{nan, 0.0}, 0.0}, car, far), ContractViolation);
  EXPECT_THROW((void)separation(car, {}, car, {{0.0, 0.0}, inf}), ContractViolation);
  EXPECT_THROW((void)support(car, {}, {0.0, 0.0}), ContractViolation);
  EXPECT_THROW((void)support(car, {{nan, 0.0}, 0.0}, {1.0, 0.0}), ContractViolation);
  EXPECT_THROW((void)bounding_radius({Shape::box, 1.0, 1.0, nan}), ContractViolation);
}

}  // namespace
}  // namespace saca::world::footprint_test
