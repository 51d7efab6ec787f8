#include "saca/lab/recordings/repeats.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace saca::recordings::repeats_test {
namespace {

/// A motion of its own for each vehicle: samples `first` to `first + size` of it, in a world that
/// is moved and turned.
RecordedVehicle pass(std::int64_t id, int first, int size, const Pose& X_VW = {}) {
  RecordedVehicle vehicle{.id = id, .length = 4.0 + 0.01 * static_cast<double>(id), .width = 1.8};
  const double rate = 0.3 + 0.05 * static_cast<double>(id);
  double s = 0.0;
  for (int k = 0; k < first + size; ++k) {
    const double speed = 10.0 + 3.0 * std::sin(rate * 0.1 * k * k / 10.0);
    if (k >= first) {
      Sample sample;
      sample.speed = speed;
      sample.X_WA = X_VW * Pose{{s, static_cast<double>(id)}, 0.0};
      vehicle.samples.push_back(sample);
    }
    s += 0.1 * speed;
  }
  return vehicle;
}

Recording cut(const std::string& name, std::vector<RecordedVehicle> vehicles) {
  return {name, "here", "", 0.1, std::move(vehicles)};
}

TEST(Repeats, GroupsRecordingsThatShareAVehicle) {
  RecordedSet set{{cut("a", {pass(1, 0, 20), pass(2, 0, 20)}), cut("b", {pass(3, 0, 20)}),
                   cut("c", {pass(2, 0, 20), pass(4, 0, 20)}), cut("d", {pass(4, 0, 20)})},
                  {}};
  name_groups(set);
  EXPECT_EQ(set.recordings[0].group, "here-1");
  EXPECT_EQ(set.recordings[1].group, "here-2");
  EXPECT_EQ(set.recordings[2].group, "here-1");
  EXPECT_EQ(set.recordings[3].group, "here-1");
}

TEST(Repeats, TheSameIdOfAnotherSizeOrSiteIsAnotherVehicle) {
  RecordedSet set{
      {cut("a", {pass(1, 0, 20)}), cut("b", {pass(1, 0, 20)}), cut("c", {pass(1, 0, 20)})}, {}};
  set.recordings[1].vehicles[0].length += 0.3;
  set.recordings[2].site = "there";
  name_groups(set);
  EXPECT_EQ(set.recordings[0].group, "here-1");
  EXPECT_EQ(set.recordings[1].group, "here-2");
  EXPECT_EQ(set.recordings[2].group, "there-1");
}

Repeats repeats_of(RecordedSet& set) {
  name_groups(set);
  return drop_repeats(set);
}

TEST(Repeats, AFileThatStandsInAnotherIsDropped) {
  const Pose elsewhere{{100.0, -50.0}, 2.0};
  RecordedSet set{{cut("a", {pass(1, 5, 30, elsewhere), pass(2, 5, 30, elsewhere)}),
                   cut("b", {pass(1, 0, 60), pass(2, 0, 60)})},
                  {}};
  const Repeats repeats = repeats_of(set);
  EXPECT_EQ(repeats.clocks, 1U);
  EXPECT_EQ(repeats.passes, 2U);
  EXPECT_EQ(repeats.recordings, 1U);
  ASSERT_EQ(set.recordings.size(), 1U);
  EXPECT_EQ(set.recordings[0].name, "b");
  EXPECT_EQ(set.skipped.at("vehicle: kept from another file"), 2U);
  EXPECT_EQ(set.skipped.at("file: all its vehicles are kept from others"), 1U);
}

TEST(Repeats, OfTracksThatOverlapEachInstantIsKeptOnce) {
  RecordedSet set{{cut("a", {pass(1, 0, 40)}), cut("b", {pass(1, 25, 50)})}, {}};
  set.recordings[0].vehicles[0].samples[0].lane_step = 0;
  const Repeats repeats = repeats_of(set);
  EXPECT_EQ(repeats.samples, 15U);
  ASSERT_EQ(set.recordings.size(), 2U);
  const RecordedVehicle& shorter = set.recordings[0].vehicles[0];
  EXPECT_EQ(shorter.samples.size(), 25U);  // 0 to 24; b has 25 to 74
  EXPECT_EQ(shorter.start, 0.0);
  EXPECT_EQ(set.recordings[1].vehicles[0].samples.size(), 50U);
}

TEST(Repeats, ARestAtTheEndStartsLater) {
  RecordedSet set{{cut("a", {pass(1, 0, 50)}), cut("b", {pass(1, 20, 45)})}, {}};
  (void)repeats_of(set);
  const RecordedVehicle& rest = set.recordings[1].vehicles[0];
  EXPECT_EQ(rest.samples.size(), 15U);  // 50 to 64
  EXPECT_NEAR(rest.start, 3.0, 1e-12);
}

TEST(Repeats, StandingVehiclesFollowTheClockOfTheMovingOnes) {
  const auto standing = [](int size) {
    RecordedVehicle vehicle = pass(9, 0, size);
    for (Sample& sample : vehicle.samples) {
      sample.speed = 0.0;
      sample.X_WA = {};
    }
    return vehicle;
  };
  RecordedSet one{
      {cut("a", {pass(1, 0, 40), standing(40)}), cut("b", {pass(1, 0, 40), standing(40)})}, {}};
  EXPECT_EQ(repeats_of(one).passes, 2U);
  // Nobody who moves is shared: they may have stood there at another time.
  RecordedSet two{{cut("a", {standing(40)}), cut("b", {standing(40)})}, {}};
  EXPECT_EQ(repeats_of(two).passes, 0U);
  EXPECT_EQ(two.recordings.size(), 2U);
}

TEST(Repeats, AnotherPassOfTheSameVehicleIsKept) {
  RecordedSet set{{cut("a", {pass(1, 0, 30)}), cut("b", {pass(1, 100, 30)})}, {}};
  const Repeats repeats = repeats_of(set);
  EXPECT_EQ(set.recordings[0].group, set.recordings[1].group);
  EXPECT_EQ(repeats.clocks, 2U);
  EXPECT_EQ(repeats.passes, 0U);
  EXPECT_EQ(counts_of(set).samples, 60U);
}

TEST(Repeats, SpeedsThatAreAlikeByChanceDoNotOutweighTheOthers) {
  // Vehicle 1 is copied two seconds later as if by chance; 2, 3 and 4 tell the true clock.
  std::vector<RecordedVehicle> later;
  for (const std::int64_t id : {2, 3, 4}) {
    later.push_back(pass(id, 20, 40));
  }
  later.push_back(pass(1, 0, 40));
  RecordedSet set{
      {cut("a", {pass(1, 0, 40), pass(2, 0, 60), pass(3, 0, 60), pass(4, 0, 60)}), cut("b", later)},
      {}};
  (void)repeats_of(set);
  // On the true clock b's vehicle 1 is at 20 to 59, of which a has 20 to 39.
  ASSERT_EQ(set.recordings.size(), 2U);
  ASSERT_EQ(set.recordings[1].vehicles.size(), 1U);
  EXPECT_EQ(set.recordings[1].vehicles[0].samples.size(), 20U);
}

TEST(Repeats, ChainsOfFilesShareOneClock) {
  RecordedSet set{
      {cut("a", {pass(1, 0, 40), pass(2, 0, 40)}), cut("b", {pass(2, 20, 40), pass(3, 20, 40)}),
       cut("c", {pass(3, 40, 40), pass(1, 40, 40)})},
      {}};
  const Repeats repeats = repeats_of(set);
  EXPECT_EQ(repeats.clocks, 1U);
  EXPECT_EQ(counts_of(set).samples, 40U + 40U + 60U + 60U);  // 1: 0-39 and 40-79; 2: 0-59; 3: 20-79
}

}  // namespace
}  // namespace saca::recordings::repeats_test
