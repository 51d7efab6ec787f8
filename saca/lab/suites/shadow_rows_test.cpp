#include "saca/lab/suites/shadow_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace saca::suites::shadow_rows_test {
namespace {

ShadowRow row_of(const std::string& source, double seconds, double metres) {
  return {.source = source,
          .drive = "a.xml, 7",
          .left_out = {},
          .watched = {.seconds = seconds,
                      .metres = metres,
                      .previews = {{0.5, 1.5, "car1"}},
                      .triggers = {{1.25,
                                    "car1",
                                    1.29,
                                    15.0,
                                    {.driver_deceleration = 4.5,
                                     .needed_deceleration = 3.25,
                                     .least_gap = 1.0 / 3.0,
                                     .reason = eval::ShadowReason::driver_braked}},
                                   {4.5, "van1", 0.5, 3.0, {.needed_deceleration = std::nullopt}}},
                      .interventions = {{{0.75,
                                          "car1",
                                          1.79,
                                          15.0,
                                          {.driver_deceleration = 4.5,
                                           .needed_deceleration = 2.25,
                                           .least_gap = 1.0 / 3.0,
                                           .reason = eval::ShadowReason::driver_braked}},
                                         "AEB",
                                         true}}}};
}

TEST(ShadowRows, ALineComesBack) {
  for (const ShadowRow& row :
       {row_of("us101", 6.5, 70.0),
        ShadowRow{.source = "100car", .drive = "8300", .left_out = "no lane", .watched = {}},
        ShadowRow{.source = "100car",
        .drive = "9",
        .left_out = "it threw",
        .failed = true,
        .watched = {}}}) {
    const auto back = shadow_row_from(line_of(row));
    ASSERT_TRUE(back.has_value()) << back.error().message;
    EXPECT_EQ(line_of(back.value()), line_of(row));
    EXPECT_EQ(back.value().left_out, row.left_out);
    EXPECT_EQ(back.value().failed, row.failed);
    EXPECT_EQ(shadow_figures({&row, 1}, "").failed, row.failed ? 1 : 0);
    EXPECT_EQ(back.value().watched.seconds, row.watched.seconds);
    EXPECT_EQ(back.value().watched.triggers.size(), row.watched.triggers.size());
    EXPECT_EQ(back.value().watched.interventions.size(), row.watched.interventions.size());
  }
}

TEST(ShadowRows, WhatIsNoLineIsRefused) {
  for (const char* line :
       {"", "{}", "[1]", R"({"source":"a","drive":"b"})",
        R"({"source":"a","drive":"b","seconds":1,"metres":1,"previews":[],)"
        R"("triggers":[[1,"car1",1,1,"wrong",0,0,0,null,0]],"interventions":[]})"}) {
    const auto row = shadow_row_from(line);
    ASSERT_FALSE(row.has_value()) << line;
    EXPECT_EQ(row.error().code, Error::Code::malformed);
  }
  EXPECT_THAT(shadow_row_from(std::string(500'000, '[')).error().message,
              testing::HasSubstr("want JSON of at most 32 levels"));
}

// 2 x 1,800 s and 2 x 25 km at one place: 4 triggers, 2 of them false, in an hour and 50 km; 2
// interventions, both where there was danger, and early.
TEST(ShadowRows, AddUpBySource) {
  const std::vector<ShadowRow> rows{
      row_of("us101", 1'800.0, 25'000.0),
      row_of("us101", 1'800.0, 25'000.0),
      {.source = "us101", .drive = "b", .left_out = "no lane", .watched = {}},
      row_of("100car", 3'600.0, 50'000.0)};
  const ShadowFigures one = shadow_figures(rows, "us101");
  EXPECT_EQ(one.drives, 2);
  EXPECT_EQ(one.left_out, 1);
  EXPECT_NEAR(one.hours, 1.0, 1e-12);
  EXPECT_NEAR(one.kilometres, 50.0, 1e-12);
  EXPECT_EQ(one.triggers.per_hour.count, 4);
  EXPECT_NEAR(one.triggers.per_hour.value, 4.0, 1e-9);
  EXPECT_NEAR(one.triggers.per_1000km.value, 80.0, 1e-9);
  EXPECT_EQ(one.triggers.danger, 2);
  EXPECT_EQ(one.triggers.false_per_1000km.count, 2);
  EXPECT_NEAR(one.triggers.false_per_1000km.value, 40.0, 1e-9);
  EXPECT_EQ(one.interventions.per_hour.count, 2);
  EXPECT_EQ(one.interventions.danger, 2);
  EXPECT_EQ(one.interventions.false_per_hour.count, 0);
  EXPECT_EQ(one.early, 2);
  EXPECT_NEAR(one.previews_per_hour.value, 2.0, 1e-9);
  EXPECT_EQ(one.triggers.reasons.at(eval::ShadowReason::driver_braked), 2);
  EXPECT_EQ(shadow_figures(rows, "").triggers.per_hour.count, 6);
  const ShadowFigures none = shadow_figures(rows, "i80");
  EXPECT_EQ(none.drives, 0);
  EXPECT_EQ(none.triggers.per_hour.high, 0.0);
}

}  // namespace
}  // namespace saca::suites::shadow_rows_test
