#include "saca/thinking/danger/intrusion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "saca/base/core/contract.h"

namespace saca::danger::intrusion_test {
namespace {

using world::Footprint;
using world::Shape;

constexpr double pi = std::numbers::pi;
constexpr Footprint car{.length = 4.7, .width = 1.9, .centre_x = -0.1};
constexpr Footprint walker{.shape = Shape::ellipse, .length = 0.6, .width = 0.6};
constexpr Footprint paper_ellipse{.shape = Shape::ellipse, .length = 7.0, .width = 3.5};
constexpr Footprint wall{.shape = Shape::segment, .length = 6.0};

// The definition: the least overlap of the two shadows over all directions, by world::support.
double by_brute_force(const Footprint& a, const Pose& X_WA, const Footprint& b, const Pose& X_WB,
                      int num_directions) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < num_directions; ++i) {
    const Vec2 n = rotated({1.0, 0.0}, 2.0 * pi * i / num_directions);
    least = std::min(least, dot(n, support(a, X_WA, n) - support(b, X_WB, -n)));
  }
  return least;
}

// A direction looked at lies up to 0.87 mrad off the best one, with arms of at most 6 m.
TEST(Intrusion, IsTheLeastOverlapOfShadowsForEveryPairOfShapes) {
  std::mt19937_64 draws(1);
  std::uniform_real_distribution<double> place(-5.0, 5.0);
  std::uniform_real_distribution<double> angle(-pi, pi);
  const std::array<Footprint, 4> shapes{car, walker, paper_ellipse, wall};
  int num_deep = 0;
  for (int i = 0; i < 400; ++i) {
    const Footprint& a = shapes.at(draws() % 4);
    const Footprint& b = shapes.at(draws() % 4);
    const Pose X_WA{{place(draws), place(draws)}, angle(draws)};
    const Pose X_WB{{place(draws), place(draws)}, angle(draws)};
    const double expected = by_brute_force(a, X_WA, b, X_WB, 3'600);
    const double found = intrusion(a, X_WA, b, X_WB);
    EXPECT_LE(found, expected + 1e-9) << i;  // brute force looks at some directions alone
    EXPECT_GE(found, expected - 6.0 * pi / 3'600) << i;
    EXPECT_NEAR(intrusion(b, X_WB, a, X_WA), found, 1e-9) << i;
    num_deep += found > 0.1 ? 1 : 0;
  }
  EXPECT_GT(num_deep, 50);
}

// Smooth pairs: the directions' error is of second order, 0.5 x 7 m x (0.87 mrad)^2 < 3e-6 m.
TEST(Intrusion, IsExactBetweenEllipses) {
  std::mt19937_64 draws(2);
  std::uniform_real_distribution<double> place(-4.0, 4.0);
  std::uniform_real_distribution<double> angle(-pi, pi);
  for (int i = 0; i < 100; ++i) {
    const Pose X_WB{{place(draws), place(draws)}, angle(draws)};
    EXPECT_NEAR(intrusion(paper_ellipse, {}, paper_ellipse, X_WB),
                by_brute_force(paper_ellipse, {}, paper_ellipse, X_WB, 3'600), 2e-5)
        << i;
  }
}

// Sides' normals are the only directions along which boxes can be parted soonest; apart, a corner
// may be nearest, so only overlapping boxes are compared.
TEST(Intrusion, OfBoxesIsFoundAlongTheirAxes) {
  std::mt19937_64 draws(3);
  std::uniform_real_distribution<double> place(-3.0, 3.0);
  std::uniform_real_distribution<double> angle(-pi, pi);
  for (int i = 0; i < 200; ++i) {
    const Pose X_WB{{place(draws), place(draws)}, angle(draws)};
    double least = std::numeric_limits<double>::infinity();
    for (const double normal : {0.0, 0.5 * pi, X_WB.yaw, X_WB.yaw + 0.5 * pi}) {
      const Vec2 n = rotated({1.0, 0.0}, normal);
      least = std::min({least, dot(n, support(car, {}, n) - support(car, X_WB, -n)),
                        dot(-n, support(car, {}, -n) - support(car, X_WB, n))});
    }
    if (least > 0.0) {
      EXPECT_NEAR(intrusion(car, {}, car, X_WB), least, 1e-12) << i;
    }
  }
}

TEST(Intrusion, HasClosedForms) {
  // Discs of 0.3 m: the sum of the radii less the distance.
  EXPECT_NEAR(intrusion(walker, {}, walker, {{0.2, 0.1}, 0.4}), 0.6 - std::hypot(0.2, 0.1), 1e-9);
  EXPECT_NEAR(intrusion(walker, {}, walker, {{3.0, 4.0}, 0.4}), 0.6 - 5.0, 1e-9);
  EXPECT_NEAR(intrusion(walker, {}, walker, {}), 0.6, 1e-9);
  // Semi-axes 3.5 m and 1.75 m: along an axis of the ellipse, the disc stands at the vertex.
  EXPECT_NEAR(intrusion(paper_ellipse, {}, walker, {{0.0, 1.6}, 0.0}), 1.75 + 0.3 - 1.6, 1e-9);
  EXPECT_NEAR(intrusion(paper_ellipse, {}, walker, {{5.0, 0.0}, 0.0}), 3.5 + 0.3 - 5.0, 1e-9);
  // A car behind another, 0.7 m too far forward: its body reaches from -2.45 to 2.25 m.
  EXPECT_NEAR(intrusion(car, {}, car, {{4.0, 0.2}, 0.0}), 0.7, 1e-12);
  EXPECT_NEAR(intrusion(car, {}, car, {{5.0, 0.2}, 0.0}), -0.3, 1e-9);
  EXPECT_NEAR(intrusion(car, {}, walker, {{0.0, 1.0}, 0.0}), 0.95 + 0.3 - 1.0, 1e-9);
  EXPECT_NEAR(intrusion(wall, {}, walker, {{1.0, 0.1}, 0.0}), 0.2, 1e-9);
}

// Shifting the first by its depth, along some direction, parts the two: no less does.
TEST(Intrusion, IsTheShortestWayThatPartsThem) {
  const Pose X_WB{{1.1, 0.9}, 0.7};
  const double depth = intrusion(paper_ellipse, {}, car, X_WB);
  ASSERT_GT(depth, 0.3);
  const auto least_left = [&](double way) {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3'600; ++i) {
      const Pose shifted{rotated({way, 0.0}, 2.0 * pi * i / 3'600), 0.0};
      least = std::min(least, intrusion(paper_ellipse, shifted, car, X_WB));
    }
    return least;
  };
  EXPECT_LT(least_left(depth + 1e-4), 0.0);
  EXPECT_GT(least_left(depth - 1e-4), 0.0);
}

TEST(Intrusion, IntoAHalfPlaneIsTheReachBeyondItsEdge) {
  const HalfPlane left{{0.0, 1.0}, 3.0};
  EXPECT_NEAR(intrusion(car, {{7.0, 2.5}, 0.0}, left), 2.5 + 0.95 - 3.0, 1e-12);
  EXPECT_NEAR(intrusion(car, {{7.0, 0.0}, 0.5 * pi}, left), 2.25 - 3.0, 1e-12);
  EXPECT_NEAR(intrusion(car, {{7.0, 0.0}, -0.5 * pi}, left), 2.45 - 3.0, 1e-12);
  // An ellipse reaches sqrt((a sin)^2 + (b cos)^2) to the side.
  EXPECT_NEAR(intrusion(paper_ellipse, {{0.0, 1.0}, 0.6}, left),
              1.0 + std::hypot(3.5 * std::sin(0.6), 1.75 * std::cos(0.6)) - 3.0, 1e-12);
}

TEST(Intrusion, RefusesWhatIsNoGround) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)intrusion(car, {}, HalfPlane{{0.0, 2.0}, 0.0}), ContractViolation);
  EXPECT_THROW((void)intrusion(car, {}, HalfPlane{{0.0, 1.0}, nan}), ContractViolation);
  EXPECT_THROW((void)intrusion(car, {{nan, 0.0}, 0.0}, walker, {}), ContractViolation);
  EXPECT_THROW((void)intrusion(Footprint{}, {}, walker, {}), ContractViolation);
}

}  // namespace
}  // namespace saca::danger::intrusion_test
