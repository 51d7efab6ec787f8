#include "saca/lab/vehicle_study/fit_report.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace saca::vehicle_study::fit_report_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

FitResult result() {
  FitResult result{"a_car", "b.toml", {}};
  result.fit.parameters = {{"road", "grip", 0.9, 0.8, 0.75, 0.85, true},
                           {"tyre", "stiffness", 18.0, 18.0, 0.0, 0.0, false}};
  result.fit.signals = {{.log = "a.csv",
                         .signal = tune::Signal::speed,
                         .noise = 0.02,
                         .rms = 0.03,
                         .offset = 0.0,
                         .run = 2.0,
                         .num_outliers = 4}};
  result.fit.condition = 12.5;
  result.fit.warnings = {"few rows"};
  return result;
}

TEST(FitReport, WhatIsNotDeterminedHasNoInterval) {
  const json all = json_of(result());
  EXPECT_EQ(all.at("schema"), "saca.vehicle_fit/1");
  EXPECT_EQ(all.at("car"), "a_car");
  EXPECT_EQ(all.at("output"), "b.toml");
  EXPECT_EQ(all.at("condition"), 12.5);
  EXPECT_EQ(all.at("warnings"), json({"few rows"}));
  EXPECT_EQ(all.at("parameters").at(0), json({{"section", "road"},
                                              {"key", "grip"},
                                              {"base", 0.9},
                                              {"value", 0.8},
                                              {"determined", true},
                                              {"low", 0.75},
                                              {"high", 0.85}}));
  EXPECT_TRUE(all.at("parameters").at(1).at("low").is_null());
  EXPECT_TRUE(all.at("parameters").at(1).at("high").is_null());
  EXPECT_EQ(all.at("signals").at(0), json({{"log", "a.csv"},
                                           {"column", "speed_mps"},
                                           {"noise", 0.02},
                                           {"rms", 0.03},
                                           {"offset", 0.0},
                                           {"run", 2.0},
                                           {"outliers", 4}}));
}

TEST(FitReport, TheTextHasTwoTables) {
  EXPECT_EQ(text_of(result()),
            "parameter                       base    fitted   95 % interval\n"
            "road.grip                        0.9       0.8   0.75 to 0.85\n"
            "tyre.stiffness                    18         -   the logs do not determine it\n"
            "\n"
            "signal                           rms     noise    offset   log\n"
            "speed_mps                       0.03      0.02         0   a.csv\n"
            "\n"
            "b.toml: the car as fitted; the grip is the road's and not in it\n");
}

}  // namespace
}  // namespace saca::vehicle_study::fit_report_test
