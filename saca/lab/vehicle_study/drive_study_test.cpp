#include "saca/lab/vehicle_study/drive_study.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "saca/lab/prepare/shipped_cars_for_test.h"

namespace saca::vehicle_study::drive_study_test {
namespace {

using manoeuvre::PolicyId;
using nlohmann::json;
using testing::HasSubstr;

report::DriveRecord record(const DriveQuestion& question) {
  return record_of(question, "saca 1", "a_car", prepare::default_car());
}

TEST(DriveStudy, TheLineAsksForTheSameAgain) {
  EXPECT_EQ(command_line({.policy = PolicyId::aes_left, .car = "a_car"}),
            "saca drive --policy 1 --speed 14 --grip 0.9 --car a_car");
  EXPECT_EQ(command_line({.policy = PolicyId::es_b_left,
                          .speed = 12.5,
                          .grip = 0.5,
                          .target_speed = 3.0,
                          .strength = 0.75,
                          .car = "x.toml",
                          .seconds = 2.0,
                          .draws = 7,
                          .seed = 4}),
            "saca drive --policy 3 --speed 12.5 --grip 0.5 --car x.toml --target-speed 3 "
            "--strength 0.75 --seconds 2 --draws 7 --seed 4");
}

TEST(DriveStudy, ThePlanIsThePolicysUnlessAskedOtherwise) {
  const DriveQuestion usual{.policy = PolicyId::es_b_left, .speed = 12.0};
  EXPECT_EQ(record(usual).plan, manoeuvre::default_plan(PolicyId::es_b_left, 12.0));
  EXPECT_EQ(record(usual).scene.ego.v_B.x, 12.0);
  EXPECT_EQ(record(usual).program, "saca 1");
  DriveQuestion slower = usual;
  slower.target_speed = 2.0;
  EXPECT_EQ(record(slower).plan.target_speed, 2.0);
  EXPECT_EQ(record({.policy = PolicyId::aeb, .strength = 0.5}).plan.strength, 0.5);
}

TEST(DriveStudy, WhatDoesNotEndIsWatchedForThreeSecondsOrAsLongAsAsked) {
  DriveQuestion question{.policy = PolicyId::no_intervention};
  report::DriveRecord going_on = record(question);
  EXPECT_FALSE(drive_into(going_on, question).has_value());
  EXPECT_FALSE(going_on.ended);
  EXPECT_NEAR(going_on.samples.back().time, 3.0, 1e-9);
  question.seconds = 0.5;
  report::DriveRecord shorter = record(question);
  EXPECT_FALSE(drive_into(shorter, question).has_value());
  EXPECT_NEAR(shorter.samples.back().time, 0.5, 1e-9);
}

TEST(DriveStudy, DrawsAreKept) {
  const DriveQuestion question{.policy = PolicyId::aeb, .speed = 5.0, .draws = 2, .seed = 9};
  report::DriveRecord driven = record(question);
  EXPECT_FALSE(drive_into(driven, question).has_value());
  EXPECT_TRUE(driven.ended);
  ASSERT_TRUE(driven.draws.has_value());
  EXPECT_EQ(driven.draws->seed, 9U);
  ASSERT_EQ(driven.draws->endings.size(), 2U);
  EXPECT_FALSE(driven.draws->endings[1].path.empty());
}

TEST(DriveStudy, WhatCannotBeDrivenIsRefused) {
  const DriveQuestion question{.policy = PolicyId::t_drift_left, .speed = 90.0};
  report::DriveRecord driven = record(question);
  const auto why = drive_into(driven, question);
  ASSERT_TRUE(why.has_value());
  EXPECT_THAT(why->message, HasSubstr("needs a speed"));
  EXPECT_TRUE(driven.samples.empty());
}

json told_record(double sideways, const json& draws) {
  return {{"policy", {{"name", "AES-L"}}},
          {"start", {{"speed_mps", 14.0}}},
          {"road", {{"grip", 0.9}}},
          {"car", {{"name", "a_car"}}},
          {"end",
           {{"state", "lane recovered"},
            {"time_s", 1.25},
            {"forward_m", 20.0},
            {"sideways_m", sideways},
            {"heading_deg", -0.04},
            {"speed_mps", 13.5}}},
          {"draws", draws}};
}

TEST(DriveStudy, TheTextTellsSidesInWords) {
  EXPECT_EQ(text_of_drive(told_record(3.5, nullptr)),
            "AES-L from 14 m/s on grip 0.9 with a_car: lane recovered after 1.25 s\n"
            "  centre of mass 20.00 m forward, 3.50 m to the left; heading 0.0 deg, 13.5 m/s\n");
  EXPECT_THAT(text_of_drive(told_record(-0.5, nullptr)), HasSubstr("0.50 m to the right"));
}

TEST(DriveStudy, TheTextTellsOfDraws) {
  const json spread{{"p05", 1.0}, {"p50", 2.0}, {"p95", 3.0}};
  json draws{{"count", 20},         {"within_10_deg", nullptr}, {"time_s", spread},
             {"forward_m", spread}, {"sideways_m", spread},     {"heading_deg", spread}};
  EXPECT_THAT(
      text_of_drive(told_record(0.0, draws)),
      testing::EndsWith("    heading, deg     p05     1.00   p50     2.00   p95     3.00\n"));
  EXPECT_THAT(text_of_drive(told_record(0.0, draws)), testing::Not(HasSubstr("within 10 deg")));
  draws["within_10_deg"] = {{"share", 0.75}, {"low", 0.5}, {"high", 0.875}};
  EXPECT_THAT(
      text_of_drive(told_record(0.0, draws)),
      HasSubstr("    within 10 deg of across the lane: 75.0 % (95 % interval 50.0 to 87.5)"));
}

}  // namespace
}  // namespace saca::vehicle_study::drive_study_test
