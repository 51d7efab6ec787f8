#include "saca/lab/eval/traffic_drives.h"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <set>

#include "saca/base/core/file.h"
#include "saca/lab/eval/scenes_for_test.h"

namespace saca::eval::traffic_drives_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string state(const char* name, int step, double x, double y, double speed) {
  return fmt::format(
      "<{0}><position><point><x>{1}</x><y>{2}</y></point></position><orientation><exact>0</exact>"
      "</orientation><time><exact>{3}</exact></time><velocity><exact>{4}</exact></velocity></{0}>",
      name, x, y, step, speed);
}

/// At a constant speed along x.
std::string car(int id, double x, double y, double speed, int num_steps) {
  std::string text = fmt::format(
      "<dynamicObstacle id=\"{}\"><type>car</type><shape><rectangle><length>4.0</length>"
      "<width>1.8</width></rectangle></shape>{}<trajectory>",
      id, state("initialState", 0, x, y, speed));
  for (int k = 1; k <= num_steps; ++k) {
    text += state("state", k, x + 0.1 * speed * k, y, speed);
  }
  return text + "</trajectory></dynamicObstacle>";
}

/// One lane along x, 3.5 m wide, and what is on it.
std::string road(const std::string& cars) {
  return "<commonRoad commonRoadVersion=\"2020a\" benchmarkID=\"USA_US101-1_1_T-1\" "
         "source=\"recorded\" timeStepSize=\"0.1\" author=\"\" affiliation=\"\"><location>"
         "<gpsLatitude>999</gpsLatitude><gpsLongitude>999</gpsLongitude></location>"
         "<lanelet id=\"1\"><leftBound><point><x>0</x><y>1.75</y></point><point><x>600</x>"
         "<y>1.75</y></point></leftBound><rightBound><point><x>0</x><y>-1.75</y></point><point>"
         "<x>600</x><y>-1.75</y></point></rightBound></lanelet>" +
         cars + "</commonRoad>";
}

class TrafficDrives : public testing::Test {
 protected:
  TrafficDrives() : folder_(fs::path(testing::TempDir()) / "saca_traffic_drives") {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "deeper");
  }
  void write(const std::string& name, const std::string& text) const {
    ASSERT_FALSE(write_file(folder_ / name, text).has_value());
  }
  [[nodiscard]] Result<FoundDrives> found(std::size_t most = 100, std::uint64_t seed = 1) const {
    return traffic_drives({folder_}, most, seed, [] { return true; });
  }
  fs::path folder_;
};

/// Twelve in a queue for 9 s; ids from 95 on.
std::string queue(int num_steps = 90) {
  std::string cars;
  for (int i = 0; i < 12; ++i) {
    cars += car(95 + i, 20.0 + 20.0 * i, 0.0, 10.0, num_steps);
  }
  return road(cars);
}

TEST_F(TrafficDrives, AreOfEachCarOnceInGroupsOfAHundredIds) {
  write("deeper/one.xml", queue());
  const auto all = found().value().drives;
  std::set<std::int64_t> ids;
  std::set<std::string> groups;
  for (const TrafficDrive& drive : all) {
    ids.insert(drive.obstacle);
    groups.insert(drive.group);
    EXPECT_EQ(drive.site, "us101");
    EXPECT_NEAR(drive.seconds, 9.0, 1e-9);
  }
  EXPECT_EQ(all.size(), 12U);
  EXPECT_EQ(ids.size(), 12U);
  EXPECT_EQ(groups.size(), 2U);  // 95 to 99, 100 to 106
}

TEST_F(TrafficDrives, AreDrawnBySeed) {
  write("one.xml", queue());
  const auto ids = [this](std::size_t most, std::uint64_t seed) {
    std::vector<std::int64_t> all;
    for (const TrafficDrive& drive : found(most, seed).value().drives) {
      all.push_back(drive.obstacle);
    }
    return all;
  };
  const auto everybody = ids(100, 1);
  EXPECT_EQ(ids(100, 1), everybody);
  EXPECT_NE(ids(100, 2), everybody);
  EXPECT_EQ(ids(3, 1), std::vector(everybody.begin(), everybody.begin() + 3));
}

TEST_F(TrafficDrives, WhatCannotBeReadIsRefused) {
  EXPECT_THAT(found().error().message, HasSubstr("want"));
  write("one.xml", queue());
  write("deeper/one.xml", queue());
  EXPECT_THAT(found().error().message, HasSubstr("want each file once"));
  write("deeper/one.xml", "<commonRoad");
  fs::remove(folder_ / "one.xml");
  EXPECT_THAT(found().error().message, HasSubstr("one.xml"));
  EXPECT_THAT(traffic_drives({folder_ / "nosuch"}, 1, 1, [] { return true; }).error().message,
              HasSubstr("nosuch"));
  EXPECT_EQ(traffic_drives({folder_}, 1, 1, [] { return false; }).error().code,
            Error::Code::too_late);
}

// Recorded for 9 s: forecasts are made from 1.7 s on, when tracks are settled, and hold until 1.2 s
// before the end; notes every 0.5 s. So from 2.0 to 9.0 - 1.2 - 3.0 = 4.8 s: six of each that is
// perceived on the fitted road.
TEST_F(TrafficDrives, GiveForecastsOfTheOthersWhereTheyAreKnown) {
  write("one.xml", road(car(7, 30.0, 0.0, 10.0, 90) + car(8, 60.0, 0.0, 10.0, 90)));
  for (const TrafficDrive& drive : found().value().drives) {
    const PlayedDrive played = played_drive(drive).value();
    const manoeuvre::Car ego = prepare::default_car();
    const collision::HarmModel harm = shipped_harm();
    const encounter::Stage stage{&played.scenario, &ego, &harm, &intent::shipped_model(), {}, {}};
    const auto samples = forecast_samples(stage, shipped_models(), played.window).value();
    ASSERT_EQ(samples.size(), 6U);
    EXPECT_NEAR(samples.front().time, 2.0, 1e-9);
    for (const ForecastSample& one : samples) {
      EXPECT_FALSE(one.acts);
      EXPECT_LT(one.scores[0].back().miss, 0.05);
    }
  }
}

TEST_F(TrafficDrives, TooShortOnesAreRefused) {
  write("one.xml", road(car(7, 30.0, 0.0, 10.0, 50) + car(8, 60.0, 0.0, 10.0, 50)));
  const auto played = played_drive(found().value().drives.front());
  ASSERT_FALSE(played.has_value());
  EXPECT_THAT(played.error().message, HasSubstr("too short to hold a forecast against"));
}

}  // namespace
}  // namespace saca::eval::traffic_drives_test
