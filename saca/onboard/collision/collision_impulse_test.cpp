#include "saca/onboard/collision/collision_impulse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "saca/base/core/contract.h"

namespace saca::collision::collision_impulse_test {
namespace {

constexpr world::Footprint car{.length = 4.7, .width = 1.9};

ImpactBody body(double mass, Vec2 p_W, Vec2 v_W, double yaw_rate = 0.0) {
  ImpactBody result = free_body(mass, car);
  result.p_W = p_W;
  result.v_W = v_W;
  result.yaw_rate = yaw_rate;
  return result;
}

double cross(Vec2 a, Vec2 b) {
  return a.x * b.y - a.y * b.x;
}

ImpactBody after(ImpactBody before, Vec2 impulse_W, double spin) {
  before.v_W = before.v_W + before.inverse_mass * impulse_W;
  before.yaw_rate += spin;
  return before;
}

// About a point of the world [N m s].
double angular_momentum(const ImpactBody& one, Vec2 p_W) {
  return cross(one.p_W - p_W, one.v_W) / one.inverse_mass + one.yaw_rate / one.inverse_yaw_inertia;
}

double energy(const ImpactBody& one) {
  return 0.5 * dot(one.v_W, one.v_W) / one.inverse_mass +
         0.5 * one.yaw_rate * one.yaw_rate / one.inverse_yaw_inertia;
}

TEST(FreeBody, HasTheInertiaOfItsShape) {
  const ImpactBody box = free_body(1200.0, {.length = 4.0, .width = 2.0});
  EXPECT_DOUBLE_EQ(1.0 / box.inverse_yaw_inertia, 1200.0 * 20.0 / 12.0);
  const ImpactBody disc =
      free_body(80.0, {.shape = world::Shape::ellipse, .length = 0.6, .width = 0.6});
  EXPECT_DOUBLE_EQ(1.0 / disc.inverse_yaw_inertia, 0.5 * 80.0 * 0.09);  // m r^2 / 2
}

TEST(CollisionImpulse, PlasticCentralSharesTheClosingSpeedByMass) {
  const ImpactBody a = body(1500.0, {0.0, 0.0}, {12.0, 0.0});
  const ImpactBody b = body(500.0, {4.7, 0.0}, {-4.0, 0.0});
  const CollisionImpulse impact = collision_impulse(a, b, {2.35, 0.0}, {1.0, 0.0}, {0.0, 0.5});
  EXPECT_DOUBLE_EQ(impact.a_delta_v, 4.0);   // 16 x 500 / 2000
  EXPECT_DOUBLE_EQ(impact.b_delta_v, 12.0);  // 16 x 1500 / 2000
  EXPECT_DOUBLE_EQ(impact.impulse_W.x, 6000.0);
}

TEST(CollisionImpulse, RestitutionAddsItsShare) {
  const ImpactBody a = body(1500.0, {0.0, 0.0}, {16.0, 0.0});
  const ImpactBody b = body(500.0, {4.7, 0.0}, {});
  EXPECT_DOUBLE_EQ(collision_impulse(a, b, {2.35, 0.0}, {1.0, 0.0}, {0.25, 0.5}).a_delta_v, 5.0);
}

TEST(CollisionImpulse, AgainstTheGroundTakesAllTheSpeed) {
  const ImpactBody a = body(1500.0, {0.0, 0.0}, {10.0, 0.0});
  const CollisionImpulse impact = collision_impulse(a, {}, {2.35, 0.0}, {1.0, 0.0}, {0.0, 0.5});
  EXPECT_DOUBLE_EQ(impact.a_delta_v, 10.0);
  EXPECT_EQ(impact.b_delta_v, 0.0);
}

// Off centre by c, without friction: the wall feels the mass 1 / (1/m + c^2/I).
TEST(CollisionImpulse, OffCentreFeelsLessMass) {
  const double c = 0.8;
  const double inertia = 1500.0 * (4.7 * 4.7 + 1.9 * 1.9) / 12.0;
  const ImpactBody a = body(1500.0, {0.0, 0.0}, {10.0, 0.0});
  const CollisionImpulse impact = collision_impulse(a, {}, {2.35, c}, {1.0, 0.0}, {0.0, 0.0});
  EXPECT_NEAR(impact.impulse_W.x, 10.0 / (1.0 / 1500.0 + c * c / inertia), 1e-6);
}

// Plastic, without friction, onto the side of a car at rest, c ahead of its centre: the impulse is
// v over (1/m + 1/m + c^2/I), and turns the struck car by c J / I, to the left when it is pushed to
// the left ahead of its centre. The striking car, hit in the middle of its front, does not turn.
TEST(CollisionImpulse, ATBoneTurnsTheStruckCar) {
  const double c = 1.2;
  const double inertia = 1500.0 * (4.7 * 4.7 + 1.9 * 1.9) / 12.0;
  const ImpactBody striking = body(1500.0, {c, -3.3}, {0.0, 10.0});
  const ImpactBody struck = body(1500.0, {0.0, 0.0}, {});
  const CollisionImpulse impact =
      collision_impulse(striking, struck, {c, -0.95}, {0.0, 1.0}, {0.0, 0.0});
  const double J = 10.0 / (2.0 / 1500.0 + c * c / inertia);
  EXPECT_NEAR(impact.impulse_W.y, J, 1e-8);
  EXPECT_NEAR(impact.b_spin, c * J / inertia, 1e-12);
  EXPECT_GT(impact.b_spin, 0.0);
  EXPECT_EQ(impact.a_spin, 0.0);
}

// A disc sliding along a wall: friction is mu times the normal impulse as long as it slides on.
TEST(CollisionImpulse, SlidingIsRubbedByFriction) {
  ImpactBody disc = free_body(80.0, {.shape = world::Shape::ellipse, .length = 1.0, .width = 1.0});
  disc.v_W = {2.0, 20.0};
  const CollisionImpulse impact = collision_impulse(disc, {}, {0.5, 0.0}, {1.0, 0.0}, {0.0, 0.3});
  EXPECT_NEAR(impact.impulse_W.x, 160.0, 1e-9);  // on the wall
  EXPECT_NEAR(impact.impulse_W.y, 0.3 * 160.0, 1e-9);
}

// The same disc with little sliding grips: it rolls on, v_y = -r w; a disc then keeps 2/3 of v_y.
TEST(CollisionImpulse, LittleSlidingIsStopped) {
  ImpactBody disc = free_body(80.0, {.shape = world::Shape::ellipse, .length = 1.0, .width = 1.0});
  disc.v_W = {2.0, 0.9};
  const CollisionImpulse impact = collision_impulse(disc, {}, {0.5, 0.0}, {1.0, 0.0}, {0.0, 0.3});
  EXPECT_NEAR(impact.impulse_W.y, 80.0 * 0.3, 1e-9);
}

TEST(CollisionImpulse, DoesNothingWhenTheBodiesPart) {
  const ImpactBody a = body(1500.0, {0.0, 0.0}, {5.0, 0.0});
  const ImpactBody b = body(1500.0, {4.7, 0.0}, {6.0, 0.0});
  const CollisionImpulse impact = collision_impulse(a, b, {2.35, 0.0}, {1.0, 0.0}, {0.1, 0.5});
  EXPECT_EQ(impact.a_delta_v, 0.0);
  EXPECT_EQ(impact.b_delta_v, 0.0);
}

// Properties, for any geometry: momentum and angular momentum are kept, energy is not created, the
// bodies part along the normal as restitution says, friction stays within its cone.
TEST(CollisionImpulse, KeepsMomentumAndCreatesNoEnergy) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 5000; ++i) {
    const double mass_a = 60.0 * std::exp(3.0 + 3.0 * uniform(rng));
    const double mass_b = 60.0 * std::exp(3.0 + 3.0 * uniform(rng));
    const ImpactBody a = body(mass_a, {3.0 * uniform(rng), 3.0 * uniform(rng)},
                              {30.0 * uniform(rng), 30.0 * uniform(rng)}, 3.0 * uniform(rng));
    const ImpactBody b = body(mass_b, {3.0 * uniform(rng), 3.0 * uniform(rng)},
                              {30.0 * uniform(rng), 30.0 * uniform(rng)}, 3.0 * uniform(rng));
    const Vec2 p{3.0 * uniform(rng), 3.0 * uniform(rng)};
    const Vec2 n = rotated({1.0, 0.0}, std::numbers::pi * uniform(rng));
    const ImpactLaw law{0.5 + 0.5 * uniform(rng), 0.6 + 0.6 * uniform(rng)};
    const CollisionImpulse impact = collision_impulse(a, b, p, n, law);
    EXPECT_NEAR(impact.a_delta_v * mass_a, impact.b_delta_v * mass_b, 1e-6);

    const ImpactBody a_after = after(a, -impact.impulse_W, impact.a_spin);
    const ImpactBody b_after = after(b, impact.impulse_W, impact.b_spin);
    const Vec2 somewhere{50.0 * uniform(rng), 50.0 * uniform(rng)};
    const double turning = angular_momentum(a, somewhere) + angular_momentum(b, somewhere);
    EXPECT_NEAR(angular_momentum(a_after, somewhere) + angular_momentum(b_after, somewhere),
                turning, 1e-12 * 50.0 * 50.0 * (mass_a + mass_b))
        << i;
    // What the impulse takes from both along the way between before and after: the work of a force
    // is its impulse times the mean of the velocity at its point.
    const Vec2 mean =
        0.5 * (relative_velocity_at(a, b, p) + relative_velocity_at(a_after, b_after, p));
    EXPECT_NEAR(energy(a_after) + energy(b_after) - energy(a) - energy(b),
                dot(impact.impulse_W, mean), 1e-9 * (energy(a) + energy(b)))
        << i;
    const double before = energy(a) + energy(b);
    EXPECT_LE(energy(a_after) + energy(b_after), before * (1.0 + 1e-12)) << i;
    const double closing = dot(relative_velocity_at(a, b, p), n);
    if (closing < 0.0) {
      EXPECT_NEAR(dot(relative_velocity_at(a_after, b_after, p), n), -law.restitution * closing,
                  1e-9 * std::abs(closing) + 1e-9)
          << i;
    }
    const double normal = dot(impact.impulse_W, n);
    EXPECT_GE(normal, 0.0);
    EXPECT_LE(std::abs(cross(n, impact.impulse_W)), law.friction * normal + 1e-6);
  }
}

