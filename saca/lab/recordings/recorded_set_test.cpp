#include "saca/lab/recordings/recorded_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace saca::recordings::recorded_set_test {
namespace {

using ::testing::HasSubstr;

constexpr double inf = std::numeric_limits<double>::infinity();

/// Two recordings of one site and one of another, a vehicle of three samples in each.
RecordedSet three_recordings() {
  Sample sample;
  sample.speed = 10.0;
  sample.offset = 0.1;
  sample.gap = inf;
  RecordedVehicle vehicle{.id = 7, .type = "car", .length = 4.5, .width = 1.8};
  vehicle.samples.assign(3, sample);
  return {{{"a.xml", "here", "here-1", 0.1, {vehicle}},
           {"b.xml", "here", "here-1", 0.1, {vehicle}},
           {"c.xml", "there", "there-1", 0.2, {vehicle}}},
          {{"file: broken", 2}}};
}

Sample& first_sample(RecordedSet& set) {
  return set.recordings[0].vehicles[0].samples[0];
}

TEST(RecordedSet, IsFineAsItIsMade) {
  EXPECT_EQ(broken_rule(three_recordings()), std::nullopt);
}

TEST(RecordedSet, NamesThePlaceOfWhatIsWrong) {
  RecordedSet set = three_recordings();
  set.recordings[1].vehicles[0].samples[2].speed = not_known;
  EXPECT_EQ(broken_rule(set).value(),
            "recording b.xml: vehicle 7: sample 2: speed: want a finite number");
}

TEST(RecordedSet, RefusesWhatBreaksARule) {
  const std::vector<std::function<void(RecordedSet&)>> breaks{
      [](RecordedSet& s) { s.recordings.clear(); },
      [](RecordedSet& s) { s.recordings[0].name = ""; },
      [](RecordedSet& s) { s.recordings[0].group = "two\nlines"; },
      [](RecordedSet& s) { s.recordings[0].step = 0.0; },
      [](RecordedSet& s) { s.recordings[0].step = not_known; },
      [](RecordedSet& s) { s.recordings[0].vehicles.clear(); },
      [](RecordedSet& s) { s.recordings[0].vehicles[0].samples.clear(); },
      [](RecordedSet& s) { s.recordings[0].vehicles[0].length = 0.0; },
      [](RecordedSet& s) { s.recordings[0].vehicles[0].start = inf; },
      [](RecordedSet& s) { s.recordings[0].vehicles[0].type = "a\nb"; },
      [](RecordedSet& s) { s.recordings[0].vehicles[0].id = std::int64_t{1} << 60; },
      [](RecordedSet& s) { first_sample(s).X_WA.p.x = 1.0; },  // the rest is not known
      [](RecordedSet& s) {
        first_sample(s).X_WA = {{inf, 0.0}, 0.0};
      },
      [](RecordedSet& s) { first_sample(s).offset = inf; },
      [](RecordedSet& s) { first_sample(s).lane_width = -3.0; },
      [](RecordedSet& s) { first_sample(s).lane_step = 2; },
      [](RecordedSet& s) {
        first_sample(s).lane_step = 1;
        first_sample(s).offset = not_known;
      },
      [](RecordedSet& s) { first_sample(s).gap = -inf; },
      [](RecordedSet& s) { first_sample(s).lead_speed = 3.0; },  // nobody is ahead
      [](RecordedSet& s) { first_sample(s).brake_pedal = 1.1; },
      [](RecordedSet& s) { first_sample(s).throttle = -0.1; },
      [](RecordedSet& s) { s.skipped["nothing"] = 0; },
      [](RecordedSet& s) { s.skipped[""] = 1; },
  };
  for (std::size_t k = 0; k < breaks.size(); ++k) {
    RecordedSet set = three_recordings();
    breaks[k](set);
    EXPECT_NE(broken_rule(set), std::nullopt) << k;
  }
}

TEST(RecordedSet, AllowsWhatWasNotRecorded) {
  RecordedSet set = three_recordings();
  Sample unknown;
  first_sample(set) = unknown;
  set.recordings[0].vehicles[0].length = not_known;
  set.recordings[0].vehicles[0].width = not_known;
  set.recordings[0].vehicles[0].type = "";
  EXPECT_EQ(broken_rule(set), std::nullopt);
}

TEST(RecordedSet, AllowsALeadThatOverlaps) {
  RecordedSet set = three_recordings();
  first_sample(set).gap = -0.5;  // noise of sizes and places
  first_sample(set).lead_speed = 2.0;
  EXPECT_EQ(broken_rule(set), std::nullopt);
}

TEST(RecordedSet, CountsWhatItHolds) {
  RecordedSet set = three_recordings();
  first_sample(set).lane_step = -1;
  set.recordings[2].vehicles[0].samples[1].lane_step = 1;
  set.recordings[2].vehicles[0].samples[1].offset = 0.5;
  set.recordings[2].vehicles[0].samples[2].offset = not_known;
  first_sample(set).gap = 12.0;
  const SetCounts all = counts_of(set);
  EXPECT_EQ(all.recordings, 3U);
  EXPECT_EQ(all.groups, 2U);
  EXPECT_EQ(all.vehicles, 3U);
  EXPECT_EQ(all.samples, 9U);
  EXPECT_NEAR(all.hours, (3 * 0.1 + 3 * 0.1 + 3 * 0.2) / 3600.0, 1e-15);
  EXPECT_EQ(all.steps_left, 1U);
  EXPECT_EQ(all.steps_right, 1U);
  EXPECT_EQ(all.in_lane, 8U);
  EXPECT_EQ(all.with_lead, 1U);
  const auto sites = counts_by_site(set);
  ASSERT_EQ(sites.size(), 2U);
  EXPECT_EQ(sites.at("here").vehicles, 2U);
  EXPECT_EQ(sites.at("here").groups, 1U);
  EXPECT_EQ(sites.at("there").steps_left, 1U);
}

}  // namespace
}  // namespace saca::recordings::recorded_set_test
