#include "saca/lab/suites/traffic_json.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saca/lab/suites/traffic_for_test.h"

namespace saca::suites::traffic_json_test {
namespace {

using nlohmann::json;

TrafficWatch watch_of() {
  TrafficWatch watch;
  watch.folders = {"one", "two"};
  watch.count = 3;
  watch.seed = 9;
  return watch;
}

TEST(TrafficJson, CountsOverAllAndBySource) {
  const json out = traffic_json(made_traffic(), watch_of(), "1.2");
  EXPECT_EQ(out.at("meta.command"),
            "saca suite traffic --data one two --count 3 --seed 9 --car compact_rwd_ev");
  EXPECT_EQ(out.at("meta.n"), "3");
  EXPECT_EQ(out.at("meta.version"), "1.2");
  EXPECT_EQ(out.at("traffic.drives"), 2);
  EXPECT_EQ(out.at("traffic.left_out"), 1);
  EXPECT_NEAR(out.at("traffic.exposure_h").get<double>(), 1.0, 1e-12);
  EXPECT_NEAR(out.at("traffic.exposure_km").get<double>(), 50.0, 1e-12);
  EXPECT_EQ(out.at("traffic.previews"), 1);
  EXPECT_EQ(out.at("traffic.triggers"), 2);
  EXPECT_EQ(out.at("traffic.false_triggers"), 1);
  EXPECT_EQ(out.at("traffic.danger"), 1);
  EXPECT_EQ(out.at("traffic.interventions"), 1);
  EXPECT_EQ(out.at("traffic.false_interventions"), 1);
  EXPECT_EQ(out.at("traffic.interventions_in_danger"), 0);
  EXPECT_EQ(out.at("traffic.early_interventions"), 1);
  EXPECT_EQ(out.at("traffic.reason.driver_braked"), 1);
  EXPECT_EQ(out.at("traffic.i80.triggers"), 2);
  EXPECT_EQ(out.at("traffic.us101.triggers"), 0);
}

// Garwood: of none in half an hour the upper bound is -ln(0.025) / 0.5 h.
TEST(TrafficJson, HasExactBounds) {
  const json out = traffic_json(made_traffic(), watch_of(), "1.2");
  EXPECT_NEAR(out.at("traffic.triggers_per_hour").get<double>(), 2.0, 1e-12);
  EXPECT_NEAR(out.at("traffic.triggers_per_1000km").get<double>(), 40.0, 1e-12);
  EXPECT_EQ(out.at("traffic.us101.triggers_per_hour.lo"), 0.0);
  EXPECT_NEAR(out.at("traffic.us101.triggers_per_hour.hi").get<double>(), -std::log(0.025) / 0.5,
              1e-9);
}

TEST(TrafficJson, WithoutExposureThereIsNoRate) {
  WatchedTraffic none;
  none.drives = {made_drive("i80", "a")};
  none.rows = {{.source = "i80", .drive = "a", .left_out = "no lane", .watched = {}}};
  const json out = traffic_json(none, watch_of(), "1.2");
  EXPECT_EQ(out.at("traffic.triggers"), 0);
  EXPECT_FALSE(out.contains("traffic.triggers_per_hour"));
  EXPECT_FALSE(out.contains("traffic.previews_per_1000km"));
}

}  // namespace
}  // namespace saca::suites::traffic_json_test
