#include "saca/lab/eval/regulation_file.h"

#include <gmock/gmock.h>

#include <cmath>

#include "saca/base/core/file.h"
#include "saca/base/core/units.h"

namespace saca::eval::regulation_file_test {
namespace {

using testing::HasSubstr;

// 89 FR 39686, tables 1 and 2 to S7.1 and S8.1.1: the ends of the ranges.
TEST(RegulationFile, Fmvss127ReachesBothEndsOfEachRange) {
  const Regulation regulation = load_regulation("data/protocols/fmvss127.toml").value();
  const auto ends = [&](const std::string& name) {
    for (const RegulationRow& row : regulation.rows) {
      if (row.name == name) {
        return std::pair(std::lround(to_kmh(row.speeds.front())),
                         std::lround(to_kmh(row.speeds.back())));
      }
    }
    return std::pair(0L, 0L);
  };
  EXPECT_EQ(ends("stopped_lead"), std::pair(10L, 80L));
  EXPECT_EQ(ends("stopped_lead_manual"), std::pair(70L, 100L));
  EXPECT_EQ(ends("slower_lead"), std::pair(40L, 80L));
  EXPECT_EQ(ends("crossing_right_50"), std::pair(10L, 60L));
  EXPECT_EQ(ends("crossing_obstructed"), std::pair(10L, 50L));
  EXPECT_EQ(ends("standing"), std::pair(10L, 55L));
  EXPECT_EQ(ends("walking_along"), std::pair(10L, 65L));
}

/// The shipped file with a piece replaced.
std::string message_for(const std::string& from, const std::string& to) {
  std::string text = read_file("data/protocols/r152.toml").value();
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const auto read = read_regulation(text, "file.toml");
  return read.has_value() ? "" : read.error().message;
}

TEST(RegulationFile, RefusesWithFileLineKeyWantedAndGot) {
  EXPECT_THAT(message_for("saca.regulation/1", "saca.regulation/2"),
              HasSubstr("saca.regulation/1"));
  EXPECT_THAT(message_for("kind = \"stopped_lead\"", "kind = \"stoped_lead\""),
              testing::MatchesRegex(
                  "file.toml:[0-9]+:.*kind.*want one of stopped_lead, .*got \"stoped_lead\".*"));
  EXPECT_THAT(message_for("limit = \"impact_speed\"", "limit = \"speed\""),
              HasSubstr("got \"speed\""));
  EXPECT_THAT(message_for("[0, 0, 0, 0, 0, 0, 0, 0, 15, 25, 30, 35]", "[0, 15, 25]"),
              HasSubstr("impact_speeds_kmh"));
  EXPECT_THAT(message_for("speeds_kmh = [30,", "speeds_kmh = [20,"),
              HasSubstr("want more than the 20.0 km/h of who is ahead, got 20.0"));
  EXPECT_THAT(message_for("target = \"child\"", "target = \"deer\""),
              HasSubstr("want one of the [[targets]]; got \"deer\""));
  EXPECT_THAT(message_for("paragraph = \"5.2.1.4, 6.4\"", "paragraph = \"\""),
              HasSubstr("want the paragraph that asks for this"));
  EXPECT_THAT(message_for("grip = 0.9", "grip = 1.3"), HasSubstr("grip"));
  EXPECT_THAT(message_for("overlap_percent = 50", "overlap_percent = 50\nwind_mps = 3"),
              HasSubstr("wind_mps"));
  EXPECT_THAT(message_for("overlap_percent = 50", "overlap_percent = 150"),
              HasSubstr("overlap_percent"));
  EXPECT_THAT(message_for("name = \"curve_bicycle\"", "name = \"curve_car\""),
              HasSubstr("want each row's name once"));
  // 20 m at 5 km/h are 14.4 s.
  EXPECT_THAT(message_for("overlap_percent = 50",
                          "overlap_percent = 50\nstart_offset_m = 20\nspeed_within_m = 1"),
              HasSubstr("want who crosses to be there within the 4 s"));
  EXPECT_FALSE(load_regulation("data/protocols/no_such.toml").has_value());
}

}  // namespace
}  // namespace saca::eval::regulation_file_test
