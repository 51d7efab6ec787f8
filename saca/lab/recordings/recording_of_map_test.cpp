#include "saca/lab/recordings/recording_of_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace saca::recordings::recording_of_map_test {
namespace {

/// One lane of 400 m along x, and one to its left.
CommonRoad long_road() {
  CommonRoad file{.benchmark = "USA_Lanker-1_2_T-1"};
  for (const std::int64_t id : {1, 2}) {
    const double y = id == 1 ? 0.0 : 3.5;
    Lanelet lanelet{.id = id};
    for (int k = 0; k <= 40; ++k) {
      lanelet.left_W.push_back({10.0 * k, y + 1.75});
      lanelet.right_W.push_back({10.0 * k, y - 1.75});
    }
    file.lanelets.push_back(lanelet);
  }
  file.lanelets[0].left = Neighbour{2, true};
  file.lanelets[1].right = Neighbour{1, true};
  return file;
}

/// Drives along x at 10 m/s, 4 m long.
Obstacle car_from(std::int64_t id, double x, double y, std::int64_t first = 0, int size = 20) {
  Obstacle car{.id = id, .type = "car", .footprint = {world::Shape::box, 4.0, 2.0, 0.0}};
  for (int k = 0; k < size; ++k) {
    car.states.push_back({first + k, {{x + k, y}, 0.0}, 10.0});
  }
  return car;
}

Recording made_of(const CommonRoad& file) {
  std::map<std::string, std::size_t> skipped;
  return recording_of_map(file, "a.xml", skipped);
}

TEST(RecordingOfMap, TellsSiteStepAndSizes) {
  CommonRoad file = long_road();
  file.obstacles = {car_from(3, 10.0, 0.5)};
  const Recording recording = made_of(file);
  EXPECT_EQ(recording.name, "a.xml");
  EXPECT_EQ(recording.site, "lankershim");
  EXPECT_EQ(recording.step, 0.1);
  ASSERT_EQ(recording.vehicles.size(), 1U);
  const RecordedVehicle& car = recording.vehicles[0];
  EXPECT_EQ(car.id, 3);
  EXPECT_EQ(car.length, 4.0);
  ASSERT_EQ(car.samples.size(), 20U);
  EXPECT_NEAR(car.samples[5].X_WA.p.x, 15.0, 1e-12);
  EXPECT_NEAR(car.samples[5].offset, 0.5, 1e-9);
  EXPECT_EQ(car.samples[5].speed, 10.0);
  EXPECT_TRUE(car.samples[5].left_lane);
  EXPECT_FALSE(car.samples[5].right_lane);
  EXPECT_TRUE(std::isnan(car.samples[5].brake_pedal));
}

TEST(RecordingOfMap, TakesTheShapesCentre) {
  CommonRoad file = long_road();
  file.obstacles = {car_from(3, 10.0, 0.0)};
  file.obstacles[0].X_OA.p = {1.5, 0.25};
  const Sample sample = made_of(file).vehicles.at(0).samples.at(0);
  EXPECT_NEAR(sample.X_WA.p.x, 11.5, 1e-12);
  EXPECT_NEAR(sample.offset, 0.25, 1e-9);
}

TEST(RecordingOfMap, MeasuresTheGapFromBumperToBumper) {
  CommonRoad file = long_road();
  file.obstacles = {car_from(1, 10.0, 0.0), car_from(2, 70.0, 0.4), car_from(3, 40.0, 3.5),
                    car_from(4, 90.0, 0.0)};
  file.obstacles[1].states[7].speed = 8.0;
  const Recording recording = made_of(file);
  const Sample& sample = recording.vehicles[0].samples[7];
  EXPECT_NEAR(sample.gap, 60.0 - 4.0, 1e-9);  // number 3 is in the other lane, 4 farther
  EXPECT_EQ(sample.lead_speed, 8.0);
  EXPECT_EQ(recording.vehicles[2].samples[0].gap, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(recording.vehicles[2].samples[0].lead_speed));
}

TEST(RecordingOfMap, KnowsNoGapWhereTheMapEnds) {
  CommonRoad file = long_road();
  file.obstacles = {car_from(1, 320.0, 0.0), car_from(2, 10.0, 0.0, 5)};
  const Recording recording = made_of(file);
  EXPECT_TRUE(std::isnan(recording.vehicles[0].samples[0].gap));
  // Somebody who is too far ahead is nobody.
  EXPECT_EQ(recording.vehicles[1].samples[0].gap, std::numeric_limits<double>::infinity());
}

TEST(RecordingOfMap, SeesOnlyWhoIsThereAtThatTime) {
  CommonRoad file = long_road();
  file.obstacles = {car_from(1, 10.0, 0.0), car_from(2, 50.0, 0.0, 15)};
  const Recording recording = made_of(file);
  EXPECT_TRUE(std::isinf(recording.vehicles[0].samples[14].gap));
  EXPECT_NEAR(recording.vehicles[0].samples[15].gap, 50.0 - 25.0 - 4.0, 1e-9);
}

TEST(RecordingOfMap, AGapInTimeSplitsATrack) {
  CommonRoad file = long_road();
  Obstacle car = car_from(1, 10.0, 0.0, 0, 30);
  car.states.erase(car.states.begin() + 12);
  file.obstacles = {car};
  std::map<std::string, std::size_t> skipped;
  const Recording recording = recording_of_map(file, "a.xml", skipped);
  ASSERT_EQ(recording.vehicles.size(), 2U);
  EXPECT_EQ(recording.vehicles[0].samples.size(), 12U);
  EXPECT_EQ(recording.vehicles[1].samples.size(), 17U);
  EXPECT_NEAR(recording.vehicles[1].start, 1.3, 1e-12);
  EXPECT_TRUE(skipped.empty());
}

TEST(RecordingOfMap, CountsWhatItLeavesOut) {
  CommonRoad file = long_road();
  file.obstacles = {car_from(1, 10.0, 0.0, 0, 9), car_from(2, 50.0, 0.0, 0, 1)};
  file.obstacles[1].dynamic = false;
  std::map<std::string, std::size_t> skipped;
  EXPECT_TRUE(recording_of_map(file, "a.xml", skipped).vehicles.empty());
  EXPECT_EQ(skipped.at("vehicle: fewer than 10 samples on end"), 1U);
  EXPECT_EQ(skipped.at("static obstacle"), 1U);
}

TEST(RecordingOfMap, ASlitBetweenLanesHidesNoLaneChange) {
  CommonRoad file = long_road();
  for (Vec2& p_W : file.lanelets[1].right_W) {
    p_W.y += 0.7;  // from 1.75 to 2.45 there is no lane
  }
  Obstacle car = car_from(1, 10.0, 0.0);
  for (std::size_t k = 0; k < car.states.size(); ++k) {
    car.states[k].X_WO.p.y = 0.2 * static_cast<double>(k);
  }
  file.obstacles = {car};
  const RecordedVehicle vehicle = made_of(file).vehicles.at(0);
  int steps = 0;
  for (const Sample& sample : vehicle.samples) {
    steps += sample.lane_step;
  }
  EXPECT_EQ(steps, 1);
  EXPECT_TRUE(std::isnan(vehicle.samples[11].offset));  // y = 2.2: beyond the hold, in no lane
  EXPECT_EQ(vehicle.samples[13].lane_step, 1);          // y = 2.6
}

TEST(RecordingOfMap, KnowsOfALostBodyOnlyItsMotion) {
  CommonRoad file = long_road();
  file.obstacles = {car_from(1, 10.0, -20.0)};
  const Sample sample = made_of(file).vehicles.at(0).samples.at(3);
  EXPECT_TRUE(std::isnan(sample.offset));
  EXPECT_TRUE(std::isnan(sample.gap));
  EXPECT_EQ(sample.speed, 10.0);
  EXPECT_NEAR(sample.X_WA.p.y, -20.0, 1e-12);
}

TEST(RecordingOfMap, NamesASiteEvenWithoutABenchmark) {
  CommonRoad file = long_road();
  file.obstacles = {car_from(1, 10.0, 0.0)};
  file.benchmark = "";
  EXPECT_EQ(made_of(file).site, "unknown");
  file.benchmark = "USA_US101-3_1_T-1";
  EXPECT_EQ(made_of(file).site, "us101");
}

}  // namespace
}  // namespace saca::recordings::recording_of_map_test
