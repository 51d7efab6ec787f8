#include "saca/lab/importers/import_json.h"

#include <gmock/gmock.h>

#include <numbers>

namespace saca::importers::import_json_test {
namespace {

using nlohmann::json;

TEST(AReleasesDocument, TellsOfEachEventWhatItBecameOrWhyNot) {
  HundredCarImport rebuilt;
  rebuilt.scenario.name = "hundred_car_4711";
  rebuilt.report.first_row = 3;
  rebuilt.report.last_row = 170;
  rebuilt.report.gyro_bias = std::numbers::pi / 180.0;  // [rad/s]
  rebuilt.report.curvature = 0.002;
  rebuilt.report.kept_for = 8.0;
  rebuilt.report.keeping_rms = 0.125;
  const json document = import_json(std::vector<HundredCarOutcome>{
      {.event = 4711, .severity = "Crash", .made = rebuilt},
      {.event = 4712,
       .severity = "",
       .made = HundredCarRefusal{HundredCarReason::no_lead, "event 4712: want a lead"}},
      {.event = 4713,
       .severity = "Near-Crash",
       .made = HundredCarRefusal{HundredCarReason::no_lead, "event 4713: want a lead"}}});
  EXPECT_EQ(document["schema"], "saca.hundred_car_import/1");
  EXPECT_EQ(document["events"], 3);
  EXPECT_EQ(document["rebuilt"], 1);
  EXPECT_EQ(document["refused"], (json{{"no_lead", 2}}));
  json made = document["list"][0];
  EXPECT_NEAR(made["gyro_bias_degps"].get<double>(), 1.0, 1e-12);
  made.erase("gyro_bias_degps");
  EXPECT_EQ(made, (json{{"event", 4711},
                        {"severity", "Crash"},
                        {"scenario", "hundred_car_4711"},
                        {"first_row", 3},
                        {"last_row", 170},
                        {"curvature_1pm", 0.002},
                        {"lane_kept_s", 8.0},
                        {"lane_rms_m", 0.125}}));
  EXPECT_EQ(document["list"][1], (json{{"event", 4712},
                                       {"severity", ""},
                                       {"refused", "no_lead"},
                                       {"message", "event 4712: want a lead"}}));
}

TEST(AReleasesDocument, OfNoEventIsEmpty) {
  const json document = import_json(std::vector<HundredCarOutcome>());
  EXPECT_EQ(document["refused"], json::object());
  EXPECT_EQ(document["list"], json::array());
}

TEST(ATrafficsDocument, TellsOfLaneSmoothingAndWhomItHolds) {
  TrafficImport made;
  made.scenario.name = "test_1";
  made.scenario.duration = 6.5;
  made.report.from = 1.5;
  made.report.origin_W = {10.0, -20.0};
  made.report.lane.lanelets = {4, 5};
  made.report.lane.behind = 20.0;
  made.report.lane.ahead = 100.0;
  made.report.lane.rms = 0.0625;
  made.report.lane.largest = 0.25;
  made.report.widened_left = 0.5;
  made.report.actors = {{"car1", 17}};
  made.report.left_out = {{"gone before", 2}};
  made.report.ignored = {{"scenario/signs", 3}};
  made.report.num_outliers = 7;
  made.report.num_filled = 8;
  made.report.rms_shift = 0.375;
  made.report.largest_shift = 0.75;
  made.report.hardest = 4.5;
  EXPECT_EQ(import_json(made, {.ego = 42}, "a.toml"),
            (json{{"schema", "saca.traffic_import/1"},
                  {"name", "test_1"},
                  {"output", "a.toml"},
                  {"ego", 42},
                  {"from_s", 1.5},
                  {"duration_s", 6.5},
                  {"origin_x_m", 10.0},
                  {"origin_y_m", -20.0},
                  {"lane",
                   {{"lanelets", {4, 5}},
                    {"behind_m", 20.0},
                    {"ahead_m", 100.0},
                    {"rms_m", 0.0625},
                    {"largest_m", 0.25},
                    {"widened_left_m", 0.5},
                    {"widened_right_m", 0.0}}},
                  {"smoothing",
                   {{"outliers", 7},
                    {"filled", 8},
                    {"rms_shift_m", 0.375},
                    {"largest_shift_m", 0.75},
                    {"hardest_mps2", 4.5}}},
                  {"actors", json::array({{{"name", "car1"}, {"obstacle", 17}}})},
                  {"left_out", {{"gone before", 2}}},
                  {"ignored", {{"scenario/signs", 3}}}}));
  EXPECT_TRUE(import_json(TrafficImport(), {}, "")["ego"].is_null());
}

}  // namespace
}  // namespace saca::importers::import_json_test
