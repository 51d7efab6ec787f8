#include "saca/lab/forecast_study/traffic_forecasts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace saca::forecast_study::traffic_forecasts_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

EncounterForecasts drive(const std::string& site, const std::vector<std::string>& whom) {
  EncounterForecasts one{.family = site, .problem = {}, .samples = {}};
  for (const std::string& who : whom) {
    one.samples.push_back({.who = who});
  }
  return one;
}

TEST(Drives, OfOneGroupCountAsOneEncounter) {
  eval::FoundDrives found;
  for (const char* const group : {"b", "a", "a", "a"}) {
    found.drives.push_back({.site = "us101", .group = group, .file = {}});
  }
  found.skipped = {{"too short", 3}};
  std::vector<EncounterForecasts> drives{drive("us101", {"car1"}), drive("us101", {"car2", "car3"}),
                                         drive("us101", {}), drive("us101", {"car4"})};
  drives[2].problem = "recorded for too short";
  const ForecastStudy study = by_group(found, drives);
  ASSERT_EQ(study.encounters.size(), 2U);
  EXPECT_EQ(study.encounters[0].samples.size(), 3U) << "group a";
  EXPECT_EQ(study.encounters[0].samples[2].who, "car4");
  EXPECT_EQ(study.encounters[1].samples.size(), 1U) << "group b";
  EXPECT_EQ(study.encounters[1].family, "us101");
  EXPECT_TRUE(study.encounters[0].problem.empty()) << "a drive too short is no fault";
  EXPECT_THAT(study.notes,
              ElementsAre("Passed over: 3 x too short.",
                          "3 drives in 2 groups that share no road user; 1 more gave nothing to "
                          "hold a forecast against."));
}

TEST(Drives, OfTwoSitesAreNeverOneGroup) {
  eval::FoundDrives found;
  found.drives = {{.site = "us101", .group = "0", .file = {}},
                  {.site = "lankershim", .group = "0", .file = {}}};
  const ForecastStudy study =
      by_group(found, {drive("us101", {"car1"}), drive("lankershim", {"car1"})});
  ASSERT_EQ(study.encounters.size(), 2U);
  EXPECT_EQ(study.encounters[0].family, "lankershim");
}

TEST(TrafficForecasts, WantAFolder) {
  const auto refused = traffic_forecasts({.folders = {"no/such/folder"}, .models = "models"});
  ASSERT_FALSE(refused.has_value());
  EXPECT_THAT(refused.error().message, HasSubstr("no/such/folder"));
}

}  // namespace
}  // namespace saca::forecast_study::traffic_forecasts_test
