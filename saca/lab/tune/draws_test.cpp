#include "saca/lab/tune/draws.h"

#include <gtest/gtest.h>

#include <numbers>

#include "saca/base/core/contract.h"
#include "saca/base/core/units.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "tests/support/scenes.h"

namespace saca::tune::draws_test {
namespace {

using test::ego_alone;

constexpr manoeuvre::Plan brake{manoeuvre::PolicyId::aeb, std::nullopt};
constexpr manoeuvre::Plan drift{manoeuvre::PolicyId::t_drift_right, std::nullopt};

TEST(Draws, SameSeedSameEndingsOnAnyThreads) {
  const manoeuvre::Car car = prepare::default_car();
  const auto a = draw_endings(car, brake, ego_alone(12.0, 0.8), {0.8, 5.0, 12, 3, 2, 1});
  const auto b = draw_endings(car, brake, ego_alone(12.0, 0.8), {0.8, 5.0, 12, 3, 2, 3});
  ASSERT_EQ(a.size(), 12U);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].X_WB.p.x, b[i].X_WB.p.x);
    EXPECT_TRUE(a[i].ended);
    EXPECT_EQ(a[i].speed, 0.0);
    EXPECT_EQ(a[i].path.empty(), i >= 2);
  }
  EXPECT_NE(a[0].X_WB.p.x, a[1].X_WB.p.x);
  EXPECT_EQ(a[0].path.back().p.x, a[0].X_WB.p.x);
}

TEST(Draws, TheHorizonMayComeFirst) {
  const manoeuvre::Ride ride(prepare::default_car(), brake, ego_alone(20.0, 0.9), 0.9);
  EXPECT_TRUE(ride_to_end(ride, 1.0).path.empty());
  const Ending ending = ride_along_path(ride, 1.0);
  EXPECT_FALSE(ending.ended);
  EXPECT_NEAR(ending.time, 1.0, 1e-9);
  EXPECT_GT(ending.speed, 5.0);
  EXPECT_EQ(ending.path.size(), 21U);  // 20 intervals of 50 ms
}

TEST(Draws, AcrossIsWithinTenDegreesOfTheSideAndAtRest) {
  world::Road road;
  road.X_WL.yaw = 1.0;
  const auto at = [&](double degrees, bool ended) {
    return Ending{.X_WB = {{}, 1.0 + from_degrees(degrees)}, .ended = ended};
  };
  EXPECT_EQ(num_across({at(-90.0, true), at(-99.0, true), at(-81.0, true)}, drift, road), 3);
  EXPECT_EQ(num_across({at(90.0, true), at(-101.0, true), at(-90.0, false)}, drift, road), 0);
}

TEST(Draws, RefusesWhatCannotBeDriven) {
  EXPECT_THROW((void)draw_endings(prepare::default_car(), drift, ego_alone(2.0, 0.9),
                                  {0.9, 5.0, 1, 1, 0, 1}),
               ContractViolation);
}

}  // namespace
}  // namespace saca::tune::draws_test
