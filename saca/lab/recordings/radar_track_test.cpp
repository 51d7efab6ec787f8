#include "saca/lab/recordings/radar_track.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saca/base/core/contract.h"

namespace saca::recordings::radar_track_test {
namespace {

std::vector<HundredCarRow> empty_rows(std::size_t size) {
  std::vector<HundredCarRow> rows(size);
  for (std::size_t k = 0; k < size; ++k) {
    rows[k].sync = static_cast<std::int64_t>(k);
    rows[k].speed = 15.0;
  }
  return rows;
}

/// A vehicle ahead that closes at 5 m/s from 50 m.
RadarTarget lead_at(std::size_t row, std::int64_t id) {
  return {.id = id, .range = 50.0 - 0.5 * static_cast<double>(row), .rate = -5.0, .azimuth = 0.0};
}

TEST(LeadTrack, FollowsOneVehicleThroughNewIdsAndGaps) {
  std::vector<HundredCarRow> rows = empty_rows(80);
  for (std::size_t k = 0; k < 80; ++k) {
    rows[k].front.push_back({.id = 99, .range = 30.0, .rate = -5.0, .azimuth = 0.3});  // aside
    if (k < 30 || k >= 40) {
      rows[k].front.push_back(lead_at(k, k < 30 ? 4 : 5));
    }
  }
  const auto track = lead_track(rows, 50, 70);
  ASSERT_TRUE(track.has_value());
  EXPECT_EQ(track->first_row, 0U);
  EXPECT_EQ(track->last_row, 79U);
  EXPECT_EQ(track->ids[10], 4);
  EXPECT_EQ(track->ids[35], 0);
  EXPECT_EQ(track->ids[45], 5);
  EXPECT_EQ(track->sightings[35], Sighting::none);
  for (std::size_t k = 0; k < 80; ++k) {
    EXPECT_NEAR(track->range[k], 50.0 - 0.5 * static_cast<double>(k), 1e-9) << k;
  }
  EXPECT_NEAR(rate_disagreement(*track, 0, 79), 0.0, 1e-9);
}

TEST(LeadTrack, EndsAtALongGap) {
  std::vector<HundredCarRow> rows = empty_rows(80);
  for (std::size_t k = 0; k < 80; ++k) {
    if (k < 20 || k >= 40) {
      rows[k].front.push_back(lead_at(k, 4));
    }
  }
  const auto track = lead_track(rows, 50, 70);
  ASSERT_TRUE(track.has_value());
  EXPECT_EQ(track->first_row, 40U);
}

TEST(LeadTrack, ThrowsOutliersAway) {
  std::vector<HundredCarRow> rows = empty_rows(60);
  for (std::size_t k = 0; k < 60; ++k) {
    RadarTarget target = lead_at(k, 4);
    if (k == 30) {
      target.range += 2.0;
      target.id = 5;
    }
    rows[k].front.push_back(target);
  }
  // Within its gate of 1 m + 2 m/s the jump of 2 m is not followed; as an id of its own it is none.
  const auto track = lead_track(rows, 40, 59);
  ASSERT_TRUE(track.has_value());
  EXPECT_NE(track->sightings[30], Sighting::kept);
  EXPECT_NEAR(track->range[30], 35.0, 1e-9);
}

TEST(LeadTrack, IsNoneWhenNothingCloses) {
  std::vector<HundredCarRow> rows = empty_rows(30);
  EXPECT_FALSE(lead_track(rows, 0, 29).has_value());
  for (HundredCarRow& row : rows) {
    row.front.push_back({.id = 1, .range = 20.0, .rate = 0.5, .azimuth = 0.0});
  }
  EXPECT_FALSE(lead_track(rows, 0, 29).has_value());
  EXPECT_THROW((void)lead_track(rows, 0, 30), ContractViolation);
}

TEST(FollowerTrack, IsTheNearestAtTheConflict) {
  std::vector<HundredCarRow> rows = empty_rows(60);
  for (std::size_t k = 0; k < 60; ++k) {
    rows[k].rear.push_back({.id = 8, .range = 40.0, .rate = 0.0, .azimuth = 0.0});
    if (k < 35) {
      rows[k].rear.push_back({.id = 9, .range = 12.0, .rate = 0.0, .azimuth = 0.01});
    }
  }
  const auto track = follower_track(rows, 0, 59, 30, 20);
  ASSERT_TRUE(track.has_value());
  EXPECT_EQ(track->ids[0], 9);
  EXPECT_EQ(track->last_row, 34U);
}

TEST(FollowerTrack, MustBeSeenLongEnough) {
  std::vector<HundredCarRow> rows = empty_rows(60);
  for (std::size_t k = 10; k < 29; ++k) {
    rows[k].rear.push_back({.id = 8, .range = 40.0, .rate = 0.0, .azimuth = 0.0});
  }
  EXPECT_FALSE(follower_track(rows, 0, 59, 30, 20).has_value());
  EXPECT_TRUE(follower_track(rows, 0, 59, 30, 19).has_value());
}

}  // namespace
}  // namespace saca::recordings::radar_track_test
