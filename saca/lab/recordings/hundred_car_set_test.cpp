#include "saca/lab/recordings/hundred_car_set.h"

#include <gtest/gtest.h>

#include <cmath>

namespace saca::recordings::hundred_car_set_test {
namespace {

/// Steady at 20 m/s in a lane of 3.6 m, 0.3 m to the left of its centre.
std::vector<HundredCarRow> steady_rows(std::size_t size) {
  std::vector<HundredCarRow> rows(size);
  for (std::size_t k = 0; k < size; ++k) {
    rows[k].sync = static_cast<std::int64_t>(k);
    rows[k].speed = 20.0;
    rows[k].yaw_rate = 0.01;
    rows[k].acceleration = -0.2;
    rows[k].left_mark = 1.5;
    rows[k].right_mark = -2.1;
    rows[k].mark_trust = 1024.0;
  }
  return rows;
}

Recording made_of(const std::vector<HundredCarRow>& rows) {
  std::map<std::string, std::size_t> skipped;
  return recording_of_event(rows, {.vehicle = 1038}, "8296", skipped);
}

std::vector<Sample> samples_made_of(const std::vector<HundredCarRow>& rows) {
  return made_of(rows).vehicles.at(0).samples;
}

TEST(HundredCarSet, TellsWhatTheCarMeasured) {
  std::vector<HundredCarRow> rows = steady_rows(20);
  rows[4].brake = true;
  rows[5].brake_known = false;
  const Recording recording = made_of(rows);
  EXPECT_EQ(recording.site, "100car");
  EXPECT_EQ(recording.group, "100car-1038");
  EXPECT_EQ(recording.vehicles.at(0).id, 1038);
  const std::vector<Sample>& samples = recording.vehicles.at(0).samples;
  ASSERT_EQ(samples.size(), 20U);
  EXPECT_EQ(samples[3].speed, 20.0);
  EXPECT_EQ(samples[3].measured_yaw_rate, 0.01);
  EXPECT_EQ(samples[3].measured_acceleration, -0.2);
  EXPECT_EQ(samples[3].brake_pedal, 0.0);
  EXPECT_EQ(samples[4].brake_pedal, 1.0);
  EXPECT_TRUE(std::isnan(samples[5].brake_pedal));
  EXPECT_TRUE(std::isnan(samples[3].X_WA.p.x));
  EXPECT_TRUE(std::isnan(samples[3].throttle));
}

TEST(HundredCarSet, MeasuresTheOffsetFromTheMiddleOfTheMarks) {
  const Sample sample = samples_made_of(steady_rows(20))[7];
  EXPECT_NEAR(sample.offset, 0.3, 1e-12);  // nearer to the left mark
  EXPECT_NEAR(sample.lane_width, 3.6, 1e-12);
}

TEST(HundredCarSet, BelievesOnlyMarksThatAreSure) {
  std::vector<HundredCarRow> rows = steady_rows(20);
  rows[2].mark_trust = 300.0;
  rows[3].left_mark = 0.2;  // a lane of 2.3 m
  rows[4].left_mark = 3.0;  // of 5.1 m
  rows[5].left_mark = not_known;
  rows[6].left_mark = -0.5;  // a lane of the usual width, but the car is 0.5 m outside
  rows[6].right_mark = -4.1;
  const std::vector<Sample> samples = samples_made_of(rows);
  for (const std::size_t k : {2U, 3U, 4U, 5U, 6U}) {
    EXPECT_TRUE(std::isnan(samples[k].offset)) << k;
    EXPECT_TRUE(std::isnan(samples[k].lane_width)) << k;
  }
  EXPECT_FALSE(std::isnan(samples[7].offset));
}

/// Moves to one side by 0.2 m a row, over the mark into the next lane.
std::vector<HundredCarRow> crossing_rows(double side) {
  std::vector<HundredCarRow> rows = steady_rows(30);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    double offset = 0.2 * (static_cast<double>(k) - 5.0);
    offset -= offset > 1.8 ? 3.6 : 0.0;
    rows[k].left_mark = 1.8 - side * offset;
    rows[k].right_mark = -1.8 - side * offset;
  }
  return rows;
}

TEST(HundredCarSet, AJumpToTheOtherSideIsALaneStep) {
  for (const int side : {1, -1}) {
    std::vector<HundredCarRow> rows = crossing_rows(side);
    for (const std::size_t k : {14U, 15U}) {
      rows[k].mark_trust = 0.0;  // as on a mark
    }
    const std::vector<Sample> samples = samples_made_of(rows);
    for (std::size_t k = 0; k < samples.size(); ++k) {
      EXPECT_EQ(samples[k].lane_step, k == 16 ? side : 0) << k;
    }
  }
}

TEST(HundredCarSet, AJumpAfterLongBlindnessIsNone) {
  std::vector<HundredCarRow> rows = crossing_rows(1.0);
  for (std::size_t k = 11; k < 17; ++k) {
    rows[k].mark_trust = 0.0;
  }
  for (const Sample& sample : samples_made_of(rows)) {
    EXPECT_EQ(sample.lane_step, 0);
  }
}

// Which target is the lead is told by the conflict that comes: hindsight.
TEST(HundredCarSet, TellsNoLead) {
  std::vector<HundredCarRow> rows = steady_rows(40);
  for (HundredCarRow& row : rows) {
    row.front.push_back({.id = 5, .range = 50.0, .rate = -5.0, .azimuth = 0.0});
  }
  for (const Sample& sample : samples_made_of(rows)) {
    EXPECT_TRUE(std::isnan(sample.gap));
    EXPECT_TRUE(std::isnan(sample.lead_speed));
  }
}

TEST(HundredCarSet, RowsWithoutSpeedSplitTheTrack) {
  std::vector<HundredCarRow> rows = steady_rows(45);
  rows[12].speed = not_known;
  rows[20].speed = not_known;
  std::map<std::string, std::size_t> skipped;
  const Recording recording = recording_of_event(rows, {.vehicle = 3}, "x", skipped);
  ASSERT_EQ(recording.vehicles.size(), 2U);
  EXPECT_EQ(recording.vehicles[0].samples.size(), 12U);
  EXPECT_NEAR(recording.vehicles[1].start, 2.1, 1e-12);
  EXPECT_EQ(recording.vehicles[1].samples.size(), 24U);
  EXPECT_EQ(skipped.at("vehicle: fewer than 10 samples on end"), 1U);
  EXPECT_TRUE(made_of({}).vehicles.empty());
}

}  // namespace
}  // namespace saca::recordings::hundred_car_set_test
