#include "saca/lab/recordings/ngsim_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace saca::recordings::ngsim_set_test {
namespace {

constexpr NgsimKey here{"us101", 5};

/// Drives along a lane at 15 m/s from the section's beginning; lane 1's centre is 2 m from the left
/// edge, the next ones 3.6 m farther each.
std::vector<NgsimRow> drive(std::int64_t vehicle, int lane, std::int64_t first_frame,
                            double from = 0.0, int frames = 260) {
  std::vector<NgsimRow> rows;
  for (int k = 0; k < frames; ++k) {
    rows.push_back({.vehicle = vehicle,
                    .frame = first_frame + k,
                    .right = 2.0 + 3.6 * (lane - 1),
                    .along = from + 1.5 * k,
                    .length = 4.0,
                    .width = 1.8,
                    .speed = 15.0,
                    .vehicle_class = 2,
                    .lane = lane});
  }
  return rows;
}

/// Enough traffic on lanes 1 to 3 to show where they run.
NgsimTable busy_section() {
  NgsimTable table;
  std::vector<NgsimRow>& rows = table.recordings[here];
  for (int vehicle = 0; vehicle < 9; ++vehicle) {
    const auto more = drive(100 + vehicle, 1 + vehicle % 3, 1000 + 50 * vehicle);
    rows.insert(rows.end(), more.begin(), more.end());
  }
  return table;
}

void add(NgsimTable& table, const std::vector<NgsimRow>& rows) {
  table.recordings[here].insert(table.recordings[here].end(), rows.begin(), rows.end());
}

const RecordedVehicle& vehicle_of(const RecordedSet& set, std::int64_t id) {
  for (const RecordedVehicle& vehicle : set.recordings.at(0).vehicles) {
    if (vehicle.id == id) {
      return vehicle;
    }
  }
  throw std::runtime_error("no such vehicle");
}

TEST(NgsimSet, FindsLanesInTheTraffic) {
  const NgsimLanes lanes(busy_section().recordings[here]);
  const auto middle = lanes.at(2, 200.0);
  ASSERT_TRUE(middle);
  EXPECT_NEAR(middle->right, 5.6, 1e-9);
  EXPECT_NEAR(middle->slope, 0.0, 1e-9);
  EXPECT_NEAR(middle->width, 3.6, 1e-9);
  EXPECT_TRUE(middle->left_lane);
  EXPECT_TRUE(middle->right_lane);
  EXPECT_FALSE(lanes.at(1, 200.0)->left_lane);
  EXPECT_FALSE(lanes.at(3, 200.0)->right_lane);
  EXPECT_FALSE(lanes.at(4, 200.0));
  EXPECT_FALSE(lanes.at(2, 2000.0));
  EXPECT_NEAR(lanes.end(), 1.5 * 259, 1e-9);
}

TEST(NgsimSet, OneWhoLeavesItsLaneDoesNotMoveIt) {
  NgsimTable table = busy_section();
  std::vector<NgsimRow> astray = drive(7, 2, 3000);
  for (NgsimRow& row : astray) {
    row.right += 1.2;
  }
  add(table, astray);
  const RecordedSet set = set_of_ngsim(table, "f");
  EXPECT_NEAR(vehicle_of(set, 7).samples[100].offset, -1.2, 1e-9);  // to the right
  EXPECT_NEAR(vehicle_of(set, 101).samples[100].offset, 0.0, 1e-9);
}

TEST(NgsimSet, TheBodysCentreIsBehindItsFront) {
  const RecordedSet set = set_of_ngsim(busy_section(), "f");
  EXPECT_EQ(broken_rule(set), std::nullopt);
  const RecordedVehicle& vehicle = vehicle_of(set, 101);
  EXPECT_EQ(vehicle.type, "car");
  EXPECT_NEAR(vehicle.start, 105.0, 1e-9);  // frame 1050
  const Sample& sample = vehicle.samples[100];
  EXPECT_NEAR(sample.X_WA.p.x, 150.0 - 2.0, 1e-9);
  EXPECT_NEAR(sample.X_WA.p.y, -5.6, 1e-9);
  EXPECT_NEAR(sample.X_WA.yaw, 0.0, 1e-9);
  EXPECT_EQ(sample.speed, 15.0);
  EXPECT_TRUE(std::isnan(sample.curvature));
}

TEST(NgsimSet, LaneNumbersGrowToTheRight) {
  NgsimTable table = busy_section();
  std::vector<NgsimRow> changing = drive(7, 2, 3000);
  for (std::size_t k = 0; k < changing.size(); ++k) {
    // From lane 2 into lane 1, to the left, over 50 frames.
    const double share = std::clamp((static_cast<double>(k) - 80.0) / 50.0, 0.0, 1.0);
    changing[k].right -= 3.6 * share;
    changing[k].lane = share > 0.5 ? 1 : 2;
  }
  add(table, changing);
  const std::vector<Sample> samples = vehicle_of(set_of_ngsim(table, "f"), 7).samples;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    EXPECT_EQ(samples[k].lane_step, k == 106 ? 1 : 0) << k;
  }
  EXPECT_GT(samples[105].offset, 1.5);
  EXPECT_LT(samples[106].offset, -1.5);
  // 3.6 m in 5 s at 15 m/s; the way of the last second tells it.
  EXPECT_NEAR(samples[100].heading, std::atan2(0.72, 15.0), 1e-6);
}

