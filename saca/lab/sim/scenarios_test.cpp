// The scenarios that are committed: all read, none edited after the importer, and the recorded ones
// are what they claim to be.

#include <gtest/gtest.h>

#include <filesystem>

#include "saca/base/core/file.h"
#include "saca/lab/scenario/motion.h"
#include "saca/lab/scenario/scenario.h"

namespace saca::sim::scenarios_test {
namespace {

namespace fs = std::filesystem;
const fs::path folder = "scenarios";  // tests run in the project folder

scenario::Scenario loaded(const std::string& name) {
  const Result<scenario::Scenario> result = scenario::load_scenario(folder / (name + ".toml"));
  EXPECT_TRUE(result.has_value()) << result.error().message;
  return result.value();
}

TEST(Scenarios, AllReadAndComeBackTheSame) {
  std::size_t num_files = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".toml" || entry.path().filename() == "splits.toml") {
      continue;
    }
    const scenario::Scenario scenario = loaded(entry.path().stem());
    EXPECT_EQ(scenario.name, entry.path().stem());
    const std::string written = scenario::write_scenario(scenario);
    const Result<scenario::Scenario> again = scenario::read_scenario(written, "again");
    ASSERT_TRUE(again.has_value()) << again.error().message;
    EXPECT_EQ(scenario::write_scenario(again.value()), written);
    if (scenario.provenance) {
      EXPECT_EQ(read_file(entry.path()).value(), written) << "edited by hand?";
    }
    ++num_files;
  }
  EXPECT_GE(num_files, 5U);
}

// The pattern that the JSON Schema's test takes for right: one of everything.
TEST(Scenarios, OneOfEverythingIsRead) {
  const Result<scenario::Scenario> result =
      scenario::load_scenario("tests/fuzz/corpus/scenario/everything.toml");
  ASSERT_TRUE(result.has_value()) << result.error().message;
  EXPECT_EQ(result.value().actors.size(), 10U);
  EXPECT_FALSE(result.value().why.empty());
  EXPECT_NE(result.value().perception, scenario::PerceptionModel{});
}

/// Distance between the ego's nose and the tail of the vehicle ahead, when the ego goes on from
/// `since` at its speed of then [m]. Straight roads only.
double gap_going_on(const scenario::Scenario& scenario, double since, double time) {
  const world::EgoState ego = scenario::ego_at(scenario, since);
  const double nose = ego.X_WB.p.x + ego.v_B.x * (time - since) + 2.25;
  return pose_at(scenario::actor_track(scenario, 0, 0.1), time).p.x -
         0.5 * scenario.actors[0].footprint.length - nose;
}

/// Time to collision at constant speeds [s].
double conflict(const scenario::Scenario& scenario, double since, double time) {
  const double lead = velocity_at(scenario::actor_track(scenario, 0, 0.1), time).x;
  const double closing = scenario::ego_at(scenario, since).v_B.x - lead;
  return closing > 0.0 ? gap_going_on(scenario, since, time) / closing : 1e9;
}

/// First time at which the recorded ego is `limit` seconds from the vehicle ahead.
double first_below(const scenario::Scenario& scenario, double limit) {
  double time = 0.0;
  while (conflict(scenario, time, time) > limit) {
    time += 0.1;
  }
  return time;
}

TEST(Scenarios, TheNearCrashesLeadToAContactWhenTheEgoGoesOn) {
  for (const char* name : {"100car_8911", "100car_9018"}) {
    const scenario::Scenario scenario = loaded(name);
    const double preview = first_below(scenario, 5.5);
    EXPECT_GT(preview, 1.0) << name;  // the preview does not begin at once
    EXPECT_GT(scenario::ego_at(scenario, preview).v_B.x, 12.0) << name;
    double trigger = preview;
    while (conflict(scenario, preview, trigger) > 1.3 && trigger < preview + 6.0) {
      trigger += 0.1;
    }
    EXPECT_GT(trigger, preview + 1.0) << name;
    EXPECT_LT(trigger, preview + 5.5) << name;
    EXPECT_LT(gap_going_on(scenario, preview, preview + 6.0), 0.0) << name;
    // The driver got away with it: recorded, they never touch.
    const auto& lead = std::get<scenario::Recording>(scenario.actors[0].motion);
    for (const scenario::Sample& sample : lead) {
      EXPECT_GT(gap_going_on(scenario, sample.time, sample.time), 0.0) << name;
    }
  }
}

TEST(Scenarios, TheCrashEndsInContact) {
  const scenario::Scenario scenario = loaded("100car_8676");
  const double end = std::get<scenario::Recording>(scenario.actors[0].motion).back().time;
  EXPECT_NEAR(gap_going_on(scenario, end, end), 0.0, 0.3);  // the radar's last range
  EXPECT_GT(scenario::ego_at(scenario, end).v_B.x, 4.0);
}

// Facts of the paper: at T2 the ego is at 55 m after 55 / 14 = 3.9 s, the truck at the ego's lane
// after 43 / 7.5 = 5.7 s.
TEST(Scenarios, TheIntersectionIsAsPrinted) {
  const scenario::Scenario t2 = loaded("intersection_t2");
  EXPECT_NEAR(pose_at(scenario::actor_track(t2, 0, 0.01), 43.0 / 7.5).p.y, 0.0, 1e-9);
  EXPECT_NEAR(scenario::ego_at(t2, 55.0 / 14.0).X_WB.p.x, 55.0, 1e-9);
  EXPECT_NEAR(pose_at(scenario::actor_track(t2, 1, 0.01), 4.2).p.y, 4.0, 1e-9);  // as at T1
  const scenario::Scenario t1 = loaded("intersection_t1");
  EXPECT_EQ(pose_at(scenario::actor_track(t1, 0, 0.01), 0.0).p.x, 16.0);
  EXPECT_EQ(pose_at(scenario::actor_track(t1, 1, 0.01), 5.0).p.y, 4.0);
}

}  // namespace
}  // namespace saca::sim::scenarios_test
