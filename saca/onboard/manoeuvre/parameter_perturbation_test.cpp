#include "saca/onboard/manoeuvre/parameter_perturbation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saca/lab/prepare/shipped_cars_for_test.h"

namespace saca::manoeuvre::parameter_perturbation_test {
namespace {

TEST(ParameterPerturbation, HasTheSpreadsThatItNames) {
  std::mt19937_64 rng(5);
  constexpr int n = 20'000;
  double sum = 0.0;
  double squares = 0.0;
  double lag_squares = 0.0;
  double product = 0.0;
  for (int i = 0; i < n; ++i) {
    const ParameterPerturbation perturbation = draw(rng);
    sum += perturbation.grip - 1.0;
    squares += (perturbation.grip - 1.0) * (perturbation.grip - 1.0);
    lag_squares += perturbation.lag * perturbation.lag;
    product += (perturbation.grip - 1.0) * (perturbation.mass - 1.0);
    ASSERT_LE(std::abs(perturbation.grip - 1.0), 3.0 * perturbation_sd.grip + 1e-12);
  }
  // Taking draws beyond three sd as three of them makes the variance 0.7 % smaller.
  EXPECT_NEAR(sum / n, 0.0, 4.0 * perturbation_sd.grip / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), 0.06, 0.002);
  EXPECT_NEAR(std::sqrt(lag_squares / n), 0.010, 0.0004);
  EXPECT_NEAR(product / n, 0.0, 4.0 * 0.06 * 0.03 / std::sqrt(n));
}

TEST(ParameterPerturbation, NeverMakesACarTooStiffForItsSteps) {
  Car light = prepare::default_car();
  light.front_wheel_inertia *= 1.02 * vehicle::usual_step / vehicle::longest_step(light);
  EXPECT_GE(vehicle::longest_step(light), vehicle::usual_step);
  EXPECT_GE(vehicle::longest_step(real_car(light, {.mass = 1.09, .stiffness = 1.3})),
            vehicle::usual_step * (1.0 - 1e-12));
}

TEST(ParameterPerturbation, SameSeedSameDraws) {
  std::mt19937_64 a(7);
  std::mt19937_64 b(7);
  EXPECT_EQ(draw(a).speed, draw(b).speed);
  EXPECT_NE(draw(a).speed, draw(a).speed);
}

TEST(ParameterPerturbation, ChangesTheCarAndNothingUnknownLeavesIt) {
  const Car car = prepare::default_car();
  const vehicle::Vehicle real = real_car(car, {.mass = 1.1, .lag = -0.2});
  EXPECT_DOUBLE_EQ(real.mass, 1.1 * car.mass);
  EXPECT_GT(real.brake_lag, 0.0);
  EXPECT_EQ(real_car(car, {}).tyre.stiffness, car.tyre.stiffness);
}

}  // namespace
}  // namespace saca::manoeuvre::parameter_perturbation_test
