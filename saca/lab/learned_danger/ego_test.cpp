#include "saca/lab/learned_danger/ego.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "saca/base/core/contract.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "tests/support/count_allocations.h"
#include "tests/support/scenes.h"

namespace saca::learned_danger::ego_test {
namespace {

class DrivenCar : public testing::Test {
 protected:
  [[nodiscard]] DemandDrivenCar rolling(double speed, double grip) const {
    return {car_, manoeuvre::rolling_state(car_, test::ego_alone(speed, grip).ego, grip), grip};
  }
  const manoeuvre::Car car_ = prepare::default_car();
};

// From 20 m/s on grip 0.8 a constant 7.85 m/s^2 needs 25.5 m; what passes until the brakes grip and
// the anti-lock brake finds the peak comes on top.
TEST_F(DrivenCar, StopsAsTheGripSays) {
  DemandDrivenCar driven = rolling(20.0, 0.8);
  const double start = driven.ego().X_WB.p.x;
  for (int i = 0; i < 50; ++i) {
    driven.hold({-1.0, 0.0});
  }
  EXPECT_EQ(norm(driven.ego().v_B), 0.0);
  const double way = driven.ego().X_WB.p.x - start;
  EXPECT_GT(way, 25.5);
  EXPECT_LT(way, 31.0);
}

TEST_F(DrivenCar, TellsWhatBrakesAndMotorDo) {
  DemandDrivenCar braked = rolling(20.0, 0.8);
  DemandDrivenCar driven = rolling(20.0, 0.8);
  for (int i = 0; i < 5; ++i) {
    braked.hold({-0.5, 0.0});
    driven.hold({0.3, 0.0});
  }
  EXPECT_NEAR(braked.ego().braking, -braked.ego().a_B.x, 0.4) << "drag, and the wheels' own spin";
  EXPECT_EQ(braked.ego().driving, 0.0);
  EXPECT_EQ(driven.ego().braking, 0.0);
  EXPECT_NEAR(driven.ego().driving, driven.ego().a_B.x, 0.4);
}

TEST_F(DrivenCar, NoDemandIsBeyondTheDisc) {
  DemandDrivenCar beyond = rolling(20.0, 0.8);
  DemandDrivenCar at_edge = rolling(20.0, 0.8);
  beyond.hold({-3.0, 4.0});
  at_edge.hold({-0.6, 0.8});
  EXPECT_EQ(beyond.ego().X_WB, at_edge.ego().X_WB);
}

// 20 m/s, nothing asked for: 0.4 m every 20 ms.
TEST_F(DrivenCar, TellsWhereItIsOnTheWay) {
  DemandDrivenCar driven = rolling(20.0, 0.8);
  const double start = driven.ego().X_WB.p.x;
  const PosesOnTheWay poses = driven.hold({});
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_NEAR(poses[i].p.x - start, 0.4 * static_cast<double>(i + 1), 0.02);
  }
  EXPECT_EQ(poses.back(), driven.ego().X_WB);
}

TEST_F(DrivenCar, AllocatesNothingAndRefusesWhatIsNoGrip) {
  DemandDrivenCar driven = rolling(15.0, 0.5);
  const std::size_t before = num_allocations;
  driven.hold({0.0, 1.0});
  EXPECT_EQ(num_allocations - before, 0U);
  EXPECT_THROW(std::ignore = DemandDrivenCar(car_, driven.state(), 0.1), ContractViolation);
}

}  // namespace
}  // namespace saca::learned_danger::ego_test
