#include "saca/lab/recordings/set_info.h"

#include <gmock/gmock.h>

#include <limits>

namespace saca::recordings::set_info_test {
namespace {

using testing::HasSubstr;

/// Two recordings of one group here and one there, in each a vehicle that keeps its lane for 1,800
/// samples with nobody ahead.
RecordedSet three_recordings() {
  Sample sample;
  sample.speed = 10.0;
  sample.offset = 0.1;
  sample.gap = std::numeric_limits<double>::infinity();
  RecordedVehicle vehicle{.id = 7, .type = "car", .length = 4.5, .width = 1.8};
  vehicle.samples.assign(1'800, sample);
  return {{{"a.xml", "here", "here-1", 1.0, {vehicle}},
           {"b.xml", "here", "here-1", 1.0, {vehicle}},
           {"c.xml", "there", "there-1", 1.0, {vehicle}}},
          {{"file: broken", 2}}};
}

TEST(SetInfo, IsADocumentOverAllAndBySite) {
  const nlohmann::json info = set_json(three_recordings());
  EXPECT_EQ(info.at("schema"), "saca.traffic_info/1");
  EXPECT_EQ(info.at("all").at("recordings"), 3);
  EXPECT_EQ(info.at("all").at("groups"), 2);
  EXPECT_EQ(info.at("all").at("vehicles"), 3);
  EXPECT_EQ(info.at("all").at("samples"), 5'400);
  EXPECT_EQ(info.at("all").at("samples_in_lane"), 5'400);
  EXPECT_EQ(info.at("all").at("samples_with_lead"), 0);
  EXPECT_EQ(info.at("all").at("steps_left"), 0);
  EXPECT_EQ(info.at("sites").size(), 2U);
  EXPECT_EQ(info.at("sites").at("here").at("recordings"), 2);
  EXPECT_EQ(info.at("sites").at("there").at("samples"), 1'800);
  EXPECT_EQ(info.at("skipped").at("file: broken"), 2);
}

TEST(SetInfo, IsReadBySiteThenOverAllThenWhatWasLeftOut) {
  const std::string text = set_text(three_recordings());
  EXPECT_THAT(text,
              testing::StartsWith("here: 2 recordings in 1 groups, 2 vehicles, 3600 samples, "));
  EXPECT_THAT(text, HasSubstr("\nall: 3 recordings in 2 groups, 3 vehicles, 5400 samples, "));
  EXPECT_THAT(text, HasSubstr("\n  lanes crossed: 0 to the left, 0 to the right; samples in a "
                              "lane: 5400, with a lead: 0\n"));
  EXPECT_THAT(text, testing::EndsWith("\n  left out: 2 x file: broken\n"));
}

}  // namespace
}  // namespace saca::recordings::set_info_test
