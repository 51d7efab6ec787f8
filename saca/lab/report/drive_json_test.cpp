#include "saca/lab/report/drive_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "saca/base/core/units.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/lab/report/record_page.h"

namespace saca::report::drive_json_test {
namespace {

using manoeuvre::PolicyId;
using nlohmann::json;

DriveRecord record_of(PolicyId policy, double horizon) {
  DriveRecord record{.program = "test",
                     .command = "none",
                     .car_name = "car </script>",
                     .car = prepare::default_car(),
                     .plan = {policy, std::nullopt}};
  record.scene.ego.v_B = {14.0, 0.0};
  record.scene.grip = 0.9;
  ride_into(record, horizon);
  return record;
}

TEST(DriveJson, SaysWhatTheCarDid) {
  const DriveRecord record = record_of(PolicyId::t_drift_left, 10.0);
  const json document = json::parse(drive_json(record));
  EXPECT_EQ(document["schema"], "saca.drive/1");
  EXPECT_EQ(document["end"]["state"], "at rest");
  const std::size_t n = document["time_s"].size();
  EXPECT_EQ(n, record.samples.size());
  for (const char* key :
       {"x_m", "y_m", "heading_deg", "v_x_mps", "v_y_mps", "yaw_rate_degps", "a_x_mps2", "a_y_mps2",
        "steering_deg", "steering_command_deg", "motor_Nm", "motor_command_Nm"}) {
    EXPECT_EQ(document[key].size(), n) << key;
  }
  EXPECT_EQ(document["heading_deg"].back(), document["end"]["heading_deg"]);
  EXPECT_TRUE(document["draws"].is_null());
  // The path is the integral of the velocity.
  const auto number = [&](const char* key, std::size_t i) {
    return document[key][i].get<double>();
  };
  double x = 0.0;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double yaw = from_degrees(number("heading_deg", i));
    x += 0.01 * (std::cos(yaw) * number("v_x_mps", i) - std::sin(yaw) * number("v_y_mps", i));
  }
  EXPECT_NEAR(x, document["end"]["forward_m"].get<double>(), 0.1);
}

TEST(DriveJson, TheHorizonMayComeFirst) {
  const json document = json::parse(drive_json(record_of(PolicyId::aeb, 0.5)));
  EXPECT_EQ(document["end"]["state"], "still moving");
  EXPECT_NEAR(document["end"]["time_s"].get<double>(), 0.5, 1e-9);
}

TEST(DriveJson, CountsItsDraws) {
  DriveRecord record = record_of(PolicyId::t_drift_right, 10.0);
  record.draws = {.seed = 3, .endings = std::vector<tune::Ending>(4)};
  for (std::size_t i = 0; i < 4; ++i) {
    auto& ending = record.draws->endings[i];
    ending.ended = true;
    ending.X_WB.yaw = from_degrees(i == 0 ? -75.0 : -90.0);
    ending.X_WB.p.x = static_cast<double>(i);
  }
  record.draws->endings[1].path = {{}, record.draws->endings[1].X_WB};
  const json draws = json::parse(drive_json(record))["draws"];
  EXPECT_DOUBLE_EQ(draws["within_10_deg"]["share"].get<double>(), 0.75);
  EXPECT_EQ(draws["forward_m"]["p50"], 1.0);
  EXPECT_EQ(draws["paths"].size(), 1U);
  EXPECT_EQ(draws["ends"].size(), 4U);
  record.plan = {PolicyId::aeb, std::nullopt};
  EXPECT_TRUE(json::parse(drive_json(record))["draws"]["within_10_deg"].is_null());
}

TEST(DriveJson, IsShownByItsPage) {
  const auto page = drive_report(drive_json(record_of(PolicyId::aeb, 5.0)));
  ASSERT_TRUE(page.has_value()) << page.error().message;
  EXPECT_NE(page.value().find("saca.drive/1"), std::string::npos);
}

}  // namespace
}  // namespace saca::report::drive_json_test
