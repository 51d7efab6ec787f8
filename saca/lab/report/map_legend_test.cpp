#include "saca/lab/report/map_legend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace saca::report::map_legend_test {
namespace {

using manoeuvre::PolicyId;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

MapCell refusing(PolicyId policy) {
  MapCell cell;
  cell.refused.at(manoeuvre::index(policy)) = true;
  return cell;
}

TEST(MapLegend, CellsThatLookAlikeHaveOneKey) {
  EXPECT_EQ(area_key({.best = PolicyId::es_b_right}), 4);
  EXPECT_EQ(area_key({.verdict = MapVerdict::no_risk}), 8);
  EXPECT_EQ(area_key({.verdict = MapVerdict::unplayable}), 9);
}

// Where there is no such scene nothing is refused.
TEST(MapLegend, KnowsWhichAreRefusedSomewhere) {
  MapCell none = refusing(PolicyId::aes_left);
  none.verdict = MapVerdict::unplayable;
  const std::vector<MapCell> cells{
      refusing(PolicyId::t_drift_left), {}, none, refusing(PolicyId::t_drift_left)};
  EXPECT_THAT(refused_somewhere(cells), ElementsAre(PolicyId::t_drift_left));
}

TEST(MapLegend, CountsWhatIsDrawn) {
  const std::vector<MapCell> cells{{.best = PolicyId::aes_left},
                                   {.best = PolicyId::aes_right},
                                   {.best = PolicyId::aes_right},
                                   {.verdict = MapVerdict::no_risk}};
  MapLegend legend({10.0, 20.0});
  legend.verdicts(cells);
  EXPECT_THAT(legend.body(), HasSubstr("2 AES-R"));
  EXPECT_THAT(legend.body(), HasSubstr("2  (50.0 %)"));
  EXPECT_THAT(legend.body(), HasSubstr("no risk"));
  EXPECT_THAT(legend.body(), Not(HasSubstr("AEB")));
  EXPECT_THAT(legend.body(), Not(HasSubstr("no such scene")));
  EXPECT_DOUBLE_EQ(legend.at().y, 20.0 + 4.0 * 19.0);  // a heading and three rows
  const Vec2 before = legend.at();
  legend.refusals(cells);
  EXPECT_EQ(legend.at().y, before.y) << "none is refused";
}

TEST(MapLegend, SaysWhatPalerMeans) {
  MapLegend legend({0.0, 0.0});
  legend.margins();
  EXPECT_THAT(legend.body(), HasSubstr("below 0.001"));
  EXPECT_THAT(legend.body(), HasSubstr("0.1 or more"));
}

}  // namespace
}  // namespace saca::report::map_legend_test
