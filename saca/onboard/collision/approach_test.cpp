#include "saca/onboard/collision/approach.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "saca/base/core/contract.h"

namespace saca::collision::approach_test {
namespace {

using world::Footprint;
using world::Shape;
using world::Track;

constexpr double pi = std::numbers::pi;
constexpr Footprint car{.length = 4.7, .width = 1.9};

// Constant velocity and turning rate, sampled.
Track moving(Pose X_WA, Vec2 v_W, double yaw_rate, double duration, double step = 0.01) {
  Track track{.start = 0.0, .step = step, .X_WA = {}};
  const int num_steps = static_cast<int>(std::lround(duration / step));
  for (int k = 0; k <= num_steps; ++k) {
    const double t = k * step;
    track.X_WA.push_back({X_WA.p + t * v_W, wrap_angle(X_WA.yaw + t * yaw_rate)});
  }
  return track;
}

Approach meet(const Footprint& a, const Track& X_WA, const Footprint& b, const Track& X_WB,
              double of_interest = 100.0) {
  return approach(Mover(a, X_WA), Mover(b, X_WB), 0.0, end_time(X_WA), of_interest);
}

TEST(Approach, HeadOnIsGapOverClosingSpeed) {
  const Approach found = meet(car, moving({}, {15.0, 0.0}, 0.0, 5.0), car,
                              moving({{50.0, 0.3}, pi}, {-10.0, 0.0}, 0.0, 5.0));
  ASSERT_TRUE(found.contact);
  EXPECT_NEAR(*found.contact, (50.0 - 4.7) / 25.0, 1e-3 / 25.0);  // 1 mm of travel
  EXPECT_LE(found.distance, touching);
}

// Boxes along the axes overlap when both their intervals do: the later of the two entries.
TEST(Approach, OfAxisParallelBoxesIsTheLaterEntry) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int contacts = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec2 p{20.0 * uniform(rng), 12.0 * uniform(rng)};
    const Vec2 v{25.0 * uniform(rng), 25.0 * uniform(rng)};
    const Vec2 v_ego{15.0 * uniform(rng), 5.0 * uniform(rng)};
    const auto window = [](double offset, double speed, double reach) {
      const double first = (-reach - offset) / speed;
      const double second = (reach - offset) / speed;
      return std::pair{std::min(first, second), std::max(first, second)};
    };
    const auto [in_x, out_x] = window(p.x, v.x - v_ego.x, 4.7);
    const auto [in_y, out_y] = window(p.y, v.y - v_ego.y, 1.9);
    const double enters = std::max({in_x, in_y, 0.0});
    const bool expected = enters < std::min({out_x, out_y, 4.0});
    const Approach found =
        meet(car, moving({}, v_ego, 0.0, 4.0), car, moving({p, 0.0}, v, 0.0, 4.0));
    ASSERT_EQ(found.contact.has_value(), expected) << i;
    if (expected) {
      const double speed = norm(v - v_ego);
      EXPECT_NEAR(*found.contact * speed, enters * speed, 2e-3) << i;  // glancing: 0.1 mm / sin
      ++contacts;
    }
  }
  EXPECT_GT(contacts, 30);
}

// A bar that turns about its middle meets a pin at radius r when its long side gets there:
// r sin(angle) = half its width + the pin's radius.
TEST(Approach, OfATurningBarIsWhenItsSideReachesThePin) {
  const Footprint bar{.length = 8.0, .width = 0.4};
  const Footprint pin{.shape = Shape::ellipse, .length = 0.1, .width = 0.1};
  const double yaw_rate = -1.3;
  const Approach found = meet(bar, moving({{0.0, 0.0}, pi / 2.0}, {}, yaw_rate, 2.0), pin,
                              moving({{3.0, 0.0}, 0.0}, {}, 0.0, 2.0));
  ASSERT_TRUE(found.contact);
  const double expected = (pi / 2.0 - std::asin(0.25 / 3.0)) / 1.3;
  EXPECT_NEAR(*found.contact, expected, 1e-3 / (1.3 * 3.0));
}

