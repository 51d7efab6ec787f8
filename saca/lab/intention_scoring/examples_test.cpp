#include "saca/lab/intention_scoring/examples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "saca/base/core/contract.h"
#include "saca/thinking/intent/intention.h"

namespace saca::intention_scoring::examples_test {
namespace {

using intent::Intention;

/// 10 s straight on at 20 m/s in the middle of a lane of 3.5 m.
recordings::RecordedVehicle cruising() {
  recordings::RecordedVehicle vehicle{.id = 7, .type = "car", .length = 4.5, .width = 1.8};
  for (int i = 0; i <= 100; ++i) {
    recordings::Sample sample;
    sample.X_WA = {{2.0 * i, 0.0}, 0.0};
    sample.speed = 20.0;
    sample.offset = 0.0;
    sample.heading = 0.0;
    sample.lane_width = 3.5;
    sample.curvature = 0.0;
    sample.gap = std::numeric_limits<double>::infinity();
    vehicle.samples.push_back(sample);
  }
  return vehicle;
}

/// Crosses into the next lane to the left between 3 and 7 s.
recordings::RecordedVehicle changing() {
  recordings::RecordedVehicle vehicle = cruising();
  double last = 0.0;
  for (std::size_t i = 0; i < vehicle.samples.size(); ++i) {
    const double share = std::clamp((0.1 * static_cast<double>(i) - 3.0) / 4.0, 0.0, 1.0);
    const double way = 3.5 * share * share * (3.0 - 2.0 * share);
    vehicle.samples[i].offset = way < 1.75 ? way : way - 3.5;
    vehicle.samples[i].lane_step = last < 1.75 && way >= 1.75 ? 1 : 0;
    last = way;
  }
  return vehicle;
}

recordings::RecordedSet set_of(recordings::RecordedVehicle vehicle) {
  return {.recordings = {{.name = "a.xml",
                          .site = "here",
                          .group = "here 1",
                          .step = 0.1,
                          .vehicles = {std::move(vehicle)}}},
          .skipped = {}};
}

TEST(Examples, ALaneChangeIsOneAcrossTheLine) {
  const auto sequences = examples_of(set_of(changing()));
  ASSERT_EQ(sequences.size(), 1U);
  const Sequence& one = sequences[0];
  EXPECT_EQ(one.name, "a.xml/7@0.0");
  EXPECT_EQ(one.group, "here 1/0");
  ASSERT_EQ(one.crossing_times.size(), 1U);
  EXPECT_NEAR(one.crossing_times[0], 5.0, 1e-9);
  EXPECT_EQ(one.labels[50], static_cast<std::uint8_t>(Intention::lane_left));
  EXPECT_EQ(one.labels[62], static_cast<std::uint8_t>(Intention::lane_left));  // beyond the line
  EXPECT_EQ(one.labels[20], static_cast<std::uint8_t>(Intention::maintain));
  EXPECT_EQ(one.labels[90], static_cast<std::uint8_t>(Intention::maintain));
}

TEST(Examples, BrakingIsSeenHalfASecondLateAndLabelledInTime) {
  recordings::RecordedVehicle vehicle = cruising();
  double way = 0.0;
  for (std::size_t i = 0; i < vehicle.samples.size(); ++i) {  // 4 m/s^2 from 5 to 7 s
    const double speed = 20.0 - 4.0 * std::clamp(0.1 * static_cast<double>(i) - 5.0, 0.0, 2.0);
    vehicle.samples[i].speed = speed;
    vehicle.samples[i].X_WA.p.x = way;
    way += 0.1 * (speed - (i >= 50 && i < 70 ? 0.2 : 0.0));
  }
  const auto seen = observations_of(vehicle, 0.1);
  EXPECT_NEAR(seen[55].acceleration, -4.0, 1e-9);
  EXPECT_EQ(seen[50].acceleration, 0.0);  // nothing looks ahead
  EXPECT_LT(seen[51].acceleration, 0.0);
  const TrueMotion motion = true_motion(vehicle, 0.1);
  EXPECT_NEAR(motion.acceleration[60], -4.0, 0.6);  // smoothed over about a second
  const auto sequences = examples_of(set_of(vehicle));
  EXPECT_EQ(sequences[0].labels[60], static_cast<std::uint8_t>(Intention::brake));
  ASSERT_EQ(sequences[0].braking_times.size(), 1U);
  EXPECT_NEAR(sequences[0].braking_times[0], 5.0, 0.21);  // half of it, where it begins
}

TEST(Examples, TheAccelerometerIsBelievedWhereThereIsOne) {
  recordings::RecordedVehicle vehicle = cruising();
  for (std::size_t i = 0; i < vehicle.samples.size(); ++i) {  // the speedometer stands for a second
    vehicle.samples[i].measured_acceleration = -1.0;
    vehicle.samples[i].speed = 20.0 - static_cast<double>(i / 10);
  }
  EXPECT_NEAR(true_motion(vehicle, 0.1).acceleration[50], -1.0, 1e-9);
  const auto seen = observations_of(vehicle, 0.1);
  for (std::size_t i = 20; i < seen.size(); ++i) {
    EXPECT_NEAR(seen[i].acceleration, -1.0, 0.6) << i;  // held speeds alone: 0 or -3
    EXPECT_NEAR(seen[i].speed, 20.0 - 0.1 * static_cast<double>(i), 1.0) << i;
  }
}

TEST(Examples, TurningIsTheDifferenceOfHeadings) {
  recordings::RecordedVehicle vehicle = cruising();
  for (std::size_t i = 0; i < vehicle.samples.size(); ++i) {
    vehicle.samples[i].X_WA.yaw = wrap_angle(3.0 + 0.02 * static_cast<double>(i));  // over pi
  }
  const auto seen = observations_of(vehicle, 0.1);
  EXPECT_EQ(seen[0].yaw_rate, 0.0);
  EXPECT_NEAR(seen[3].yaw_rate, 0.2, 1e-9);
  EXPECT_NEAR(seen[50].yaw_rate, 0.2, 1e-9);
  vehicle.samples[50].measured_yaw_rate = 0.1;
  EXPECT_EQ(observations_of(vehicle, 0.1)[50].yaw_rate, 0.1);
}

TEST(Examples, OffTheLanesNothingIsToldAgainstThem) {
  recordings::RecordedVehicle vehicle = changing();
  for (std::size_t i = 40; i < 45; ++i) {
    vehicle.samples[i].offset = recordings::not_known;
    vehicle.samples[i].lane_step = 0;
  }
  const auto seen = observations_of(vehicle, 0.1);
  EXPECT_TRUE(std::isnan(seen[42].lateral_speed));
  EXPECT_EQ(seen[45].lateral_speed, 0.0);  // begins anew
  EXPECT_GT(seen[46].lateral_speed, 0.5);
  EXPECT_TRUE(std::isnan(true_motion(vehicle, 0.1).lateral[42]));
}

TEST(Examples, AreOnlyOfVehiclesSeenLongEnoughAtOurStep) {
  recordings::RecordedVehicle vehicle = cruising();
  vehicle.samples.resize(19);
  EXPECT_TRUE(examples_of(set_of(vehicle)).empty());
  recordings::RecordedSet set = set_of(cruising());
  set.recordings[0].step = 0.04;
  EXPECT_THROW((void)examples_of(set), ContractViolation);
}

}  // namespace
}  // namespace saca::intention_scoring::examples_test
