#include "saca/lab/importers/hundred_car.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "saca/base/core/contract.h"
#include "saca/lab/scenario/motion.h"

namespace saca::importers::hundred_car_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path testdata = "saca/lab/recordings/testdata";  // tests run in the project folder

recordings::HundredCarEvent straight_event() {
  recordings::HundredCarEvent event;
  event.start_sync = 1100;
  event.end_sync = 1140;
  event.severity = "Near-Crash";
  event.nature = "Rear-end, striking";
  event.reaction = "Braking (no lockup)";
  event.surface = "Wet";
  event.flow = "Divided (median strip or barrier)";
  event.lanes = "3";
  event.alignment = "Straight level";
  event.lead_type = "Automobile";
  return event;
}

/// Ego at 20 m/s; the vehicle ahead at 20 m/s too, 40 m ahead (bumper to bumper), braking with
/// 4 m/s^2 from 10 s on until it stands; a follower 15 m behind at 20 m/s. Gyro bias 1 deg/s.
struct Truth {
  static constexpr double v = 20.0;
  static double lead_way(double t) {
    const double braking = std::max(0.0, std::min(t - 10.0, 5.0));
    const double coasting = std::min(t, 10.0);
    return v * coasting + v * braking - 2.0 * braking * braking;
  }
  static double lead_speed(double t) { return t < 10.0 ? v : std::max(0.0, v - 4.0 * (t - 10.0)); }
  static double gap(double t) { return 40.0 + lead_way(t) - v * t; }
};

std::vector<recordings::HundredCarRow> rows_of_truth(unsigned seed, double noise) {
  std::mt19937 rng(seed);
  std::normal_distribution<double> normal;
  const auto error = [&normal, noise](std::mt19937& draws) { return noise * normal(draws); };
  std::vector<recordings::HundredCarRow> rows;
  for (int k = 0; Truth::gap(0.1 * k) > 1.0; ++k) {
    const double t = 0.1 * k;
    recordings::HundredCarRow row;
    row.sync = 1000 + k;
    row.speed = Truth::v;
    row.yaw_rate = 0.0174533;
    if (k % 10 != 7) {  // unseen now and then
      row.front.push_back({.id = k < 90 ? 250 : 3,
                           .range = Truth::gap(t) + error(rng),
                           .rate = Truth::lead_speed(t) - Truth::v + error(rng),
                           .azimuth = 0.01 * error(rng)});
    }
    row.rear.push_back(
        {.id = 40, .range = 15.0 + error(rng), .rate = error(rng), .azimuth = 0.01 * error(rng)});
    rows.push_back(row);
  }
  return rows;
}

TEST(RebuildHundredCar, FindsTheTruthBehindTheRadar) {
  const std::vector<recordings::HundredCarRow> rows = rows_of_truth(1, 0.2);
  const auto made = rebuild_hundred_car(rows, straight_event(), {.event = 7});
  ASSERT_TRUE(made.has_value()) << made.error().message;
  const scenario::Scenario& scenario = made.value().scenario;
  ASSERT_EQ(scenario.actors.size(), 2U);
  const auto& ego = std::get<scenario::Recording>(scenario.ego);
  const auto& lead = std::get<scenario::Recording>(scenario.actors[0].motion);
  const auto& follower = std::get<scenario::Recording>(scenario.actors[1].motion);
  ASSERT_EQ(lead.size(), rows.size());
  // Front bumper 2.25 m ahead of the ego's centre of mass, rear 2.45 m behind; an assumed car is
  // 4.8 m long.
  for (std::size_t k = 0; k < lead.size(); ++k) {
    const double t = 0.1 * static_cast<double>(k);
    EXPECT_NEAR(ego[k].X_WA.p.x, 20.0 * t, 0.01);
    EXPECT_NEAR(ego[k].X_WA.p.y, 0.0, 0.05);
    EXPECT_NEAR(lead[k].X_WA.p.x, 2.25 + 40.0 + 2.4 + Truth::lead_way(t), 0.4) << t;
    EXPECT_NEAR(lead[k].speed, Truth::lead_speed(t), 0.8) << t;  // the corner at 10 s is rounded
    EXPECT_NEAR(follower[k].X_WA.p.x, 20.0 * t - 2.45 - 15.0 - 2.4, 0.4);
    EXPECT_NEAR(follower[k].speed, 20.0, 0.5);
  }
  EXPECT_NEAR(made.value().report.gyro_bias, 0.0174533, 1e-6);  // the median, and no curvature
  EXPECT_EQ(made.value().report.curvature, 0.0);
  EXPECT_EQ(made.value().report.lead.ids, (std::vector<std::int64_t>{250, 3}));
  EXPECT_EQ(scenario.grip, 0.6);
  EXPECT_EQ(scenario.actors[1].id, 2);  // a second car
}