TEST(Approach, ThinAndFastDoesNotTunnel) {
  const Footprint plate{.length = 0.01, .width = 2.0};
  const Footprint pin{.shape = Shape::ellipse, .length = 0.001, .width = 0.001};
  // 1 m and more per sample, three times through the plate's place.
  for (const double speed : {100.0, 331.0, 1000.0}) {
    const Approach found = meet(plate, moving({{10.0, 0.0}, 0.0}, {}, 0.0, 1.0), pin,
                                moving({{0.5, 0.9}, 0.0}, {speed, 0.0}, 0.0, 1.0));
    ASSERT_TRUE(found.contact) << speed;
    EXPECT_NEAR(*found.contact * speed, 10.0 - 0.005 - 0.0005 - 0.5, 1e-3);
  }
}

TEST(Approach, PassingByKeepsTheSmallestDistance) {
  const Approach beside = meet(car, moving({}, {20.0, 0.0}, 0.0, 5.0), car,
                               moving({{60.0, 3.4}, pi}, {-15.0, 0.0}, 0.0, 5.0));
  EXPECT_FALSE(beside.contact);
  EXPECT_NEAR(beside.distance, 3.4 - 1.9, 1e-3);
  // A disc past a corner: the distance of the corner (2.35, 0.95) from the line y = x, less the
  // radius.
  const Footprint disc{.shape = Shape::ellipse, .length = 1.0, .width = 1.0};
  const Approach corner =
      meet(car, moving({}, {}, 0.0, 5.0), disc, moving({{-3.0, 12.0}, 0.0}, {7.0, -7.0}, 0.0, 5.0));
  EXPECT_NEAR(corner.distance, (9.0 - 2.35 - 0.95) / std::sqrt(2.0) - 0.5, 1e-3);
  EXPECT_NEAR(meet(car, moving({}, {20.0, 0.0}, 0.0, 5.0), car,
                   moving({{60.0, 30.0}, pi}, {-15.0, 0.0}, 0.0, 5.0), 9.0)
                  .distance,
              9.0, 1e-12);  // no more than is of interest
}

TEST(Approach, OverlapAtTheStartIsContactThen) {
  const Approach found = meet(car, moving({}, {5.0, 0.0}, 0.0, 1.0), car,
                              moving({{2.0, 0.5}, 0.3}, {5.0, 0.0}, 0.0, 1.0));
  EXPECT_EQ(found.contact, 0.0);
}

// Only contact is asked for: the search takes its longest strides, and still stops before overlap.
TEST(Approach, AskedForContactOnlyFindsTheSame) {
  const Footprint person{.shape = Shape::ellipse, .length = 0.3, .width = 0.5};
  for (const double yaw : {0.0, 0.2, 0.7, 1.3}) {
    const Track X_WA = moving({{}, yaw}, rotated({15.0, 0.0}, yaw), 0.0, 4.0);
    const Track X_WB = moving({rotated({40.0, 0.0}, yaw), 0.3}, {}, 0.0, 4.0);
    const Approach found = meet(car, X_WA, person, X_WB, 0.0);
    ASSERT_TRUE(found.contact);
    EXPECT_NEAR(*found.contact, *meet(car, X_WA, person, X_WB).contact, touching / 15.0);
    EXPECT_GT(separation(car, pose_at(X_WA, *found.contact), person, X_WB.X_WA[0]).distance, 0.0);
  }
}

TEST(Approach, AStoppedTrackStaysWhereItEnds) {
  // The other stops at x = 20 after 1 s; the ego arrives later.
  const Approach found = meet(car, moving({}, {5.0, 0.0}, 0.0, 6.0), car,
                              moving({{10.0, 0.0}, 0.0}, {10.0, 0.0}, 0.0, 1.0, 0.1));
  ASSERT_TRUE(found.contact);
  EXPECT_NEAR(*found.contact, (20.0 - 4.7) / 5.0, 1e-3 / 5.0);
}

