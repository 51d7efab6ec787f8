#include "saca/lab/scenario/motion_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace saca::scenario::motion_reader_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr std::string_view place = "s_m = 5\nd_m = 1\nheading_deg = 0\n";

struct Read {
  Script script;
  std::string problem;  ///< empty when there is none
};

Read read(const std::string& text, world::ActorKind kind = world::ActorKind::car) {
  const auto document = config::Document::parse(text, "x.toml").value();
  const Script script = read_script(document.root(), kind);
  const auto error = document.error();
  return {script, error ? error->message : ""};
}

std::string start(std::string_view rest) {
  return std::string(place) + std::string(rest);
}

TEST(ReadScript, HoldsEveryBehaviour) {
  const Script accelerate = read(start("speed_mps = 3\nbehaviour = \"accelerate\"\n"
                                       "acceleration_mps2 = 2\nfrom_s = 1\nuntil_mps = 8"))
                                .script;
  EXPECT_EQ(accelerate.from, 1.0);
  EXPECT_EQ(accelerate.until_speed, 8.0);
  const Script change = read(start("speed_mps = 20\nbehaviour = \"lane_change\"\nto_d_m = -2.5\n"
                                   "begins_at_s = 1.5\ntakes_s = 3\ndeceleration_mps2 = 4"))
                            .script;
  EXPECT_EQ(change.to_d, -2.5);
  EXPECT_EQ(change.from, 1.5);
  EXPECT_EQ(change.takes, 3.0);
  EXPECT_EQ(change.acceleration, 4.0);
  const Script follow = read(start("speed_mps = 20\nbehaviour = \"follow\"\n"
                                   "desired_speed_mps = 25\ntime_gap_s = 0.8\nreaction_s = 1\n"
                                   "hardest_mps2 = 6"))
                            .script;
  EXPECT_EQ(follow.law.desired_speed, 25.0);
  EXPECT_EQ(follow.law.time_gap, 0.8);
  EXPECT_EQ(follow.law.reaction, 1.0);
  EXPECT_EQ(follow.law.hardest, 6.0);
  EXPECT_EQ(follow.law.acceleration, drivers::usual_driver(20.0).acceleration);  // as usual
  const Script walk = read(start("speed_mps = 1.4\nbehaviour = \"walk\"\ndecides_at_s = 2\n"
                                 "then = \"stop\"\nchance_stop = 0.6\nchance_run = 0.1\n"
                                 "run_mps = 3"),
                           world::ActorKind::pedestrian)
                          .script;
  EXPECT_EQ(walk.then, Deed::stop);
  EXPECT_EQ(walk.chance_run, 0.1);
  EXPECT_EQ(walk.run_speed, 3.0);
}

struct Mistake {
  std::string_view text;  ///< after the place
  int line;
  std::string_view key;
  std::string_view wanted;  ///< what the message says of what was wanted and what came
  world::ActorKind kind = world::ActorKind::car;
};

constexpr auto walker = world::ActorKind::pedestrian;

