#include "saca/lab/eval/regulation.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "saca/base/core/units.h"
#include "saca/lab/eval/regulation_file.h"
#include "saca/lab/eval/scenes_for_test.h"
#include "saca/lab/eval/suite.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/intent/shipped_model.h"

namespace saca::eval::regulation_test {
namespace {

using testing::HasSubstr;

constexpr const char* fmvss127_path = "data/protocols/fmvss127.toml";
constexpr const char* r152_path = "data/protocols/r152.toml";

/// 4.0 x 2.0 m, its front 2.5 m ahead of the centre of mass.
constexpr world::Footprint plain_car{world::Shape::box, 4.0, 2.0, 0.5};

const Regulation& fmvss127() {
  static const Regulation regulation = load_regulation(fmvss127_path).value();
  return regulation;
}

const Regulation& r152() {
  static const Regulation regulation = load_regulation(r152_path).value();
  return regulation;
}

/// The cell of a row at a speed [km/h]; of `braking_lead` the first.
RegulationCell cell_at(const Regulation& regulation, const std::string& row, double speed) {
  for (const RegulationCell& cell : cells_of(regulation)) {
    if (regulation.rows[cell.row].name == row && std::abs(to_kmh(cell.speed) - speed) < 1e-9) {
      return cell;
    }
  }
  ADD_FAILURE() << "no cell " << row << " at " << speed;
  return {};
}

const scenario::Script& script_of(const scenario::Scenario& scenario, std::size_t actor) {
  return std::get<scenario::Script>(scenario.actors.at(actor).motion);
}

CellResult played(const Regulation& regulation, const RegulationCell& cell,
                  const std::string& method) {
  static SteadyClock clock;
  static const manoeuvre::Car car = prepare::default_car();
  static const collision::HarmModel harm = shipped_harm();
  const SuiteEncounter encounter{
      .number = 0,
      .family = "regulation",
      .scenario = scenario_of(regulation, cell, manoeuvre::footprint(car)),
      .twin = {}};
  const SuiteRow row =
      run_encounter(encounter, {.methods = {method}, .exact = true},
                    {.forecast = {&car, &harm}, .clock = &clock}, intent::shipped_model());
  EXPECT_EQ(row.fault, "");
  return judged(regulation, cell, row.risk.runs.at(0));
}

TEST(RegulationCells, EveryCellNamesItsParagraphAndMakesAScene) {
  for (const Regulation* const regulation : {&fmvss127(), &r152()}) {
    for (const RegulationCell& cell : cells_of(*regulation)) {
      const scenario::Scenario scenario = scenario_of(*regulation, cell, plain_car);
      EXPECT_THAT(scenario.source, HasSubstr(regulation->rows[cell.row].paragraph));
      EXPECT_EQ(scenario::believed_grip(scenario), 0.9);
      EXPECT_TRUE(
          scenario::read_scenario(scenario::write_scenario(scenario), scenario.name).has_value())
          << scenario.title;
    }
  }
}

// --- geometry, by hand

// S7.2: L0 = 5.0 s x 72 km/h / 3.6 = 100 m from front to rear; the front is 2.5 m ahead.
TEST(RegulationGeometry, HeadwayIsTimeToCollisionTimesClosingSpeed) {
  const Regulation& regulation = fmvss127();
  RegulationCell cell = cell_at(regulation, "stopped_lead", 80);
  cell.speed = 20.0;
  scenario::Scenario scenario = scenario_of(regulation, cell, plain_car);
  EXPECT_NEAR(script_of(scenario, 0).start.s - 0.5 * scenario.actors[0].footprint.length, 102.5,
              1e-9);
  EXPECT_EQ(std::get<scenario::EgoStart>(scenario.ego).speed, 20.0);

  // S7.4: 5.0 s x (80 - 20) / 3.6 = 83.33 m.
  scenario = scenario_of(regulation, cell_at(regulation, "slower_lead", 80), plain_car);
  EXPECT_NEAR(script_of(scenario, 0).start.s - 0.5 * scenario.actors[0].footprint.length,
              2.5 + 250.0 / 3.0, 1e-9);
  EXPECT_NEAR(script_of(scenario, 0).speed, 20.0 / 3.6, 1e-12);

  // S7.5: 12 m; brakes with 0.3 g after 3 s.
  scenario = scenario_of(regulation, cell_at(regulation, "braking_lead", 50), plain_car);
  EXPECT_NEAR(script_of(scenario, 0).start.s - 0.5 * scenario.actors[0].footprint.length, 14.5,
              1e-9);
  EXPECT_NEAR(script_of(scenario, 0).acceleration, 0.3 * 9.80665, 1e-9);
  EXPECT_EQ(script_of(scenario, 0).from, 3.0);
}

// S8.3.1: 4.0 m to the right, 5 km/h = 1.389 m/s within 1.5 m. The car is 2 m wide: 25 % of it from
// its right side is d = -0.5 m, so 3.5 m are walked: 1.5 m take 2 x 1.5 / 1.389 = 2.16 s, 2.0 m
// take 1.44 s. It sets off 4.0 - 3.6 = 0.4 s after the start.
TEST(RegulationGeometry, WhoCrossesMeetsTheFrontAtTheStatedOverlap) {
  const Regulation& regulation = fmvss127();
  const RegulationCell cell = cell_at(regulation, "crossing_right_25", 36 + 14);
  const scenario::Scenario scenario = scenario_of(regulation, cell, plain_car);
  const scenario::Script& walker = script_of(scenario, 0);
  EXPECT_EQ(walker.start.d, -4.0);
  EXPECT_NEAR(walker.from, 0.4, 1e-9);
  EXPECT_NEAR(*walker.until_speed, 5.0 / 3.6, 1e-12);
  // its near side, half a shoulder width from its middle, where the front is after 4 s
  EXPECT_NEAR(walker.start.s - 0.25, 2.5 + 4.0 * 50.0 / 3.6, 1e-9);

  // as the world plays it, nobody braking
  const manoeuvre::Car car = prepare::default_car();
  sim::Stepper stepper(scenario, car);
  while (stepper.time() < 4.0 - 1e-9) {
    stepper.advance({});
  }
  EXPECT_NEAR(stepper.scene().actors[0].X_WA.p.y, -0.5, 0.01);
  EXPECT_NEAR(stepper.scene().actors[0].v_W.y, 5.0 / 3.6, 1e-6);
}

// R152, 6.6.1 and 6.7.1: at constant speed from the start of the test on; 15 km/h for 4 s are 16.67
// m.
TEST(RegulationGeometry, WhoCrossesAtConstantSpeedIsInTheMiddleOfTheFront) {
  const scenario::Scenario scenario =
      scenario_of(r152(), cell_at(r152(), "crossing_bicycle", 40), plain_car);
  const scenario::Script& bicycle = script_of(scenario, 0);
  EXPECT_NEAR(bicycle.start.d, -15.0 / 3.6 * 4.0, 1e-9);
  EXPECT_NEAR(bicycle.start.heading, 0.5 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(bicycle.start.s - 0.25, 2.5 + 4.0 * 40.0 / 3.6, 1e-9);
}

// S8.3.3(g): 1.0 m beside the subject vehicle, 1.0 m before the child, 1.0 m from one to the other.
TEST(RegulationGeometry, ParkedCarsHideTheChild) {
  const scenario::Scenario scenario =
      scenario_of(fmvss127(), cell_at(fmvss127(), "crossing_obstructed", 50), plain_car);
  ASSERT_EQ(scenario.actors.size(), 3U);
  const double contact_plane = 2.5 + 4.0 * 50.0 / 3.6;
  const double length = scenario.actors[1].footprint.length;
  EXPECT_NEAR(script_of(scenario, 1).start.s + 0.5 * length, contact_plane - 1.0, 1e-9);
  EXPECT_NEAR(script_of(scenario, 1).start.s - script_of(scenario, 2).start.s, length + 1.0, 1e-9);
  EXPECT_NEAR(script_of(scenario, 1).start.d + 0.5 * scenario.actors[1].footprint.width, -2.0,
              1e-9);
  EXPECT_TRUE(scenario.perception.occlusion);

  const manoeuvre::Car car = prepare::default_car();
  sim::Stepper stepper(scenario, car);
  EXPECT_EQ(stepper.perceive().actors.size(), 2U);
}

// S9.3.1(b): 4.5 m between the two; R152, Annex 3, Appendix 2, 3.2: 1.6 s x 22 km/h straight ahead,
// beyond the outer edge, whose radius is 25 m about a centre that is 23.25 m to the left.
TEST(RegulationGeometry, WhatTheCarPassesIsBesideItsPath) {
  const scenario::Scenario pair =
      scenario_of(fmvss127(), cell_at(fmvss127(), "pass_between", 80), plain_car);
  ASSERT_EQ(pair.actors.size(), 2U);
  EXPECT_NEAR(
      script_of(pair, 1).start.d - script_of(pair, 0).start.d - pair.actors[0].footprint.width, 4.5,
      1e-9);

  const scenario::Scenario curve = scenario_of(r152(), cell_at(r152(), "curve_car", 22), plain_car);
  const Vec2 p = world::from_lane(curve.road, script_of(curve, 0).start).p;
  EXPECT_NEAR(p.x - 0.5 * curve.actors[0].footprint.length, 2.5 + 1.6 * 22.0 / 3.6, 1e-6);
  EXPECT_NEAR(p.y, 0.0, 1e-6);
  EXPECT_GT(std::hypot(p.x, p.y - 23.25), 25.0);
}

// S6.2.2, read in two ways.
TEST(RegulationGeometry, TheSurfaceIsTheOneThatIsChosen) {
  Regulation regulation = fmvss127();
  const RegulationCell cell = cell_at(regulation, "stopped_lead", 80);
  EXPECT_EQ(scenario_of(regulation, cell, plain_car).grip, 0.9);
  regulation.surface = 1;
  EXPECT_EQ(scenario_of(regulation, cell, plain_car).grip, 1.02);
}

// --- verdicts

MethodRun run_with(double ego_speed, double impact_speed, double peak) {
  MethodRun run;
  if (impact_speed > 0.0) {
    run.met = "car1";
  }
  run.ego_speed = ego_speed;
  run.impact_speed = impact_speed;
  run.peak_deceleration = peak;
  return run;
}

// S5.3: what exceeds by 0.25 g or more fails.
TEST(RegulationVerdict, FalseActivationIsAQuarterOfGOrMore) {
  const RegulationCell cell = cell_at(fmvss127(), "pass_between", 80);
  EXPECT_EQ(judged(fmvss127(), cell, run_with(0, 0, 0.2499 * 9.80665)).verdict,
            TestVerdict::passed);
  EXPECT_EQ(judged(fmvss127(), cell, run_with(0, 0, 0.25 * 9.80665)).verdict,
            TestVerdict::false_reaction);
  const RegulationCell curve = cell_at(r152(), "curve_car", 22);
  MethodRun acted = run_with(0, 0, 0.1);
  EXPECT_EQ(judged(r152(), curve, acted).verdict, TestVerdict::passed);
  acted.acted_at = 0.2;
  EXPECT_EQ(judged(r152(), curve, acted).verdict, TestVerdict::false_reaction);
}

TEST(RegulationVerdict, ContactCountsWhileTheCarMovesAndImpactSpeedUpToTheLimit) {
  const RegulationCell crossing = cell_at(fmvss127(), "crossing_right_50", 50);
  // the pedestrian walks on into the car that stands: S8.3.6, the test was over
  EXPECT_EQ(judged(fmvss127(), crossing, run_with(0.0, 1.4, 8.0)).verdict, TestVerdict::passed);
  EXPECT_EQ(judged(fmvss127(), crossing, run_with(2.0, 2.4, 8.0)).verdict, TestVerdict::contact);
  EXPECT_EQ(judged(fmvss127(), crossing, run_with(2.0, 2.4, 8.0)).impact_speed, 2.0);
  // 45 km/h: up to 15 km/h; of cars ahead the relative speed counts
  const RegulationCell lead = cell_at(r152(), "stopped_lead", 45);
  EXPECT_EQ(judged(r152(), lead, run_with(4.1, 14.9 / 3.6, 8.0)).verdict, TestVerdict::passed);
  EXPECT_EQ(judged(r152(), lead, run_with(4.1, 15.1 / 3.6, 8.0)).verdict, TestVerdict::contact);
  // nobody touched, but nobody braked
  EXPECT_EQ(judged(r152(), lead, run_with(0.0, 0.0, 0.5)).verdict, TestVerdict::no_braking);
  MethodRun thrown = run_with(0.0, 0.0, 8.0);
  thrown.fault = "thrown";
  EXPECT_EQ(judged(r152(), lead, thrown).verdict, TestVerdict::fault);
}

// By hand: 1.3 s from 80 km/h are 28.9 m. With 0.1 s until the brakes hold (2.2 m) and 8.25 m/s2
// after that, which are 95 % of 0.9 g less what stops from these speeds lose at first, 22.2^2 - 2
// x 8.25 x 26.7 leaves 7.3 m/s; from 70 km/h 22.9 m are needed and 23.3 m are there.
TEST(RegulationPlayed, BrakingAtT1StopsFrom70ButNotFrom80KilometresAnHour) {
  const CellResult slower = played(fmvss127(), cell_at(fmvss127(), "stopped_lead", 70), "aeb");
  EXPECT_EQ(slower.verdict, TestVerdict::passed);
  EXPECT_GT(slower.peak_deceleration, 8.0);
  EXPECT_LT(slower.peak_deceleration, 0.9 * 9.81 * 1.02);
  const CellResult faster = played(fmvss127(), cell_at(fmvss127(), "stopped_lead", 80), "aeb");
  EXPECT_EQ(faster.verdict, TestVerdict::contact);
  EXPECT_NEAR(faster.impact_speed, 7.3, 0.4);
}

TEST(RegulationPlayed, NobodyBrakesBetweenParkedCarsAndNobodyStopsByDoingNothing) {
  EXPECT_EQ(played(fmvss127(), cell_at(fmvss127(), "pass_between", 80), "aeb").verdict,
            TestVerdict::passed);
  const CellResult nothing = played(fmvss127(), cell_at(fmvss127(), "standing", 40), "nothing");
  EXPECT_EQ(nothing.verdict, TestVerdict::contact);
  EXPECT_NEAR(nothing.impact_speed, 40.0 / 3.6, 0.02);  // 10 ms between two looks
}

}  // namespace
}  // namespace saca::eval::regulation_test