// Oracle: small steps, with what the bodies can move in half a step as the tolerance.
TEST(Approach, AgreesWithSteppingThroughTheMotion) {
  constexpr double step = 5e-4;
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 40; ++i) {
    const Footprint other{.shape = i % 2 == 0 ? Shape::box : Shape::ellipse,
                          .length = 2.0 + uniform(rng),
                          .width = 1.0 + 0.5 * uniform(rng),
                          .centre_x = 0.5 * uniform(rng)};
    const Track X_WA = moving({{0.0, 0.0}, 3.0 * uniform(rng)},
                              {10.0 * uniform(rng), 10.0 * uniform(rng)}, 2.0 * uniform(rng), 1.5);
    const Track X_WB =
        moving({{8.0 * uniform(rng), 8.0 * uniform(rng)}, 3.0 * uniform(rng)},
               {10.0 * uniform(rng), 10.0 * uniform(rng)}, 2.0 * uniform(rng), 1.5, 0.05);
    const Approach found = meet(car, X_WA, other, X_WB);
    double smallest = 100.0;
    int steps = 0;
    for (; steps <= 3000 && smallest > 0.0; ++steps) {
      smallest = std::min(
          smallest, separation(car, pose_at(X_WA, steps * step), other, pose_at(X_WB, steps * step))
                        .distance);
    }
    const double slack = 0.5 * step * 40.0 + 1e-3;
    if (found.contact) {
      EXPECT_LE(smallest, slack) << i;
      EXPECT_GE(steps * step, *found.contact - 1e-9) << i;
      const auto gap =
          separation(car, pose_at(X_WA, *found.contact), other, pose_at(X_WB, *found.contact));
      EXPECT_LE(gap.distance, touching) << i;
    } else {
      EXPECT_NEAR(found.distance, smallest, slack) << i;
    }
  }
}

TEST(Touch, OfFlatFacesIsTheMiddleOfTheirOverlap) {
  // Offset head-on: y from -0.95 to 0.95 against 0.25 to 2.15.
  const Touch at = touch(car, {}, car, {{4.7 + 1e-4, 1.2}, pi}, 0.1);
  EXPECT_NEAR(at.p_W.x, 2.35, 1e-3);
  EXPECT_NEAR(at.p_W.y, 0.6, 1e-9);
  EXPECT_NEAR(at.n_W.x, 1.0, 1e-9);
}

TEST(Touch, OfACornerIsTheCorner) {
  // A square on its corner before the car's front.
  const Footprint square{.length = 1.0, .width = 1.0};
  const Touch at = touch(car, {}, square, {{2.35 + std::sqrt(0.5) + 1e-4, 0.3}, pi / 4.0}, 0.1);
  EXPECT_NEAR(at.p_W.x, 2.35, 1e-3);
  EXPECT_NEAR(at.p_W.y, 0.3, 1e-9);
  EXPECT_NEAR(at.n_W.x, 1.0, 1e-9);
}

TEST(Touch, OfAnEllipseIsItsFoot) {
  const Footprint person{.shape = Shape::ellipse, .length = 0.3, .width = 0.5};
  const Touch at = touch(car, {}, person, {{1.0, 0.95 + 0.25 + 1e-4}, 0.0}, 0.05);
  EXPECT_NEAR(at.p_W.x, 1.0, 1e-9);
  EXPECT_NEAR(at.p_W.y, 0.95, 1e-3);
  EXPECT_NEAR(at.n_W.y, 1.0, 1e-9);
}

TEST(Touch, OfOverlappingBodiesPointsToWhereTheyWouldPart) {
  // Half a metre into the side of a long truck: far from the line of centres.
  const Footprint truck{.length = 12.0, .width = 2.5};
  const Touch at = touch(car, {}, truck, {{3.1, 4.0}, pi / 2.0}, 0.1);
  EXPECT_NEAR(at.n_W.x, 1.0, 0.05);
  EXPECT_NEAR(at.p_W.x, 2.1, 0.3);  // between the truck's side at 1.85 and the car's front at 2.35
  const Touch same = touch(car, {{5.0, 5.0}, 0.0}, car, {{5.0, 5.0}, 0.0}, 0.1);
  EXPECT_NEAR(norm(same.n_W), 1.0, 1e-12);
  EXPECT_NEAR(same.p_W.x, 5.0, 1e-12);
}

