#include "saca/lab/scenario/scenario.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <utility>

namespace saca::scenario::scenario_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string crossing = R"(schema = "saca.scenario/1"
name = "crossing_1"
title = "A truck crosses"
source = "written for this test"
licence = "CC0-1.0"
car = "compact_rwd_ev"
grip = 0.9
duration_s = 8

[road]
topology = "intersection"
x_m = 0
y_m = 0
heading_deg = 0
curvature_1pm = 0
lane_width_m = 3.5
left_edge_m = 5.25
right_edge_m = -1.75
left_beyond = "kerb"
right_beyond = "unmarked"
oncoming_left = true

[ego.start]
s_m = 0
d_m = 0
heading_deg = 0
speed_mps = 14

[[actors]]
kind = "truck"
id = 1
shape = "box"
length_m = 8
width_m = 2.5
mass_kg = 12000

[actors.start]
s_m = 55
d_m = 43
heading_deg = -90
speed_mps = 7.5
behaviour = "brake"
deceleration_mps2 = 4
brake_at_s = 1.5

[[actors]]
kind = "car"
id = 1
shape = "box"
length_m = 4.6
width_m = 1.8
mass_kg = 1500

[actors.recording]
t_s = [0, 0.1, 0.2]
x_m = [30, 31, 32]
y_m = [0, 0, 0.1]
heading_deg = [0, 1, 2]
speed_mps = [10, 10, 10]
)";