TEST(CollisionImpulse, IsTheSameFromBothSidesTurnedAndMirrored) {
  std::mt19937 rng(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto mirrored = [](Vec2 v) { return Vec2{v.x, -v.y}; };
  for (int i = 0; i < 500; ++i) {
    const ImpactBody a = body(1500.0, {uniform(rng), uniform(rng)},
                              {20.0 * uniform(rng), 20.0 * uniform(rng)}, uniform(rng));
    const ImpactBody b = body(900.0, {uniform(rng), uniform(rng)},
                              {20.0 * uniform(rng), 20.0 * uniform(rng)}, uniform(rng));
    const Vec2 p{uniform(rng), uniform(rng)};
    const Vec2 n = rotated({1.0, 0.0}, 3.0 * uniform(rng));
    const ImpactLaw law{0.1, 0.5};
    const CollisionImpulse impact = collision_impulse(a, b, p, n, law);
    const CollisionImpulse seen = collision_impulse(b, a, p, -n, law);
    EXPECT_NEAR(seen.b_delta_v, impact.a_delta_v, 1e-9);
    EXPECT_NEAR(seen.a_delta_v, impact.b_delta_v, 1e-9);
    EXPECT_NEAR(seen.a_spin, impact.b_spin, 1e-9);
    EXPECT_NEAR(seen.b_spin, impact.a_spin, 1e-9);

    const auto turned = [&](ImpactBody one) {
      one.p_W = rotated(one.p_W, 1.1);
      one.v_W = rotated(one.v_W, 1.1);
      return one;
    };
    EXPECT_NEAR(
        collision_impulse(turned(a), turned(b), rotated(p, 1.1), rotated(n, 1.1), law).a_delta_v,
        impact.a_delta_v, 1e-9);
    const auto flipped = [&](ImpactBody one) {
      one.p_W = mirrored(one.p_W);
      one.v_W = mirrored(one.v_W);
      one.yaw_rate = -one.yaw_rate;
      return one;
    };
    EXPECT_NEAR(collision_impulse(flipped(a), flipped(b), mirrored(p), mirrored(n), law).a_delta_v,
                impact.a_delta_v, 1e-9);
    EXPECT_NEAR(collision_impulse(flipped(a), flipped(b), mirrored(p), mirrored(n), law).b_spin,
                -impact.b_spin, 1e-9);
  }
}

TEST(CollisionImpulse, RefusesWhatIsNoImpact) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const ImpactBody a = body(1500.0, {}, {1.0, 0.0});
  EXPECT_THROW((void)collision_impulse(a, a, {nan, 0.0}, {1.0, 0.0}, {}), ContractViolation);
  EXPECT_THROW((void)collision_impulse(a, a, {}, {2.0, 0.0}, {}), ContractViolation);
  EXPECT_THROW((void)collision_impulse(a, a, {}, {nan, 0.0}, {}), ContractViolation);
  EXPECT_THROW((void)collision_impulse(a, a, {}, {1.0, 0.0}, {1.1, 0.0}), ContractViolation);
  EXPECT_THROW((void)collision_impulse(a, a, {}, {1.0, 0.0}, {0.0, -0.1}), ContractViolation);
  EXPECT_THROW((void)collision_impulse({}, {}, {}, {1.0, 0.0}, {}), ContractViolation);
  EXPECT_THROW((void)free_body(0.0, car), ContractViolation);
  EXPECT_THROW((void)free_body(nan, car), ContractViolation);
}

}  // namespace
}  // namespace saca::collision::collision_impulse_test
