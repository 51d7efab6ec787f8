#include <gtest/gtest.h>

#include <random>
#include <string>

#include "saca/core/units.h"
#include "saca/sim/scenario.h"

namespace saca::sim {
namespace {

/// Angles as people and importers write them: decimals in degrees.
double angle(std::mt19937& rng) {
  std::uniform_int_distribution<int> hundredths(-17'999, 18'000);
  return from_degrees(hundredths(rng) / 100.0);
}

Scenario drawn(unsigned seed) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  Scenario scenario;
  scenario.name = "drawn";
  scenario.title = "Quotes \" and \\, a tab \t, a bell \a, \xc3\xa9";
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
  for (int i = 0; i < 4; ++i) {
    ScenarioActor actor;
    actor.id = static_cast<std::uint8_t>(i + 1);
    actor.footprint = {world::Shape::box, 1.0 + any(rng), 1.0 + any(rng), 0.0};
    actor.mass = 1000.0 * any(rng) + 1.0;
    Script script;
    script.start = {100.0 + 10.0 * i, any(rng), angle(rng)};
    script.speed = i == 0 ? 0.0 : any(rng);
    script.behaviour = static_cast<Behaviour>(i);
    if (i >= 2) {
      script.acceleration = 3.0 * any(rng) + 0.1;
    }
    if (script.behaviour == Behaviour::brake) {
      script.from = any(rng);
    }
    actor.motion = script;
    scenario.actors.push_back(actor);
  }
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
    EXPECT_EQ(after.value().grip, before.grip);
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
}  // namespace saca::sim