/// The text with `from` replaced once.
std::string with(std::string_view from, std::string_view to) {
  std::string text = crossing;
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string problem(std::string_view from, std::string_view to) {
  const Result<Scenario> result = read_scenario(with(from, to), "x.toml");
  return result.has_value() ? "no problem" : result.error().message;
}

TEST(ReadScenario, HoldsWhatTheFileSays) {
  const Result<Scenario> result = read_scenario(crossing, "x.toml");
  ASSERT_TRUE(result.has_value()) << result.error().message;
  const Scenario& scenario = result.value();
  EXPECT_EQ(scenario.name, "crossing_1");
  EXPECT_EQ(scenario.road.topology, world::Topology::intersection);
  EXPECT_TRUE(scenario.road.oncoming_left);
  EXPECT_FALSE(scenario.road.oncoming_right);
  EXPECT_EQ(std::get<EgoStart>(scenario.ego).speed, 14.0);
  ASSERT_EQ(scenario.actors.size(), 2U);
  const auto& script = std::get<Script>(scenario.actors[0].motion);
  EXPECT_EQ(script.behaviour, Behaviour::brake);
  EXPECT_EQ(script.acceleration, 4.0);
  EXPECT_EQ(script.from, 1.5);
  EXPECT_DOUBLE_EQ(script.start.heading, -std::numbers::pi / 2.0);
  const auto& recording = std::get<Recording>(scenario.actors[1].motion);
  ASSERT_EQ(recording.size(), 3U);
  EXPECT_EQ(recording[2].X_WA.p.y, 0.1);
  EXPECT_DOUBLE_EQ(recording[2].X_WA.yaw, std::numbers::pi / 90.0);
  EXPECT_FALSE(scenario.provenance.has_value());
}

TEST(ReadScenario, HoldsCues) {
  const std::string cue = "[[cues]]\nkind = \"bus_at_stop\"\nx_m = 12\ny_m = -4.5\n\n[[actors]]";
  const Result<Scenario> result = read_scenario(with("[[actors]]", cue), "x.toml");
  ASSERT_TRUE(result.has_value()) << result.error().message;
  ASSERT_EQ(result.value().cues.size(), 1U);
  EXPECT_EQ(result.value().cues[0].kind, world::CueKind::bus_at_stop);
  EXPECT_EQ(result.value().cues[0].p_W.y, -4.5);
  std::string tram = cue;
  tram.replace(tram.find("bus_at_stop"), 11, "tram");
  EXPECT_THAT(problem("[[actors]]", tram), HasSubstr("kind: want school_zone, bus_at_stop"));
  std::string many;
  for (std::size_t k = 0; k <= world::max_cues; ++k) {
    many += "[[cues]]\nkind = \"low_sun\"\nx_m = 12\ny_m = -4.5\n\n";
  }
  EXPECT_THAT(problem("[[actors]]", many + "[[actors]]"), HasSubstr("cues: want at most 4, got 5"));
}

TEST(ReadScenario, NamesFileLineAndKeyOfAnUnknownKey) {
  EXPECT_THAT(problem("grip = 0.9", "grip = 0.9\ngripp = 1"),
              AllOf(HasSubstr("x.toml:8"), HasSubstr("gripp"), HasSubstr("unknown key")));
  EXPECT_THAT(problem("[ego.start]", "[ego.start]\nlane = 2"), HasSubstr("lane: unknown key"));
}

TEST(ReadScenario, TellsWhichUnitWasWanted) {
  EXPECT_THAT(problem("speed_mps = 14", "speed_kmh = 50"),
              AllOf(HasSubstr("speed_mps"), HasSubstr("speed_kmh")));
  EXPECT_THAT(problem("heading_deg = -90", "heading_rad = -1.57"),
              AllOf(HasSubstr("heading_deg"), HasSubstr("heading_rad")));
}

TEST(ReadScenario, RefusesWhatIsNoNumber) {
  for (const char* bad : {"nan", "inf", "-inf", "\"14\"", "true", "[14]"}) {
    EXPECT_THAT(problem("speed_mps = 14", std::string("speed_mps = ") + bad),
                HasSubstr("speed_mps: want"))
        << bad;
  }
  EXPECT_THAT(problem("x_m = [30, 31, 32]", "x_m = [30, nan, 32]"), HasSubstr("x_m: want"));
}

TEST(ReadScenario, RefusesWhatCannotBe) {
  EXPECT_THAT(problem("speed_mps = 14", "speed_mps = -1"), HasSubstr("got -1"));
  EXPECT_THAT(problem("width_m = 2.5", "width_m = 0"), HasSubstr("width_m"));
  EXPECT_THAT(problem("mass_kg = 1500", "mass_kg = 0"), HasSubstr("mass_kg"));
  EXPECT_THAT(problem("mass_kg = 1500", "mass_kg = 1.5"),  // in tonnes
              HasSubstr("mass_kg: want 300 to 10000, got 1.5"));
  EXPECT_THAT(problem("mass_kg = 12000", "mass_kg = 12"),
              HasSubstr("mass_kg: want 1000 to 100000, got 12"));
  EXPECT_THAT(problem("grip = 0.9", "grip = 0"), HasSubstr("grip"));
  EXPECT_THAT(problem("duration_s = 8", "duration_s = 0"), HasSubstr("duration_s"));
  EXPECT_THAT(problem("\"saca.scenario/1\"", "\"saca.scenario/2\""), HasSubstr("schema"));
  EXPECT_THAT(problem("\"crossing_1\"", "\"../crossing\""), HasSubstr("name"));
  EXPECT_THAT(problem("\"truck\"", "\"lorry\""), HasSubstr("got \"lorry\""));
  EXPECT_THAT(problem("\"brake\"", "\"stop\""), HasSubstr("got \"stop\""));
  EXPECT_THAT(problem("\"brake\"", "\"hold\""), HasSubstr("speed_mps"));
  EXPECT_THAT(problem("\"box\"", "\"disc\""), HasSubstr("got \"disc\""));
}

TEST(ReadScenario, HoldsWhatIsPerceived) {
  const PerceptionModel perfect = read_scenario(crossing, "x.toml").value().perception;
  EXPECT_EQ(perfect, PerceptionModel{});
  const std::string text =
      with("[ego.start]",
           "[perception]\nposition_sd_m = 0.3\nvelocity_sd_mps = 0.2\nheading_sd_deg = 180\n"
           "correlation_s = 2\nlatency_s = 0.2\ndropout = 0.1\nrange_m = 80\nocclusion = true\n"
           "confirmation_s = 0.3\nmemory_s = 1\ngrip_believed = 0.7\ngrip_sd = 0.1\n\n[ego.start]");
  const Result<Scenario> result = read_scenario(text, "x.toml");
  ASSERT_TRUE(result.has_value()) << result.error().message;
  const PerceptionModel expected{.position_sd = 0.3,
                                 .velocity_sd = 0.2,
                                 .heading_sd = std::numbers::pi,
                                 .correlation_time = 2.0,
                                 .latency = 0.2,
                                 .dropout = 0.1,
                                 .range = 80.0,
                                 .occlusion = true,
                                 .confirmation = 0.3,
                                 .memory = 1.0,
                                 .grip_believed = 0.7,
                                 .grip_sd = 0.1};
  EXPECT_EQ(result.value().perception, expected);
}

TEST(ReadScenario, HoldsGhostsWallsAndWhy) {
  const Scenario ghost =
      read_scenario(with("mass_kg = 12000", "mass_kg = 12000\nghost = true\nexistence = 0.4"),
                    "x.toml")
          .value();
  EXPECT_TRUE(ghost.actors[0].ghost);
  EXPECT_EQ(ghost.actors[0].existence, 0.4);
  EXPECT_FALSE(ghost.actors[1].ghost);
  EXPECT_EQ(ghost.actors[1].existence, 1.0);
  const Scenario why =
      read_scenario(with("source =", "why = \"it cannot stop\"\nsource ="), "x.toml").value();
  EXPECT_EQ(why.why, "it cannot stop");
  const std::string wall = crossing + R"(
[[actors]]
kind = "obstacle"
id = 1
shape = "segment"
length_m = 20
mass_kg = 10000

[actors.start]
s_m = 100
d_m = 4
heading_deg = 5
speed_mps = 0
behaviour = "hold"
)";
  EXPECT_EQ(read_scenario(wall, "x.toml").value().actors[2].footprint.shape, world::Shape::segment);
}

