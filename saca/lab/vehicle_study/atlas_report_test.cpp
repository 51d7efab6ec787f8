#include "saca/lab/vehicle_study/atlas_report.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "saca/onboard/atlas/atlas_for_test.h"

namespace saca::vehicle_study::atlas_report_test {
namespace {

using nlohmann::json;
using testing::EndsWith;
using testing::HasSubstr;

AtlasFile usable() {
  return {.file = "a.atlas",
          .car = "a_car",
          .info = {.car = 0x1234, .grid = atlas::small_grid(), .bytes = 2'500'000},
          .problem = std::nullopt};
}

TEST(AtlasReport, TheDocumentTellsTheGridOfEachKind) {
  const json all = json_of(usable());
  EXPECT_EQ(all.at("schema"), "saca.atlas_info/1");
  EXPECT_EQ(all.at("car_hash"), "0000000000001234");
  EXPECT_EQ(all.at("bytes"), 2'500'000);
  EXPECT_EQ(all.at("points"), num_nodes(atlas::small_grid()));
  EXPECT_EQ(all.at("usable"), true);
  EXPECT_TRUE(all.at("problem").is_null());
  ASSERT_EQ(all.at("kinds").size(), atlas::num_atlas_kinds);
  std::size_t points = 0;
  for (const json& kind : all.at("kinds")) {
    EXPECT_NE(kind.contains("strength"), kind.contains("target_share"));
    points += kind.at("points").get<std::size_t>();
  }
  EXPECT_EQ(points, num_nodes(atlas::small_grid()));
  const json& stop = all.at("kinds").at(0);
  EXPECT_TRUE(stop.contains("strength")) << "a stop has no target speed";
  EXPECT_EQ(stop.at("speed_mps"), json({12.0, 13.0}));
  EXPECT_EQ(stop.at("grip"), json({0.8, 0.9}));
}

TEST(AtlasReport, TheTextTellsTheRangesAndWhetherItCanBeUsed) {
  AtlasFile file = usable();
  const std::string text = text_of(file);
  EXPECT_THAT(text, HasSubstr(" points, 2.5 MB, car 0000000000001234\n"));
  EXPECT_THAT(text, HasSubstr(" points: 12 to 13 m/s, grip 0.8 to 0.9\n"));
  EXPECT_THAT(text, EndsWith("\nof a_car as this program drives it: usable\n"));
  file.problem = "a.atlas: is of another car";
  EXPECT_THAT(text_of(file), EndsWith("\na.atlas: is of another car\n"));
  EXPECT_EQ(json_of(file).at("usable"), false);
  EXPECT_EQ(json_of(file).at("problem"), "a.atlas: is of another car");
}

eval::AtlasFigures some_figures() {
  eval::AtlasFigures figures{.scenes = 4, .plans = 40};
  figures.covered = {0.75, 0.5, 0.875};
  figures.speed_p95 = 0.5;
  figures.regret_mean = 0.0625;
  figures.lone = {.scenes = 3, .mean = 0.25, .share = 0.5};
  figures.chances[1] = {
      .low = 0.001, .high = 0.2, .plans = 7, .told = 0.1, .touched = {0.125, 0.0625, 0.5}};
  return figures;
}

TEST(AtlasReport, FiguresHaveNamesForPrograms) {
  const json all = json_of(some_figures());
  EXPECT_EQ(all.at("atlas.scenes"), 4);
  EXPECT_EQ(all.at("atlas.plans"), 40);
  EXPECT_EQ(all.at("atlas.covered_share"), 0.75);
  EXPECT_EQ(all.at("atlas.covered_share.lo"), 0.5);
  EXPECT_EQ(all.at("atlas.covered_share.hi"), 0.875);
  EXPECT_EQ(all.at("atlas.impact_speed_off_mps.p95"), 0.5);
  EXPECT_EQ(all.at("atlas.regret.mean"), 0.0625);
  EXPECT_EQ(all.at("atlas.regret_lone.scenes"), 3);
  EXPECT_EQ(all.at("atlas.chance_from_0.001.plans"), 7);
  EXPECT_EQ(all.at("atlas.chance_from_0.001.touched"), 0.125);
}

TEST(AtlasReport, FiguresForPeopleLeaveEmptyBinsOut) {
  const std::string text = text_of(some_figures());
  EXPECT_THAT(text, testing::StartsWith("4 scenes, 40 plans that physics does not refuse\n"));
  EXPECT_THAT(text, HasSubstr("  within the atlas' bounds   75.00 % (50.00 to 87.50)\n"));
  EXPECT_THAT(text, HasSubstr("nothing is struck twice: 0.2500 mean in 3 scenes, 50.0 % of all"));
  EXPECT_THAT(text, EndsWith("  chance of contact on grip known to 6 %:\n"
                             "    told 0.001 to 0.200: 0.100 of      7 plans; touched 12.50 % "
                             "(6.25 to 50.00)\n"));
}

}  // namespace
}  // namespace saca::vehicle_study::atlas_report_test