TEST(NgsimSet, MeasuresTheGapToTheOneAhead) {
  NgsimTable table = busy_section();
  std::vector<NgsimRow> lead = drive(7, 2, 3000, 40.0, 200);
  std::vector<NgsimRow> follower = drive(8, 2, 3000, 0.0, 210);
  for (NgsimRow& row : follower) {
    row.preceding = 7;
  }
  lead[50].speed = 12.0;
  add(table, lead);
  add(table, follower);
  const RecordedSet set = set_of_ngsim(table, "f");
  const std::vector<Sample>& behind = vehicle_of(set, 8).samples;
  EXPECT_NEAR(behind[50].gap, 40.0 - 4.0, 1e-9);
  EXPECT_EQ(behind[50].lead_speed, 12.0);
  EXPECT_TRUE(std::isnan(behind[205].gap));  // its row is not there
  const std::vector<Sample>& ahead = vehicle_of(set, 7).samples;
  EXPECT_EQ(ahead[0].gap, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(ahead[190].gap));  // at 325 m of 388 m: the section ends
}

TEST(NgsimSet, TakesTheLeadThatThePairsTell) {
  NgsimTable table = busy_section();
  std::vector<NgsimRow> follower = drive(8, 2, 3000);
  for (NgsimRow& row : follower) {
    row.preceding = 9;
    row.lead_along = row.along + 30.0;
    row.lead_length = 10.0;
    row.lead_speed = 14.0;
  }
  follower[60].lead_along += 100.0;
  add(table, follower);
  const std::vector<Sample> samples = vehicle_of(set_of_ngsim(table, "f"), 8).samples;
  EXPECT_NEAR(samples[50].gap, 20.0, 1e-9);
  EXPECT_EQ(samples[50].lead_speed, 14.0);
  EXPECT_TRUE(std::isinf(samples[60].gap));
}

TEST(NgsimSet, SplitsTracksWhereFramesOrSizesBreak) {
  NgsimTable table = busy_section();
  std::vector<NgsimRow> gap = drive(7, 2, 3000);
  gap.erase(gap.begin() + 100);
  std::vector<NgsimRow> two_of_one_number = drive(8, 2, 3000);
  for (std::size_t k = 150; k < two_of_one_number.size(); ++k) {
    two_of_one_number[k].length = 6.0;
  }
  add(table, gap);
  add(table, two_of_one_number);
  add(table, drive(9, 2, 3000, 0.0, 9));
  const RecordedSet set = set_of_ngsim(table, "f");
  std::map<std::int64_t, std::vector<std::size_t>> sizes;
  for (const RecordedVehicle& vehicle : set.recordings[0].vehicles) {
    sizes[vehicle.id].push_back(vehicle.samples.size());
  }
  EXPECT_EQ(sizes[7], (std::vector<std::size_t>{100, 159}));
  EXPECT_EQ(sizes[8], (std::vector<std::size_t>{150, 110}));
  EXPECT_EQ(sizes.count(9), 0U);
  EXPECT_EQ(set.skipped.at("vehicle: fewer than 10 samples on end"), 1U);
}

TEST(NgsimSet, OrderDoesNotMatterAndSecondRowsAreCounted) {
  NgsimTable table = busy_section();
  NgsimTable shuffled = table;
  std::vector<NgsimRow>& rows = shuffled.recordings[here];
  std::reverse(rows.begin(), rows.end());
  rows.push_back(rows[17]);
  const RecordedSet one = set_of_ngsim(table, "f");
  const RecordedSet other = set_of_ngsim(shuffled, "f");
  EXPECT_EQ(other.skipped.at("row: a vehicle's second in one frame"), 1U);
  const std::vector<Sample>& a = vehicle_of(one, 104).samples;
  const std::vector<Sample>& b = vehicle_of(other, 104).samples;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].offset, b[k].offset);
    EXPECT_EQ(a[k].X_WA.p.x, b[k].X_WA.p.x);
  }
}

TEST(NgsimSet, EachRecordingIsAGroupOfItsOwn) {
  NgsimTable table = busy_section();
  table.recordings[{"us101", 20}] = table.recordings[here];
  table.recordings[{"i80", 20}] = table.recordings[here];
  const RecordedSet set = set_of_ngsim(table, "f");
  ASSERT_EQ(set.recordings.size(), 3U);
  EXPECT_EQ(set.recordings[0].group, "i80-1");
  EXPECT_EQ(set.recordings[1].group, "us101-1");
  EXPECT_EQ(set.recordings[2].group, "us101-2");
  EXPECT_EQ(set.recordings[1].name, "f minute 5");
}

TEST(NgsimSet, AStandingVehicleHasTheLanesHeading) {
  NgsimTable table = busy_section();
  std::vector<NgsimRow> standing = drive(7, 2, 3000);
  for (NgsimRow& row : standing) {
    row.along = 200.0;
    row.speed = 0.0;
  }
  add(table, standing);
  const std::vector<Sample> samples = vehicle_of(set_of_ngsim(table, "f"), 7).samples;
  EXPECT_EQ(samples[100].heading, 0.0);
  EXPECT_NEAR(samples[100].offset, 0.0, 1e-9);
}

}  // namespace
}  // namespace saca::recordings::ngsim_set_test