TEST(RebuildHundredCar, CountsWhatItTreated) {
  std::vector<recordings::HundredCarRow> rows = rows_of_truth(2, 0.0);
  // Within the 1.2 m by which it may miss its place a tenth of a second later, so it is followed;
  // but farther than 1 m from what its neighbours predict.
  recordings::RadarTarget jumped = rows[60].front[0];
  jumped.range += 1.15;
  rows[60].front.clear();
  rows[60].front.push_back(jumped);
  rows[20].speed = std::nan("");
  const auto made = rebuild_hundred_car(rows, straight_event(), {.event = 7});
  ASSERT_TRUE(made.has_value()) << made.error().message;
  const HundredCarReport& report = made.value().report;
  EXPECT_EQ(report.lead.num_outliers, 1U);
  EXPECT_EQ(report.lead.num_seen + report.lead.num_filled, rows.size());
  EXPECT_EQ(report.num_speed_missing, 1U);
  EXPECT_EQ(report.first_row, 1);
  EXPECT_EQ(report.conflict_row, 101);  // sync 1100, the first being 1000
  EXPECT_EQ(report.last_row, static_cast<std::int64_t>(rows.size()));
  EXPECT_THAT(made.value().scenario.notes, HasSubstr("1 outliers removed"));
}

HundredCarReason reason_of(const std::vector<recordings::HundredCarRow>& rows,
                           const recordings::HundredCarEvent& event) {
  const auto judged = judged_hundred_car(rows, event, {.event = 7});
  const auto* refusal = std::get_if<HundredCarRefusal>(&judged);
  EXPECT_NE(refusal, nullptr);
  if (refusal == nullptr) {
    return HundredCarReason::unreadable;
  }
  EXPECT_THAT(refusal->message, HasSubstr("event 7: want "));
  return refusal->reason;
}

/// The rows until the bumpers are `gap` apart, and some more that go on as they did.
std::vector<recordings::HundredCarRow> rows_until(double gap) {
  std::vector<recordings::HundredCarRow> rows;
  for (int k = 0; Truth::gap(0.1 * k) > gap; ++k) {
    const double t = 0.1 * k;
    recordings::HundredCarRow row;
    row.sync = 1000 + k;
    row.speed = Truth::v;
    row.front.push_back({.id = 3,
                         .range = std::max(0.01, Truth::gap(t)),
                         .rate = Truth::lead_speed(t) - Truth::v,
                         .azimuth = 0.0});
    rows.push_back(row);
  }
  return rows;
}

// The ranges fall at 16 m/s to a centimetre and stay there: smoothed over half a second the bodies
// overlap.
TEST(JudgedHundredCar, WhoTouchesSomebodyHadACrashAndWhoDoesNotHadNone) {
  recordings::HundredCarEvent event = straight_event();
  const std::vector<recordings::HundredCarRow> close = rows_until(-3.0);
  EXPECT_EQ(reason_of(close, event), HundredCarReason::touches_in_near_crash);
  event.severity = "Crash";
  const auto crash = judged_hundred_car(close, event, {.event = 7});
  EXPECT_TRUE(std::holds_alternative<HundredCarImport>(crash));
  EXPECT_EQ(reason_of(rows_until(2.0), event), HundredCarReason::touches_nobody_in_crash);
}

