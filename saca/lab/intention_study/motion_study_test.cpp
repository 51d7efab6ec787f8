#include "saca/lab/intention_study/motion_study.h"

#include <gmock/gmock.h>

#include "saca/lab/intention_scoring/examples.h"
#include "saca/lab/intention_study/recordings_for_test.h"

namespace saca::intention_study::motion_study_test {
namespace {

using testing::HasSubstr;

TEST(AStudy, MeasuresEachSiteAndAllTogether) {
  MotionStudy study;
  EXPECT_TRUE(study.sites().empty());
  study.add(recorded_at("us101", recorded_vehicle(100, 4.0)));
  study.add(recorded_at("i80", recorded_vehicle(100, 0.0)));
  study.add(recorded_at("short", recorded_vehicle(intention_scoring::fewest_frames - 1, 0.0)));
  const auto sites = study.sites();
  ASSERT_EQ(sites.size(), 3U);
  EXPECT_EQ(sites[0].site, "all");
  EXPECT_EQ(sites[1].site, "i80");
  EXPECT_EQ(sites[2].site, "us101");
  EXPECT_EQ(sites[0].fit.braking.num, 1U);
  EXPECT_EQ(sites[1].fit.braking.num, 0U);
  EXPECT_EQ(sites[2].fit.braking.num, 1U);
}

std::vector<SiteMotion> by_hand() {
  intention_scoring::MotionFit fit;
  fit.braking = {.num = 12, .median = 3.5, .log_sd = 0.25};
  fit.held = {.num = 5, .median = 0.5, .log_sd = 0.125};
  fit.acceleration.sd = 0.75;
  fit.acceleration.time = 2.5;
  return {{.site = "i80", .fit = fit}};
}

TEST(TheDocument, NamesWhatIsMeasuredWithItsUnit) {
  const nlohmann::json document = motion_json(by_hand());
  EXPECT_EQ(document["schema"], "saca.intent_motion/1");
  const nlohmann::json& site = document["sites"]["i80"];
  EXPECT_EQ(site["acceleration_sd_mps2"], 0.75);
  EXPECT_EQ(site["acceleration_time_s"], 2.5);
  EXPECT_EQ(site["braking_mps2"], (nlohmann::json{{"num", 12}, {"median", 3.5}, {"log_sd", 0.25}}));
  EXPECT_EQ(site["held"]["median"], 0.5);
  EXPECT_EQ(site["rise_s"]["num"], 0);
  EXPECT_EQ(site["lane_change_s"]["num"], 0);
  EXPECT_FALSE(motion_json({}).contains("sites"));
}

TEST(TheText, SaysTheSame) {
  const std::string text = motion_text(by_hand());
  EXPECT_THAT(text, HasSubstr("i80: maintaining, acceleration wavers by 0.75 m/s2 over 2.5 s\n"));
  EXPECT_THAT(text, HasSubstr("  deceleration of a braking [m/s2]       median  3.50, sd of the "
                              "logarithm 0.25 (12 measured)\n"));
  EXPECT_EQ(motion_text({}), "");
}

}  // namespace
}  // namespace saca::intention_study::motion_study_test