TEST(ReadScenario, NamesWhatIsWrongInTheNewKeys) {
  const auto perception = [](const char* line) {
    return problem("[ego.start]", std::string("[perception]\n") + line + "\n\n[ego.start]");
  };
  for (const auto& [line, message] :
       {std::pair{"position_sd_m = -1", "position_sd_m: want 0 to 100, got -1"},
        std::pair{"dropout = 1.5", "dropout: want 0 to 1, got 1.5"},
        std::pair{"latency_ms = 200", "latency_ms: unknown key"},
        std::pair{"range_m = 0", "range_m: want"},
        std::pair{"range_m = inf", "range_m: want 0.1 to 1e+06, got inf"},
        std::pair{"occlusion = 1", "occlusion: want"}, std::pair{"grip_believed = 0", "got 0"},
        std::pair{"memory_s = nan", "memory_s: want"}}) {
    EXPECT_THAT(perception(line), AllOf(HasSubstr("x.toml:"), HasSubstr(message))) << line;
  }
  EXPECT_THAT(problem("mass_kg = 12000", "mass_kg = 12000\nghost = true"),
              AllOf(HasSubstr("existence"), HasSubstr("missing")));
  EXPECT_THAT(problem("mass_kg = 12000", "mass_kg = 12000\nghost = true\nexistence = 0"),
              HasSubstr("existence: want"));
  EXPECT_THAT(problem("mass_kg = 12000", "mass_kg = 12000\nghost = true\nexistence = 1"),
              HasSubstr("existence: want"));
  EXPECT_THAT(problem("mass_kg = 12000", "mass_kg = 12000\nexistence = 0.5"),
              HasSubstr("existence: want it of a ghost only"));
  EXPECT_THAT(problem("shape = \"box\"\nlength_m = 8\nwidth_m = 2.5",
                      "shape = \"segment\"\nlength_m = 8\nwidth_m = 2.5"),
              HasSubstr("width_m: want none"));
  EXPECT_THAT(
      problem("shape = \"box\"\nlength_m = 8\nwidth_m = 2.5", "shape = \"segment\"\nlength_m = 8"),
      HasSubstr("shape: want a segment for obstacles only, got a truck"));
  EXPECT_THAT(problem("source =", "why = 3\nsource ="), HasSubstr("why: want"));
}

