#include "saca/lab/recordings/commonroad.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "saca/base/core/file.h"

namespace saca::recordings::commonroad_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string small_file() {
  return read_file("saca/lab/recordings/testdata/commonroad_small.xml").value();
}

CommonRoad small() {
  const auto file = read_commonroad(small_file(), "small.xml");
  EXPECT_TRUE(file.has_value()) << file.error().message;
  return file.value();
}

// The expected values are those of the hand-written file.
TEST(ReadCommonRoad, TellsWhoWroteTheFileAndWhereItIs) {
  const CommonRoad file = small();
  EXPECT_EQ(file.benchmark, "SACA_Small-1_1_T-1");
  EXPECT_EQ(file.source, "hand-made");
  EXPECT_EQ(file.affiliation, "SACA");
  EXPECT_EQ(file.time_step, 0.1);
  EXPECT_EQ(file.latitude_deg, 48.2);
  EXPECT_EQ(file.longitude_deg, 11.6);
  EXPECT_THAT(file.tags, ElementsAre("multi_lane", "urban"));
}

TEST(ReadCommonRoad, ReadsLaneletsAndTheirNeighbours) {
  const CommonRoad file = small();
  ASSERT_EQ(file.lanelets.size(), 4U);
  const Lanelet& lanelet = file.lanelets[0];
  EXPECT_EQ(lanelet.id, 1);
  ASSERT_EQ(lanelet.left_W.size(), 2U);
  EXPECT_EQ(lanelet.left_W[1].x, 60.0);
  EXPECT_EQ(lanelet.right_W[0].y, -1.75);
  EXPECT_THAT(lanelet.successors, ElementsAre(4));
  EXPECT_EQ(lanelet.left->lanelet, 3);
  EXPECT_FALSE(lanelet.left->same_direction);
  EXPECT_TRUE(lanelet.right->same_direction);
  EXPECT_FALSE(file.lanelets[1].right.has_value());
  EXPECT_EQ(find_lanelet(file, 4), &file.lanelets[3]);
  EXPECT_EQ(find_lanelet(file, 99), nullptr);
}

TEST(ReadCommonRoad, ReadsObstaclesStatesAndProblems) {
  const CommonRoad file = small();
  ASSERT_EQ(file.obstacles.size(), 4U);  // the polygon is passed over
  const Obstacle& car = file.obstacles[0];
  EXPECT_EQ(car.id, 10);
  EXPECT_EQ(car.type, "car");
  EXPECT_TRUE(car.dynamic);
  EXPECT_EQ(car.footprint.length, 4.5);
  ASSERT_EQ(car.states.size(), 8U);
  EXPECT_EQ(car.states[6].step, 10);
  EXPECT_EQ(car.states[6].X_WO.p.x, 40.0);
  EXPECT_NEAR(car.states[7].X_WO.yaw, 0.0, 1e-12);  // a whole turn
  EXPECT_EQ(car.states[7].speed, 10.0);
  const Obstacle& box = file.obstacles[2];
  EXPECT_FALSE(box.dynamic);
  EXPECT_EQ(box.X_OA.p.x, 1.0);
  EXPECT_EQ(box.X_OA.yaw, 0.5);
  const Obstacle& pedestrian = file.obstacles[3];
  EXPECT_EQ(pedestrian.footprint.shape, world::Shape::ellipse);
  EXPECT_EQ(pedestrian.footprint.width, 0.6);
  ASSERT_EQ(file.problems.size(), 1U);
  EXPECT_EQ(file.problems[0].start.speed, 12.0);
  EXPECT_EQ(file.problems[0].start.X_WO.yaw, 0.01);
}

TEST(ReadCommonRoad, CountsWhatItPassesOver) {
  const auto& ignored = small().ignored;
  const std::map<std::string, std::size_t> expected{
      {"location/geoNameId", 1},
      {"leftBound/lineMarking", 1},
      {"lanelet/laneletType", 1},
      {"lanelet/successor (names no lanelet)", 1},
      {"state/acceleration", 1},
      {"shape/polygon", 1},
      {"commonRoad/dynamicObstacle (shape is neither one rectangle nor one circle)", 1},
      {"initialState/yawRate", 1},
      {"initialState/slipAngle", 1},
      {"planningProblem/goalState", 1}};
  EXPECT_EQ(ignored, expected);
}

struct Slip {
  std::string name;
  std::string from;  ///< the first one in the small file
  std::string to;
  std::vector<std::string> message;
};

class Slips : public testing::TestWithParam<Slip> {};

TEST_P(Slips, AreRefusedWithPlaceWantedAndGot) {
  std::string text = small_file();
  const std::size_t at = text.find(GetParam().from);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, GetParam().from.size(), GetParam().to);
  const auto file = read_commonroad(text, "small.xml");
  ASSERT_FALSE(file.has_value());
  EXPECT_THAT(file.error().message, testing::StartsWith("small.xml:"));
  for (const std::string& part : GetParam().message) {
    EXPECT_THAT(file.error().message, HasSubstr(part));
  }
}

