#include "saca/lab/families/family.h"

#include <gmock/gmock.h>

#include <string>

#include "saca/base/core/file.h"

namespace saca::families::family_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string folder = "scenarios/families/";

std::string text_of(const std::string& name) {
  return read_file(folder + name + ".toml").value();
}

TEST(Family, EveryShippedOneIsReadAndNamesASourceForEachNumber) {
  for (std::size_t i = 0; i < num_family_kinds; ++i) {
    const auto kind = static_cast<FamilyKind>(i);
    const auto family = load_family(folder, name(kind));
    ASSERT_TRUE(family.has_value()) << family.error().message;
    EXPECT_EQ(family.value().kind, kind);
    EXPECT_EQ(family.value().ranges.size() >= surroundings_keys().size() + own_keys(kind).size(),
              true);
    for (const auto& [key, range] : family.value().ranges) {
      EXPECT_LE(range.min, range.max) << key;
      EXPECT_FALSE(range.source.empty()) << key;
    }
  }
}

TEST(Family, ItsOwnRangeStandsInForThatOfTheSurroundings) {
  const Family merge = load_family(folder, "merge").value();
  EXPECT_EQ(merge.ranges.at("right_lane_share").min, 1.0);
  EXPECT_EQ(merge.ranges.at("grip").min, 0.35);
}

// Euro NCAP CCCscp 2026: both from 20 to 60 km/h.
TEST(Family, CrossingSpeedsAreThoseOfEuroNcap) {
  const Family crossing = load_family(folder, "crossing").value();
  for (const char* key : {"ego_speed_mps", "other_speed_mps"}) {
    EXPECT_NEAR(crossing.ranges.at(key).min, 20.0 / 3.6, 0.01);
    EXPECT_NEAR(crossing.ranges.at(key).max, 60.0 / 3.6, 0.01);
  }
}

TEST(Family, MayHaveMotorcyclesAmongItsVehicles) {
  std::string text = text_of("lead_brakes");
  text += "motorcycle_share = { min = 0.5, max = 0.5, source = \"test\" }\n";
  const auto family = read_family(text, "f.toml", text_of("surroundings"), "s.toml");
  ASSERT_TRUE(family.has_value()) << family.error().message;
  EXPECT_EQ(family.value().ranges.at("motorcycle_share").min, 0.5);
  EXPECT_FALSE(load_family(folder, "lead_brakes").value().ranges.contains("motorcycle_share"));
  std::string walker = text_of("pedestrian");
  walker += "motorcycle_share = { min = 0.5, max = 0.5, source = \"test\" }\n";
  EXPECT_FALSE(read_family(walker, "f.toml", text_of("surroundings"), "s.toml").has_value());
}

std::string complaint(const std::string& from, const std::string& to) {
  std::string text = text_of("lead_brakes");
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const auto family = read_family(text, "f.toml", text_of("surroundings"), "s.toml");
  return family.has_value() ? "" : family.error().message;
}

TEST(Family, RefusesWhatAPersonCanGetWrong) {
  EXPECT_THAT(complaint("saca.family/1", "saca.family/2"), HasSubstr("f.toml:1: schema: want"));
  EXPECT_THAT(complaint("kind = \"lead_brakes\"", "kind = \"leads\""),
              AllOf(HasSubstr("kind: want crossing"), HasSubstr("got \"leads\"")));
  EXPECT_THAT(complaint("min = 0.5, max = 1.8", "min = 1.9, max = 1.8"),
              AllOf(HasSubstr("f.toml"), HasSubstr("gap_s"), HasSubstr("empty")));
  EXPECT_THAT(complaint("min = 0.5", "min = nan"), HasSubstr("min"));
  EXPECT_THAT(complaint("min = 0.5", "min = -0.5"), AllOf(HasSubstr("min"), HasSubstr("-0.5")));
  EXPECT_THAT(complaint("min = 4.0", "min = 0.0"), HasSubstr("min"));  // who never stops
  EXPECT_THAT(complaint("min = 0.12, max = 0.12", "min = 0.9, max = 0.9"), HasSubstr("at most 1"));
  EXPECT_THAT(complaint("name = \"lead_brakes\"", "name = \"Lead-Brakes\""),
              HasSubstr("lower-case"));
  EXPECT_THAT(complaint("gap_s =", "gap_m ="), HasSubstr("gap_s"));
  EXPECT_THAT(complaint("source = \"assumption\"", "source = \"\""), HasSubstr("who says so"));
  EXPECT_THAT(complaint(", source = \"assumption\"", ""), HasSubstr("source"));
  EXPECT_THAT(complaint("[ranges]", "[ranges]\nmood = { min = 0.0, max = 1.0, source = \"x\" }"),
              HasSubstr("mood"));
  EXPECT_THAT(complaint("[ranges]", "[ranges"), HasSubstr("f.toml"));
}

TEST(Family, RefusesSurroundingsThatAreIncomplete) {
  std::string common = text_of("surroundings");
  common.erase(common.find("grip ="),
               common.find('\n', common.find("grip =")) - common.find("grip ="));
  const auto family = read_family(text_of("merge"), "f.toml", common, "s.toml");
  ASSERT_FALSE(family.has_value());
  EXPECT_THAT(family.error().message, AllOf(HasSubstr("s.toml"), HasSubstr("grip")));
}

TEST(Family, AFileIsCalledAsTheFamilyIs) {
  const auto family = load_family(folder, "no_such");
  ASSERT_FALSE(family.has_value());
  EXPECT_THAT(family.error().message, HasSubstr("no_such.toml"));
}

}  // namespace
}  // namespace saca::families::family_test