// A ghost may stand where somebody is, but not where the ego is.
TEST(ReadScenario, AGhostMayOverlapOthersButNotTheEgo) {
  EXPECT_EQ(problem("mass_kg = 12000\n\n[actors.start]\ns_m = 55\nd_m = 43",
                    "mass_kg = 12000\nghost = true\nexistence = 0.5\n\n[actors.start]\n"
                    "s_m = 30\nd_m = 4"),
            "no problem");
  EXPECT_THAT(problem("mass_kg = 12000\n\n[actors.start]\ns_m = 55\nd_m = 43",
                      "mass_kg = 12000\nghost = true\nexistence = 0.5\n\n[actors.start]\n"
                      "s_m = 3\nd_m = 3"),
              HasSubstr("touching the ego"));
}

TEST(ReadScenario, RefusesTimesThatDoNotGrow) {
  EXPECT_THAT(problem("[0, 0.1, 0.2]", "[0, 0.1, 0.1]"), HasSubstr("t_s: want growing"));
  EXPECT_THAT(problem("[0, 0.1, 0.2]", "[0.2, 0.1, 0]"), HasSubstr("t_s: want growing"));
  EXPECT_THAT(problem("[0, 0.1, 0.2]", "[0]"), HasSubstr("2 to"));
  EXPECT_THAT(problem("[0, 0.1, 0.2]", "[0, 0.1]"), HasSubstr("want [2 numbers], got 3"));
}

TEST(ReadScenario, RefusesTheSameNameTwice) {
  EXPECT_THAT(problem("kind = \"car\"", "kind = \"truck\""), HasSubstr("second truck1"));
}

// The ego's nose is at 4.7 / 2 - 0.1 = 2.25 m, the car's tail 4.6 / 2 behind its centre: they touch
// at 4.55 m, and have room at 4.56 m.
TEST(ReadScenario, RefusesAnOverlappingStart) {
  EXPECT_THAT(problem("x_m = [30,", "x_m = [4.54,"), HasSubstr("car1: want room at the start"));
  EXPECT_EQ(problem("x_m = [30,", "x_m = [4.56,"), "no problem");
  EXPECT_THAT(problem("s_m = 55\nd_m = 43", "s_m = 30\nd_m = 4"), HasSubstr("touching truck1"));
}

TEST(ReadScenario, RefusesAnEgoThatHeadsAgainstItsLane) {
  EXPECT_THAT(problem("[ego.start]\ns_m = 0\nd_m = 0\nheading_deg = 0",
                      "[ego.start]\ns_m = 0\nd_m = 0\nheading_deg = 180"),
              HasSubstr("heading_deg: want -30 to 30"));
}

TEST(ReadScenario, AnActorThatComesLaterMayStartAnywhere) {
  std::string text = with("x_m = [30,", "x_m = [0,");
  text.replace(text.find("[0, 0.1, 0.2]"), 13, "[1, 1.1, 1.2]");
  EXPECT_TRUE(read_scenario(text, "x.toml").has_value());
}

TEST(ReadScenario, RefusesTooManyActors) {
  std::string text = crossing;
  for (int i = 2; i <= 32; ++i) {
    text += "\n[[actors]]\nkind = \"obstacle\"\nid = " + std::to_string(i) +
            "\nshape = \"box\"\nlength_m = 1\nwidth_m = 1\nmass_kg = 10\n[actors.start]\ns_m = " +
            std::to_string(100 + 3 * i) +
            "\nd_m = 0\nheading_deg = 0\nspeed_mps = 0\nbehaviour = \"hold\"\n";
  }
  EXPECT_THAT(read_scenario(text, "x.toml").error().message, HasSubstr("want at most 32, got 33"));
}

TEST(ReadScenario, RefusesAStartAndARecordingTogether) {
  EXPECT_THAT(problem("[actors.recording]", "[actors.start]\ns_m = 1\n[actors.recording]"),
              HasSubstr("got both"));
}

TEST(ReadScenario, RefusesWhatIsNotToml) {
  EXPECT_THAT(problem("grip = 0.9", "grip = = 0.9"), HasSubstr("x.toml:7: not TOML"));
}

TEST(LoadScenario, NamesTheFileThatIsMissing) {
  const Result<Scenario> result = load_scenario("/nowhere/x.toml");
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, Error::Code::unreadable);
  EXPECT_THAT(result.error().message, HasSubstr("/nowhere/x.toml"));
}

}  // namespace
}  // namespace saca::scenario::scenario_test