/// Turns by that angle within 1 s from `from` on, > 0 to the left.
std::vector<recordings::HundredCarRow> steered(double from, double angle) {
  std::vector<recordings::HundredCarRow> rows = rows_of_truth(4, 0.0);
  for (std::size_t k = 0; k < 10; ++k) {
    rows.at(static_cast<std::size_t>(10.0 * from) + k).yaw_rate += angle;
  }
  return rows;
}

// From 11 s on he comes aside by 20 m/s * 0.05 = 1 m/s, in 3.4 s (when the bumpers are 1 m apart)
// by some 3 m: beyond the edge of a lane, and not of the next.
TEST(JudgedHundredCar, WhoLeavesTheRoadInTheConflictIsRefused) {
  EXPECT_EQ(reason_of(steered(10.5, -0.05), straight_event()), HundredCarReason::leaves_road);
  const auto left = judged_hundred_car(steered(10.5, 0.05), straight_event(), {.event = 7});
  EXPECT_TRUE(std::holds_alternative<HundredCarImport>(left));
  recordings::HundredCarEvent narrow = straight_event();
  narrow.lanes = "1";
  EXPECT_EQ(reason_of(steered(10.5, 0.05), narrow), HundredCarReason::leaves_road);
}

TEST(JudgedHundredCar, WhoSteeredToTheRightMayHaveBeenInTheSecondLane) {
  recordings::HundredCarEvent event = straight_event();
  event.reaction = "Braked and steered right";
  const auto judged = judged_hundred_car(steered(10.5, -0.05), event, {.event = 7});
  const auto* made = std::get_if<HundredCarImport>(&judged);
  ASSERT_NE(made, nullptr);
  const world::Road& road = made->scenario.road;
  EXPECT_DOUBLE_EQ(road.right_edge, -1.5 * 3.66);  // 12 ft each
  EXPECT_DOUBLE_EQ(road.left_edge, 1.5 * 3.66);
  EXPECT_THAT(made->scenario.notes, HasSubstr("second from the right"));
  event.lanes = "1";
  EXPECT_EQ(reason_of(steered(10.5, -0.05), event), HundredCarReason::leaves_road);
  event.lanes = "2";
  event.flow = "Not divided";  // one each way
  EXPECT_EQ(reason_of(steered(10.5, -0.05), event), HundredCarReason::leaves_road);
}

TEST(JudgedHundredCar, WhereHeTurnsOffAfterwardsTheScenarioEnds) {
  const std::vector<recordings::HundredCarRow> rows = steered(11.0, -0.05);
  recordings::HundredCarEvent event = straight_event();
  event.end_sync = 1110;
  const auto judged = judged_hundred_car(rows, event, {.event = 7});
  const auto* made = std::get_if<HundredCarImport>(&judged);
  ASSERT_NE(made, nullptr);
  EXPECT_LT(made->report.last_row, static_cast<std::int64_t>(rows.size()));
  EXPECT_GT(made->report.last_row, 111);
}

TEST(JudgedHundredCar, TheStudysWordsExclude) {
  const std::vector<recordings::HundredCarRow> rows = rows_of_truth(1, 0.1);
  recordings::HundredCarEvent event = straight_event();
  event.manoeuvre_before = "Changing lanes";
  EXPECT_EQ(reason_of(rows, event), HundredCarReason::leaves_lane);
  event.nature = "Sideswipe, same direction (left or right)";
  EXPECT_EQ(reason_of(rows, event), HundredCarReason::other_conflict);
  event = straight_event();
  event.nature = "Rear-end, struck";
  EXPECT_TRUE(std::holds_alternative<HundredCarImport>(judged_hundred_car(rows, event, {})));
  std::vector<recordings::HundredCarRow> alone = rows;
  for (recordings::HundredCarRow& row : alone) {
    row.rear.clear();
  }
  EXPECT_EQ(reason_of(alone, event), HundredCarReason::no_follower);
}

