#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "saca/base/core/units.h"
#include "saca/lab/scenario/scenario.h"

namespace saca::scenario::scenario_writer_test {
namespace {

/// Angles as people and importers write them: decimals in degrees.
double angle(std::mt19937& rng) {
  std::uniform_int_distribution<int> hundredths(-17'999, 18'000);
  return from_degrees(hundredths(rng) / 100.0);
}

Script drawn_script(Behaviour behaviour, double s, std::mt19937& rng) {
  std::uniform_real_distribution<double> any(0.0, 1.0);
  Script script{.start = {s, any(rng), angle(rng)}, .speed = any(rng), .behaviour = behaviour};
  script.from = any(rng);
  script.acceleration = 3.0 * any(rng) + 0.1;
  switch (behaviour) {
    case Behaviour::hold:
      return {.start = script.start, .behaviour = behaviour};
    case Behaviour::constant_velocity:
      return {.start = script.start, .speed = script.speed, .behaviour = behaviour};
    case Behaviour::accelerate:
      script.until_speed = 1.0 + any(rng);
      break;
    case Behaviour::brake:
      break;
    case Behaviour::lane_change:
      script.start.heading = std::numbers::pi;
      script.speed = 10.0 + any(rng);
      script.to_d = 2.0 * any(rng);
      script.takes = 3.0 + any(rng);
      script.acceleration = any(rng);
      break;
    case Behaviour::follow:
      script.start.heading = 0.0;
      script.acceleration = 0.0;
      script.from = 0.0;
      script.law = drivers::usual_driver(10.0 * any(rng));
      script.law.time_gap = any(rng);
      break;
    case Behaviour::walk:
      script.acceleration = 0.0;
      script.then = Deed::run;
      script.chance_stop = 0.5 * any(rng);
      script.run_speed = 2.0 + any(rng);
      break;
  }
  return script;
}

Scenario drawn(unsigned seed) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  Scenario scenario;
  scenario.name = "drawn";
  scenario.title = "Quotes \" and \\, a tab \t, a bell \a, \xc3\xa9";
  scenario.why = "Because \"it\" matters";
  scenario.source = "line one\nline \"\"\"two\"\"\"\n";
  scenario.licence = "CC0";
  scenario.car = "compact_rwd_ev";
  scenario.grip = 0.3 + 0.6 * any(rng);
  scenario.provenance = Provenance{8911, 5, 77};
  scenario.road.curvature = 0.01 * any(rng);
  scenario.road.X_WL = {{any(rng), any(rng)}, angle(rng)};
  Recording ego;
  for (int k = 0; k < 40; ++k) {
    ego.push_back({0.1 * k, {{any(rng) + k, any(rng)}, angle(rng)}, 20.0 * any(rng), angle(rng)});
  }
  scenario.ego = ego;
  for (int i = 0; i < 8; ++i) {
    ScenarioActor actor;
    actor.id = static_cast<std::uint8_t>(i + 1);
    actor.kind = i == 7 ? world::ActorKind::bicycle : world::ActorKind::car;
    actor.footprint = {world::Shape::box, 1.0 + any(rng), 1.0 + any(rng), 0.0};
    actor.mass = 300.0 + 200.0 * any(rng);
    actor.motion = drawn_script(static_cast<Behaviour>(std::min(i, 6)), 100.0 + 10.0 * i, rng);
    scenario.actors.push_back(actor);
  }
  scenario.actors[6].kind = world::ActorKind::pedestrian;
  scenario.actors[3].ghost = true;
  scenario.actors[3].existence = 0.3;
  ScenarioActor wall{.id = 9, .kind = world::ActorKind::obstacle, .mass = 1e5};
  wall.footprint = {.shape = world::Shape::segment, .length = 12.5};
  wall.motion = Script{.start = {200.0, 5.0, angle(rng)}, .behaviour = Behaviour::hold};
  scenario.actors.push_back(wall);
  scenario.cues = {{world::CueKind::parked_vans, {any(rng), any(rng)}},
                   {world::CueKind::low_sun, {any(rng), any(rng)}}};
  scenario.perception = {.position_sd = any(rng),
                         .heading_sd = std::abs(angle(rng)),
                         .latency = any(rng),
                         .range = 80.0,
                         .occlusion = true,
                         .grip_believed = 0.5,
                         .grip_sd = any(rng)};
  return scenario;
}

void expect_same(const Recording& a, const Recording& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].time, b[k].time);
    EXPECT_EQ(a[k].X_WA.p.x, b[k].X_WA.p.x);
    EXPECT_EQ(a[k].X_WA.yaw, b[k].X_WA.yaw);
    EXPECT_EQ(a[k].speed, b[k].speed);
    EXPECT_EQ(a[k].yaw_rate, b[k].yaw_rate);
  }
}

