#include "saca/lab/regulation/regulation_json.h"

#include <gtest/gtest.h>

#include "saca/lab/regulation/run_for_test.h"

namespace saca::regulation::regulation_json_test {
namespace {

using nlohmann::json;

TEST(RegulationJson, CountsAllCarsAndRows) {
  const json out = json_of(some_run());
  EXPECT_EQ(out["meta.command"], "saca suite r1");
  EXPECT_EQ(out["suite.r1.n"], 8);
  EXPECT_EQ(out["suite.r1.aeb.passed"], 5);
  EXPECT_EQ(out["suite.r1.aeb.passed.n"], 8);
  EXPECT_EQ(out["suite.r1.aeb.passed_share"], 0.625);
  EXPECT_EQ(out["suite.r1.aeb.faults"], 0);
  EXPECT_EQ(out["suite.r1.nothing.faults"], 1);
  EXPECT_EQ(out["suite.r1.aeb.worst_impact_mps"], 12.0);
  EXPECT_EQ(out["suite.r1.aeb.small.passed"], 3);
  EXPECT_EQ(out["suite.r1.aeb.standing_car.passed_share"], 0.25);
  EXPECT_EQ(out["suite.r1.cells"].size(), 16U);
}

TEST(RegulationJson, ACellSaysWhatWasAllowedAndWhatHappened) {
  RegulationRun run = some_run();
  run.results[1].plan = manoeuvre::Plan{manoeuvre::PolicyId::aeb, std::nullopt};
  run.results[1].acted_at = 1.5;
  const json cells = json_of(run)["suite.r1.cells"];
  // By method, car and cell: AEB's begin behind the eight of "nothing".
  const json& first = cells[8];
  EXPECT_EQ(first["method"], "aeb");
  EXPECT_EQ(first["car"], "small");
  EXPECT_EQ(first["row"], "standing_car");
  EXPECT_EQ(first["paragraph"], "7.1");
  EXPECT_EQ(first["speed_kmh"], 36.0);
  EXPECT_EQ(first["limit"], "no_contact");
  EXPECT_EQ(first["passed"], true);
  EXPECT_EQ(first["policy"], manoeuvre::name(manoeuvre::PolicyId::aeb));
  EXPECT_EQ(first["acted_at_s"], 1.5);
  EXPECT_FALSE(first.contains("allowed_impact_speed_mps"));
  EXPECT_FALSE(first.contains("headway_m"));
  const json& hit = cells[9];
  EXPECT_EQ(hit["verdict"], "contact");
  EXPECT_EQ(hit["impact_speed_mps"], 8.0);
  EXPECT_TRUE(hit["policy"].is_null());
  EXPECT_TRUE(hit["acted_at_s"].is_null());
  EXPECT_EQ(cells[10]["allowed_impact_speed_mps"], 2.5);
  EXPECT_EQ(cells[10]["manual_braking"], true);
  EXPECT_NEAR(cells[11]["allowed_deceleration_mps2"].get<double>(), 0.25 * 9.80665, 1e-9);
  EXPECT_EQ(cells[3]["fault"], "it threw");
}

TEST(RegulationJson, TellsOfALeadThatBrakes) {
  eval::Regulation text = some_run().regulation;
  text.rows = {{.name = "braking_lead",
                .title = "A car brakes",
                .kind = eval::TestKind::braking_lead,
                .paragraph = "7.4",
                .speeds = {10.0},
                .headways = {12.0},
                .decelerations = {from_g(0.5)}}};
  const json cell = json_of(tests_of(text, {"small"}, {"aeb"}))["suite.r1.cells"][0];
  EXPECT_EQ(cell["headway_m"], 12.0);
  EXPECT_DOUBLE_EQ(cell["lead_deceleration_g"].get<double>(), 0.5);
}

TEST(RegulationJson, FurtherSurfacesHaveTheirOwnCounts) {
  RegulationRun run = some_run();
  run.elsewhere.push_back(on_the_second_surface());
  const json out = json_of(run);
  EXPECT_EQ(out["suite.r1.aeb.wet.passed"], 7);
  EXPECT_EQ(out["suite.r1.aeb.wet.passed.n"], 8);
}

}  // namespace
}  // namespace saca::regulation::regulation_json_test