TEST(JudgedHundredCar, SaysThatTheMotionFitsNoLane) {
  // Half of a lane change each second: 0.2 rad/s to and fro.
  std::vector<recordings::HundredCarRow> rows = rows_of_truth(1, 0.0);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    rows[k].yaw_rate = 0.35 * std::sin(0.2 * static_cast<double>(k));
  }
  EXPECT_EQ(reason_of(rows, straight_event()), HundredCarReason::no_lane_before);
  recordings::HundredCarEvent early = straight_event();
  early.start_sync = 1005;
  EXPECT_EQ(reason_of(rows_of_truth(1, 0.0), early), HundredCarReason::no_lane_before);
}

// On a circle of 1000 m radius everybody keeps the lane: nobody leaves the road, and the one ahead
// is in the same lane, though the radar sees it aside.
TEST(JudgedHundredCar, ARoadThatBendsIsFollowed) {
  for (const double curvature : {0.001, -0.001}) {
    std::vector<recordings::HundredCarRow> rows = rows_of_truth(5, 0.0);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      rows[k].yaw_rate = curvature * Truth::v;
      for (recordings::RadarTarget& target : rows[k].front) {
        target.azimuth = 0.5 * curvature * (target.range + 4.65);  // half the angle of the chord
      }
      rows[k].rear.clear();
    }
    recordings::HundredCarEvent event = straight_event();
    event.alignment = "Curve level";
    const auto judged = judged_hundred_car(rows, event, {.event = 7});
    const auto* made = std::get_if<HundredCarImport>(&judged);
    ASSERT_NE(made, nullptr) << std::get<HundredCarRefusal>(judged).message;
    const scenario::Scenario& scenario = made->scenario;
    EXPECT_NEAR(scenario.road.curvature, curvature, 0.1 * std::abs(curvature));
    const auto& lead = std::get<scenario::Recording>(scenario.actors[0].motion);
    ASSERT_EQ(lead.size(), rows.size());
    EXPECT_NEAR(world::to_lane(scenario.road, lead[50].X_WA).d, 0.0, 0.3);
  }
}

// Whatever the rows hold, there is a scenario or a reason.
TEST(JudgedHundredCar, TakesWhateverTheRowsHold) {
  std::mt19937 rng(11);
  std::uniform_real_distribution<double> draw;
  const std::vector<recordings::HundredCarRow> good = rows_of_truth(6, 0.2);
  for (int k = 0; k < 60; ++k) {
    std::vector<recordings::HundredCarRow> rows = good;
    const double wild = std::pow(10.0, 8.0 * draw(rng) - 2.0);
    for (recordings::HundredCarRow& row : rows) {
      if (draw(rng) < 0.1) {
        row.speed = draw(rng) < 0.3 ? std::nan("") : wild * draw(rng);
        row.yaw_rate = draw(rng) < 0.3 ? std::nan("") : wild * (draw(rng) - 0.5);
        for (recordings::RadarTarget& target : row.front) {
          target.range = 1e-3 + wild * draw(rng);
          target.rate = wild * (draw(rng) - 0.5);
          target.azimuth = wild * (draw(rng) - 0.5);
        }
      }
    }
    rows.resize(1 + static_cast<std::size_t>(draw(rng) * static_cast<double>(rows.size() - 1)));
    recordings::HundredCarEvent event = straight_event();
    event.start_sync = static_cast<std::int64_t>(900.0 + 400.0 * draw(rng));
    event.end_sync = event.start_sync + static_cast<std::int64_t>(60.0 * draw(rng));
    event.lanes = draw(rng) < 0.2 ? "2000000000" : "2";
    const HundredCarRequest request{
        .event = 7, .before = 1.0 + 30.0 * draw(rng), .after = 5.0 * draw(rng)};
    EXPECT_NO_THROW({
      const auto judged = judged_hundred_car(rows, event, request);
      if (const auto* made = std::get_if<HundredCarImport>(&judged)) {
        EXPECT_TRUE(
            scenario::read_scenario(scenario::write_scenario(made->scenario), "made").has_value());
      }
    }) << k;
  }
}

