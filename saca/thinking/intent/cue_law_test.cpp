#include "saca/thinking/intent/cue_law.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace saca::intent::cue_law_test {
namespace {

using testing::HasSubstr;
using world::ActorKind;
using world::CueKind;

std::string file_of(const std::string& entries) {
  return "schema = \"saca.cues/1\"\n" + entries;
}

const std::string bus = R"(
[[cues]]
kind = "bus_at_stop"
unseen = "pedestrian"
probability = 0.25
speed_mps = 2.0
source = "assumption"
)";

std::string problem_of(const std::string& entries) {
  const auto law = read_cue_law(file_of(entries), "cues.toml");
  return law.has_value() ? "" : law.error().message;
}

TEST(CueLaw, ReadsWhatCuesStandFor) {
  const auto law = read_cue_law(file_of(bus + R"(
[[cues]]
kind = "wet_leaves"
unseen = "slippery"
probability = 0.4
grip_share = 0.5
source = "assumption"
)"),
                                "cues.toml");
  ASSERT_TRUE(law.has_value()) << law.error().message;
  const auto& of_bus = law.value().of(CueKind::bus_at_stop);
  ASSERT_TRUE(of_bus);
  EXPECT_EQ(of_bus->who, ActorKind::pedestrian);
  EXPECT_DOUBLE_EQ(of_bus->probability, 0.25);
  EXPECT_DOUBLE_EQ(of_bus->speed, 2.0);
  const auto& of_leaves = law.value().of(CueKind::wet_leaves);
  ASSERT_TRUE(of_leaves);
  EXPECT_FALSE(of_leaves->who);
  EXPECT_DOUBLE_EQ(of_leaves->grip_share, 0.5);
  EXPECT_FALSE(law.value().of(CueKind::low_sun));
}

TEST(CueLaw, ShippedFilesKnowEveryKind) {
  for (const char* path : {"data/cues.toml", "scenarios/families/cues.toml"}) {
    const auto law = load_cue_law(path);
    ASSERT_TRUE(law.has_value()) << law.error().message;
    for (std::size_t k = 0; k < world::num_cue_kinds; ++k) {
      EXPECT_TRUE(law.value().unseen[k]) << path << " " << name(static_cast<CueKind>(k));
    }
  }
}

TEST(CueLaw, ReadsBackWhatItWrites) {
  CueLaw law;
  law.unseen[static_cast<std::size_t>(CueKind::work_zone)] =
      Unseen{.who = ActorKind::truck, .probability = 1.0 / 3.0, .speed = 7.5};
  law.unseen[static_cast<std::size_t>(CueKind::wet_leaves)] =
      Unseen{.who = std::nullopt, .probability = 0.25, .grip_share = 0.4};
  std::array<std::string, world::num_cue_kinds> sources;
  sources.fill("counted");
  const auto again = read_cue_law(cue_law_text(law, sources), "written.toml");
  ASSERT_TRUE(again.has_value()) << again.error().message;
  EXPECT_EQ(digest(again.value()), digest(law));
  EXPECT_NE(digest(law), digest(CueLaw{}));
}

TEST(CueLaw, SaysWhatIsWrong) {
  EXPECT_THAT(problem_of(bus + bus), HasSubstr("kind: want each kind once, got a second bus"));
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = bus;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(problem_of(with("bus_at_stop", "tram")), HasSubstr("cues.toml:4: kind: want school"));
  EXPECT_THAT(problem_of(with("\"pedestrian\"", "\"obstacle\"")), HasSubstr("unseen: want car"));
  EXPECT_THAT(problem_of(with("0.25", "1.25")), HasSubstr("probability"));
  EXPECT_THAT(problem_of(with("speed_mps = 2.0", "")), HasSubstr("speed_mps"));
  EXPECT_THAT(problem_of(with("\"assumption\"", "\"\"")), HasSubstr("source: want who says so"));
  EXPECT_THAT(load_cue_law("no/such.toml").error().message, HasSubstr("no/such.toml"));
}

}  // namespace
}  // namespace saca::intent::cue_law_test