constexpr Mistake mistakes[] = {
    {"speed_mps = 3\nbehaviour = \"glide\"", 5, "behaviour", "got \"glide\""},
    {"speed_mps = nan\nbehaviour = \"hold\"", 4, "speed_mps", "want 0 to 100, got nan"},
    {"speed_mps = 3\nbehaviour = \"hold\"", 4, "speed_mps", "want 0"},
    {"speed_mps = 3\nbehaviour = \"constant_velocity\"", 5, "behaviour",
     "want hold for an obstacle, got \"constant_velocity\"", world::ActorKind::obstacle},
    {"speed_mps = 3\nbehaviour = \"accelerate\"\nacceleration_mps2 = 2\nuntil_mps = 2", 7,
     "until_mps", "want a speed that the acceleration leads to, got 2"},
    {"speed_mps = 3\nbehaviour = \"accelerate\"\nacceleration_mps2 = -2\nuntil_mps = 4", 7,
     "until_mps", "got 4"},
    {"speed_mps = 3\nbehaviour = \"accelerate\"\nacceleration_mps2 = 2\nfrom_s = -1", 7, "from_s",
     "want 0 to 600, got -1"},
    {"speed_mps = 3\nbehaviour = \"accelerate\"\nacceleration_mps2 = 2\nuntil_kmh = 40", 7,
     "until_kmh", "unknown key"},
    {"speed_mps = 9\nbehaviour = \"brake\"\ndeceleration_mps2 = 0\nbrake_at_s = 1", 6,
     "deceleration_mps2", "got 0"},
    {"speed_mps = 9\nbehaviour = \"lane_change\"\nbegins_at_s = 1\ntakes_s = 3", 1, "to_d_m",
     "missing"},
    {"speed_mps = 9\nbehaviour = \"lane_change\"\nto_d_m = 4\nbegins_at_s = 1\ntakes_s = 0", 8,
     "takes_s", "got 0"},
    // 3 m aside in 0.5 s at 9 m/s, 4.5 m of way: 1.875 * 3 / 4.5 is 51 degrees
    {"speed_mps = 9\nbehaviour = \"lane_change\"\nto_d_m = 4\nbegins_at_s = 1\ntakes_s = 0.5", 8,
     "takes_s", "at most 45 degrees across the lane, got 51.3"},
    {"speed_mps = 0\nbehaviour = \"lane_change\"\nto_d_m = 4\nbegins_at_s = 1\ntakes_s = 3", 4,
     "speed_mps", "want more than 0"},
    {"speed_mps = 9\nbehaviour = \"lane_change\"\nto_d_m = inf\nbegins_at_s = 1\ntakes_s = 3", 6,
     "to_d_m", "want -100000 to 100000, got inf"},
    {"speed_mps = 9\nbehaviour = \"follow\"\ntime_gap_s = 1\nreaction_s = 1", 1,
     "desired_speed_mps", "missing"},
    {"speed_mps = 9\nbehaviour = \"follow\"\ndesired_speed_mps = 0\ntime_gap_s = 1\nreaction_s = 1",
     6, "desired_speed_mps", "got 0"},
    {"speed_mps = 9\nbehaviour = \"follow\"\ndesired_speed_mps = 9\ntime_gap_s = 1\nreaction_s = 4",
     8, "reaction_s", "want 0 to 3, got 4"},
    {"speed_mps = 1\nbehaviour = \"follow\"\ndesired_speed_mps = 9\ntime_gap_s = 1\nreaction_s = 1",
     5, "behaviour", "want a vehicle that follows, got a pedestrian", walker},
    {"speed_mps = 9\nbehaviour = \"walk\"\ndecides_at_s = 1\nthen = \"go_on\"", 5, "behaviour",
     "want a pedestrian or bicycle that walks, got a car"},
    {"speed_mps = 1\nbehaviour = \"walk\"\ndecides_at_s = 1\nthen = \"wait\"", 7, "then",
     "want stop, go_on, run, got \"wait\"", walker},
    {"speed_mps = 1\nbehaviour = \"walk\"\ndecides_at_s = 1\nthen = \"run\"", 1, "run_mps",
     "missing", walker},
    {"speed_mps = 2\nbehaviour = \"walk\"\ndecides_at_s = 1\nthen = \"run\"\nrun_mps = 1", 8,
     "run_mps", "want no less than speed_mps, got 1", walker},
    {"speed_mps = 1\nbehaviour = \"walk\"\ndecides_at_s = 1\nthen = \"stop\"\nchance_stop = 0.7\n"
     "chance_run = 0.4\nrun_mps = 3",
     9, "chance_run", "1 together at most, got 1.1", walker},
    {"speed_mps = 1\nbehaviour = \"walk\"\ndecides_at_s = 1\nthen = \"stop\"\nchance_stop = 1.7", 8,
     "chance_stop", "want 0 to 1, got 1.7", walker},
};

TEST(ReadScript, NamesFileLineKeyWantedAndGot) {
  for (const Mistake& mistake : mistakes) {
    const std::string text = start(mistake.text);
    const std::string where = "x.toml:" + std::to_string(mistake.line) + ": ";
    EXPECT_THAT(read(text, mistake.kind).problem,
                AllOf(HasSubstr(where), HasSubstr(mistake.key), HasSubstr(mistake.wanted)))
        << text;
  }
}

TEST(ReadScript, WhoFollowsOrChangesLanesHeadsAlongTheLane) {
  for (const char* behaviour :
       {"\"lane_change\"\nto_d_m = 4\nbegins_at_s = 1\ntakes_s = 3",
        "\"follow\"\ndesired_speed_mps = 9\ntime_gap_s = 1\nreaction_s = 1"}) {
    const std::string rest = std::string("speed_mps = 9\nbehaviour = ") + behaviour;
    EXPECT_EQ(read("s_m = 5\nd_m = 1\nheading_deg = -180\n" + rest).problem, "");
    EXPECT_THAT(read("s_m = 5\nd_m = 1\nheading_deg = 10\n" + rest).problem,
                AllOf(HasSubstr("x.toml:3: "), HasSubstr("heading_deg"),
                      HasSubstr("want 0 or 180, along the lane, for this behaviour, got 10")));
  }
}

}  // namespace
}  // namespace saca::scenario::motion_reader_test