TEST(WriteScenario, ComesBackBitByBit) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Scenario before = drawn(seed);
    const std::string text = write_scenario(before);
    const Result<Scenario> after = read_scenario(text, "drawn");
    ASSERT_TRUE(after.has_value()) << after.error().message << "\n" << text;
    EXPECT_EQ(write_scenario(after.value()), text);
    EXPECT_EQ(after.value().title, before.title);
    EXPECT_EQ(after.value().source, before.source);
    EXPECT_EQ(after.value().why, before.why);
    EXPECT_EQ(after.value().perception, before.perception);
    EXPECT_EQ(after.value().grip, before.grip);
    ASSERT_EQ(after.value().cues.size(), 2U);
    EXPECT_EQ(after.value().cues[1].kind, world::CueKind::low_sun);
    EXPECT_EQ(after.value().cues[1].p_W.x, before.cues[1].p_W.x);
    EXPECT_EQ(after.value().road.X_WL.yaw, before.road.X_WL.yaw);
    EXPECT_EQ(after.value().provenance->last_row, 77);
    expect_same(std::get<Recording>(after.value().ego), std::get<Recording>(before.ego));
    ASSERT_EQ(after.value().actors.size(), before.actors.size());
    for (std::size_t i = 0; i < before.actors.size(); ++i) {
      const auto& a = std::get<Script>(after.value().actors[i].motion);
      const auto& b = std::get<Script>(before.actors[i].motion);
      EXPECT_EQ(a.start.s, b.start.s);
      EXPECT_EQ(a.start.heading, b.start.heading);
      EXPECT_EQ(a.speed, b.speed);
      EXPECT_EQ(a.behaviour, b.behaviour);
      EXPECT_EQ(a.acceleration, b.acceleration);
      EXPECT_EQ(a.from, b.from);
      EXPECT_EQ(a.until_speed, b.until_speed);
      EXPECT_EQ(a.to_d, b.to_d);
      EXPECT_EQ(a.takes, b.takes);
      EXPECT_EQ(a.then, b.then);
      EXPECT_EQ(a.chance_stop, b.chance_stop);
      EXPECT_EQ(a.chance_run, b.chance_run);
      EXPECT_EQ(a.run_speed, b.run_speed);
      EXPECT_EQ(a.law.desired_speed, b.law.desired_speed);
      EXPECT_EQ(a.law.time_gap, b.law.time_gap);
      EXPECT_EQ(a.law.reaction, b.law.reaction);
      EXPECT_EQ(a.law.hardest, b.law.hardest);
      EXPECT_EQ(after.value().actors[i].ghost, before.actors[i].ghost);
      EXPECT_EQ(after.value().actors[i].existence, before.actors[i].existence);
      EXPECT_EQ(after.value().actors[i].footprint.shape, before.actors[i].footprint.shape);
      EXPECT_EQ(after.value().actors[i].mass, before.actors[i].mass);
    }
  }
}

TEST(WriteScenario, KeepsShortDecimalsShort) {
  Scenario scenario = drawn(1);
  scenario.road.X_WL.yaw = from_degrees(-90.0);
  scenario.grip = 0.9;
  const std::string text = write_scenario(scenario);
  EXPECT_NE(text.find("heading_deg = -90\n"), std::string::npos);
  EXPECT_NE(text.find("grip = 0.9\n"), std::string::npos);
}

}  // namespace
}  // namespace saca::scenario::scenario_writer_test
