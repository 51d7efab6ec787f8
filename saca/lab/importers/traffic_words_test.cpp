#include "saca/lab/importers/traffic_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace saca::importers::traffic_words_test {
namespace {

using testing::HasSubstr;
using world::ActorKind;

recordings::Obstacle body(const std::string& type, double length, double width,
                          bool dynamic = true) {
  return {.id = 1,
          .dynamic = dynamic,
          .type = type,
          .footprint = {world::Shape::box, length, width, 0.0}};
}

TEST(AssumedTrafficBody, GoesByTheWordThenBySize) {
  EXPECT_EQ(assumed_traffic_body(body("car", 4.5, 1.8)).kind, ActorKind::car);
  EXPECT_EQ(assumed_traffic_body(body("car", 5.6, 2.0)).kind, ActorKind::van);
  EXPECT_EQ(assumed_traffic_body(body("car", 19.8, 2.6)).kind, ActorKind::truck);
  EXPECT_EQ(assumed_traffic_body(body("car", 2.7, 1.3)).kind, ActorKind::motorcycle);
  EXPECT_EQ(assumed_traffic_body(body("bus", 5.0, 2.0)).kind, ActorKind::truck);
  EXPECT_EQ(assumed_traffic_body(body("bicycle", 1.8, 0.6)).kind, ActorKind::bicycle);
  EXPECT_EQ(assumed_traffic_body(body("pedestrian", 0.5, 0.5)).kind, ActorKind::pedestrian);
  EXPECT_EQ(assumed_traffic_body(body("parkedVehicle", 4.5, 1.8, false)).kind, ActorKind::car);
  EXPECT_EQ(assumed_traffic_body(body("constructionZone", 4.5, 1.8, false)).kind,
            ActorKind::obstacle);
}

TEST(AssumedTrafficBody, HeavierIsWhoIsLarger) {
  const auto mass = [](const std::string& type, double length) {
    return assumed_traffic_body(body(type, length, 1.8)).mass;
  };
  EXPECT_GT(mass("car", 19.0), mass("car", 9.0));
  EXPECT_GT(mass("car", 9.0), mass("car", 5.6));
  EXPECT_GT(mass("car", 5.6), mass("car", 4.5));
  EXPECT_GT(mass("car", 4.5), mass("motorcycle", 2.2));
  EXPECT_GT(mass("motorcycle", 2.2), mass("bicycle", 1.8));
  EXPECT_GT(mass("bicycle", 1.8), mass("pedestrian", 0.5));
}

TEST(TrafficName, IsAFileName) {
  recordings::CommonRoad file;
  file.benchmark = "USA_US101-5_1_T-1";
  EXPECT_EQ(traffic_name(file, {}), "usa_us101_5_1_t_1");
  EXPECT_EQ(traffic_name(file, {.ego = 507, .from = 1.5}), "usa_us101_5_1_t_1_ego507_from1500ms");
  file.benchmark = "\xc3\xa9 x";
  EXPECT_EQ(traffic_name(file, {}), "___x");
  EXPECT_EQ(traffic_name({}, {}), "commonroad");
}

TEST(DescribeTraffic, NamesThoseWhoMustBeNamed) {
  recordings::CommonRoad file;
  file.benchmark = "X";
  file.author = "A. Author";
  file.source = "Next Generation Simulation (NGSIM) and OpenStreetMaps (OSM)";
  scenario::Scenario scenario;
  TrafficReport report;
  report.left_out["gone before the start"] = 3;
  report.ignored["state/acceleration"] = 7;
  report.actors.push_back({"car1", 448});
  describe(scenario, file, {.ego = 12}, report);
  EXPECT_THAT(scenario.licence, HasSubstr("A. Author"));
  EXPECT_THAT(scenario.licence, HasSubstr("Federal Highway Administration"));
  EXPECT_THAT(scenario.licence, HasSubstr("OpenStreetMap contributors, ODbL"));
  EXPECT_THAT(scenario.source, HasSubstr("NGSIM"));
  EXPECT_THAT(scenario.notes, HasSubstr("takes the place of obstacle 12"));
  EXPECT_THAT(scenario.notes, HasSubstr("car1 = 448"));
  EXPECT_THAT(scenario.notes, HasSubstr("3 gone before the start"));
  EXPECT_THAT(scenario.notes, HasSubstr("7 state/acceleration"));
  file.source = "hand-made";
  describe(scenario, file, {}, report);
  EXPECT_THAT(scenario.licence, testing::Not(HasSubstr("OpenStreetMap")));
  EXPECT_THAT(scenario.notes, HasSubstr("planning problem"));
}

}  // namespace
}  // namespace saca::importers::traffic_words_test