TEST(RebuildHundredCar, SaysThatThereIsNoLead) {
  std::vector<recordings::HundredCarRow> rows = rows_of_truth(3, 0.1);
  for (recordings::HundredCarRow& row : rows) {
    row.front.clear();
  }
  const auto made = rebuild_hundred_car(rows, straight_event(), {.event = 7});
  ASSERT_FALSE(made.has_value());
  EXPECT_THAT(made.error().message, HasSubstr("event 7: want a lead target"));
}

TEST(RebuildHundredCar, SaysThatSpeedIsMissingForLong) {
  std::vector<recordings::HundredCarRow> rows = rows_of_truth(3, 0.1);
  for (std::size_t k = 50; k < 70; ++k) {
    rows[k].speed = std::nan("");
  }
  EXPECT_THAT(rebuild_hundred_car(rows, straight_event(), {.event = 7}).error().message,
              HasSubstr("gaps of at most 1.5 s"));
  EXPECT_THROW((void)rebuild_hundred_car({}, straight_event(), {.event = 7}), ContractViolation);
  EXPECT_THROW((void)rebuild_hundred_car(rows, straight_event(), {.before = std::nan("")}),
               ContractViolation);
}

// The excerpt of event 8911: in its row 20 (sync 4501) the ego goes at 18.85 m/s and the vehicle
// ahead is 27.9 to 28.9 m away and closes at 5.0 to 5.5 m/s (rows 19 and 21 of the file, feet to
// metres).
TEST(ImportHundredCar, ReadsTheOfficialFiles) {
  const auto made = import_hundred_car(testdata, {.event = 8911, .narrative = "Words."});
  ASSERT_TRUE(made.has_value()) << made.error().message;
  const scenario::Scenario& scenario = made.value().scenario;
  EXPECT_EQ(scenario.name, "100car_8911");
  EXPECT_EQ(scenario.provenance->event, 8911);
  EXPECT_THAT(scenario.licence, HasSubstr("CC0"));
  EXPECT_THAT(scenario.driver, HasSubstr("Braking (no lockup)"));
  EXPECT_THAT(scenario.driver, HasSubstr("\"Words.\""));
  ASSERT_EQ(scenario.actors.size(), 2U);
  EXPECT_EQ(scenario.actors[0].kind, world::ActorKind::van);
  const auto& ego = std::get<scenario::Recording>(scenario.ego);
  const auto& lead = std::get<scenario::Recording>(scenario.actors[0].motion);
  EXPECT_NEAR(ego[19].speed, 18.85, 0.4);
  EXPECT_NEAR(lead[19].X_WA.p.x - ego[19].X_WA.p.x - 2.25 - 2.7, 28.3, 0.5);
  EXPECT_NEAR(ego[19].speed - lead[19].speed, 5.2, 0.3);
  // And it is a scenario that can be read.
  const auto again = scenario::read_scenario(scenario::write_scenario(scenario), "again");
  EXPECT_TRUE(again.has_value()) << again.error().message;
}

TEST(ImportHundredCar, SaysWhatIsNotThere) {
  EXPECT_THAT(import_hundred_car(testdata, {.event = 1}).error().message,
              HasSubstr("HundredCar_Public_1.txt"));
  const fs::path file = testdata / "timeseries" / "HundredCar_Public_8911.txt";
  EXPECT_THAT(import_hundred_car(file, {.event = 8912}).error().message,
              HasSubstr("want a row of event 8912"));
  EXPECT_TRUE(import_hundred_car(file, {.event = 8911}).has_value());
  EXPECT_FALSE(import_hundred_car("/nowhere/x.txt", {.event = 8911}).has_value());
}

}  // namespace
}  // namespace saca::importers::hundred_car_test