INSTANTIATE_TEST_SUITE_P(
    ReadCommonRoad, Slips,
    testing::Values(
        Slip{"Version", "\"2020a\"", "\"2018b\"", {"small.xml:4:", "want 2020a, got `2018b`"}},
        Slip{"Prediction", "hand-made", "NGSIM and (SPOT)", {"small.xml:4:", "SPOT"}},
        Slip{"Occupancy",
             "<type>car",
             "<occupancySet/><type>car",
             {"dynamicObstacle[@id=10]/occupancySet", "set-based prediction"}},
        Slip{"Step", "timeStepSize=\"0.1\"", "timeStepSize=\"0\"", {"timeStepSize", "got `0`"}},
        Slip{"Word",
             "<x>-50</x>",
             "<x>west</x>",
             {"small.xml:12: /commonRoad/lanelet[@id=1]/leftBound/point[1]/x:",
              "want a number, got `west`"}},
        Slip{"NotANumber", "<x>-50</x>", "<x>nan</x>", {"got `nan`"}},
        Slip{"Infinite", "<x>-50</x>", "<x>1e999</x>", {"got `1e999`"}},
        Slip{"FarAway", "<x>-50</x>", "<x>1e9</x>", {"want -1e+08 to 1e+08, got `1e9`"}},
        Slip{"NoCoordinate", "<x>-50</x>", "", {"point[1]: want an element <x>, got none"}},
        Slip{"UnequalBounds", "<point><x>-50</x><y>1.75</y></point>", "", {"got 1 and 2"}},
        Slip{"Reference",
             "<successor ref=\"4\"/>",
             "<successor ref=\"four\"/>",
             {"small.xml:14: /commonRoad/lanelet[@id=1]/successor[1]: attribute ref"}},
        Slip{"Direction", "\"opposite\"", "\"left\"", {"want same or opposite, got `left`"}},
        Slip{"TwoLanelets", "<lanelet id=\"2\">", "<lanelet id=\"1\">", {"another lanelet has"}},
        Slip{"TwoObstacles",
             "<staticObstacle id=\"20\">",
             "<staticObstacle id=\"10\">",
             {"another obstacle has"}},
        Slip{"TimeOrder",
             "<time><exact>3</exact>",
             "<time><exact>2</exact>",
             {"dynamicObstacle[@id=10]/trajectory/state[3]/time",
              "want a time step after 2, got 2"}},
        Slip{"HalfStep",
             "<time><exact>3</exact>",
             "<time><exact>2.5</exact>",
             {"want a whole number of time steps, got `2.5`"}},
        Slip{"Interval",
             "<exact>10</exact></velocity>",
             "<intervalStart>9</intervalStart><intervalEnd>11</intervalEnd></velocity>",
             {"velocity: want <exact>, got <intervalStart>"}},
        Slip{"Region",
             "<point><x>31</x><y>0</y></point>",
             "<rectangle/>",
             {"position: want <point>"}},
        Slip{"NoState", "<initialState>\n", "<laterState>\n", {"small.xml"}},
        Slip{"FlatBody", "<width>1.8</width>", "<width>0</width>", {"width: want 0.001 to 100"}},
        Slip{"Root", "<commonRoad ", "<openRoad ", {"small.xml"}},
        Slip{"Latin1",
             "nobody",
             "n\xf6"
             "body",
             {"small.xml:4: byte", "want UTF-8"}},
        Slip{"HalfAPair", "nobody", "n&#xD800;", {"attribute author: want UTF-8"}},
        Slip{"Cut", "  <planningProblem", "  <", {"byte", "want XML"}}),
    [](const auto& param_info) { return param_info.param.name; });

TEST(ReadCommonRoad, RefusesAFileWithoutLanelets) {
  const auto file =
      read_commonroad("<commonRoad commonRoadVersion='2020a' timeStepSize='0.1'/>", "bare.xml");
  ASSERT_FALSE(file.has_value());
  EXPECT_THAT(file.error().message, HasSubstr("bare.xml:1: /commonRoad: want at least one"));
}

TEST(ReadCommonRoad, RefusesEmptyBytes) {
  EXPECT_FALSE(read_commonroad("", "nothing.xml").has_value());
  EXPECT_FALSE(read_commonroad(std::string(300, '\xff'), "bytes.xml").has_value());
}

// A recording cut anywhere is told, never half read.
TEST(ReadCommonRoad, RefusesEveryCut) {
  const std::string text = small_file();
  for (std::size_t size = 0; size + 2 < text.size(); size += 97) {
    EXPECT_FALSE(read_commonroad(text.substr(0, size), "cut.xml").has_value()) << size;
  }
}

}  // namespace
}  // namespace saca::recordings::commonroad_test
