#include "saca/lab/tune/fit_drive.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"

namespace saca::tune::fit_drive_test {
namespace {

const Series& series_named(const Log& log, Signal signal) {
  for (const Series& series : log.measured) {
    if (series.signal == signal) {
      return series;
    }
  }
  throw std::out_of_range("no such signal");
}

TEST(TestDriveLog, OfAnAntiLockStopDeceleratesWithNearlyTheGrip) {
  const Log log =
      drive_test(prepare::default_vehicle(), {.speed = 20.0, .grip = 0.5, .noise = 0.0});
  double hardest = 0.0;
  for (const double a_x : series_named(log, Signal::a_x).values) {
    hardest = std::max(hardest, -a_x);
  }
  EXPECT_NEAR(hardest, 0.5 * vehicle::gravity, 0.1 * 0.5 * vehicle::gravity);
  EXPECT_LT(log.measured.front().values.back(), 1.0);
}

TEST(TestDriveLog, OfAStepTurnsAsSteadyTurningDoes) {
  const double steering = 0.02;
  const Log log = drive_test(prepare::default_vehicle(),
                             {.kind = TestKind::steer, .steering = steering, .noise = 0.0});
  const double yaw_rate = series_named(log, Signal::yaw_rate).values.back();
  const double speed = log.measured.front().values.back();
  // In a steady turn a_y is v times yaw rate.
  EXPECT_NEAR(series_named(log, Signal::a_y).values.back() / (speed * yaw_rate), 1.0, 0.02);
  EXPECT_GT(yaw_rate, 0.0);
  EXPECT_EQ(log.command[log.event - 1].steering, 0.0);
  EXPECT_EQ(log.command[log.event].steering, steering);
}

TEST(TestDriveLog, HasTheNoiseThatWasAskedForAndTheSameForTheSameSeed) {
  const vehicle::Vehicle car = prepare::default_vehicle();
  const Log clean = drive_test(car, {.kind = TestKind::steer, .noise = 0.0});
  const Log noisy = drive_test(car, {.kind = TestKind::steer, .noise = 2.0, .seed = 3});
  const Log again = drive_test(car, {.kind = TestKind::steer, .noise = 2.0, .seed = 3});
  double sum = 0.0;
  const std::size_t rows = clean.time.size();
  for (std::size_t row = 0; row < rows; ++row) {
    const double error = noisy.measured[0].values[row] - clean.measured[0].values[row];
    sum += error * error;
    EXPECT_EQ(noisy.measured[0].values[row], again.measured[0].values[row]);
  }
  const double sd = 2.0 * info(Signal::speed).typical_noise;
  // Four sd of an estimate from so many rows.
  EXPECT_NEAR(std::sqrt(sum / static_cast<double>(rows)), sd,
              4.0 * sd / std::sqrt(2.0 * static_cast<double>(rows)));
}

TEST(TestDriveLog, RefusesWhatNobodyDrives) {
  const vehicle::Vehicle car = prepare::default_vehicle();
  EXPECT_THROW((void)drive_test(car, {.speed = 0.0}), ContractViolation);
  EXPECT_THROW((void)drive_test(car, {.grip = NAN}), ContractViolation);
  EXPECT_THROW((void)drive_test(car, {.interval = 0.1}), ContractViolation);
}

}  // namespace
}  // namespace saca::tune::fit_drive_test