TEST(Touch, OfAWallIsWhereTheCornerRunsIntoIt) {
  const Footprint wall{.shape = Shape::segment, .length = 30.0};
  const double angle = 0.3;
  // The car's front left corner, up to 1e-7 m: on either side of the wall, along the line y = 5.
  const Vec2 corner = rotated({2.35, 0.95}, angle);
  for (const double gap : {1e-7, -1e-7}) {
    const Pose X_WA{{4.0, 5.0 - gap - corner.y}, angle};
    const Touch at = touch(car, X_WA, wall, {{0.0, 5.0}, 0.0}, 1e-6);
    EXPECT_LT(norm(at.p_W - Vec2{4.0 + corner.x, 5.0}), 1e-4);
    EXPECT_NEAR(at.n_W.y, 1.0, 1e-6);
  }
}

// Turned by a little, the part of the front within the depth: from the corner back to where the
// face lies `depth` behind it, depth / sin(angle) along the wall.
TEST(Foremost, OfABoxIsTheMiddleOfWhatCrumples) {
  const double angle = 0.2;
  const Vec2 corner = rotated({2.35, -0.95}, angle);  // foremost along x
  const Vec2 p_W = foremost(car, {{1.0, 2.0}, angle}, {1.0, 0.0}, 0.1);
  EXPECT_NEAR(p_W.x, 1.0 + corner.x, 1e-12);
  // Along the front upwards 0.1 / tan(angle); along the side downwards 0.1 tan(angle).
  EXPECT_NEAR(p_W.y, 2.0 + corner.y + 0.05 * (1.0 / std::tan(angle) - std::tan(angle)), 1e-9);
  const Vec2 flat = foremost(car, {{1.0, 2.0}, 0.0}, {1.0, 0.0}, 0.1);
  EXPECT_NEAR(flat.y, 2.0, 1e-12);
}

TEST(Approach, AMillimetreOfGrazeFarFromTheOriginAndLateIsFound) {
  const Footprint pin{.shape = Shape::ellipse, .length = 0.002, .width = 0.002};
  const Vec2 far{3.2e5, -5.1e6};
  for (const double start : {0.0, 1e6}) {
    Track X_WA = moving({far, 0.0}, {20.0, 0.0}, 0.0, 2.0);
    Track X_WB = moving({far + Vec2{12.35, 0.9505}, 0.0}, {}, 0.0, 2.0);
    X_WA.start = X_WB.start = start;
    const Approach found = approach(Mover(car, X_WA), Mover(pin, X_WB), start, start + 2.0, 0.0);
    ASSERT_TRUE(found.contact);
    // The corner meets the pin sqrt(1 - 0.5^2) mm before its middle.
    EXPECT_NEAR(*found.contact - start, (10.0 - 1e-3 * std::sqrt(0.75)) / 20.0,
                1e-8 + 1e-15 * start);
  }
}

TEST(Approach, RefusesWhatIsNoMotion) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Track still = moving({}, {}, 0.0, 1.0);
  Track bad = still;
  bad.X_WA[3].p.x = nan;
  EXPECT_THROW(Mover(car, bad), ContractViolation);
  EXPECT_THROW(Mover(car, Track{}), ContractViolation);
  EXPECT_THROW(Mover(Footprint{.length = nan, .width = 1.0}, still), ContractViolation);
  const Mover mover(car, still);
  EXPECT_THROW((void)approach(mover, mover, 1.0, 0.0, 1.0), ContractViolation);
  EXPECT_THROW((void)approach(mover, mover, nan, 1.0, 1.0), ContractViolation);
  EXPECT_THROW((void)approach(mover, mover, 0.0, 1.0, -1.0), ContractViolation);
  EXPECT_THROW((void)touch(car, {}, car, {}, 0.0), ContractViolation);
}

}  // namespace
}  // namespace saca::collision::approach_test
