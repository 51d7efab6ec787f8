#include "saca/lab/eval/atlas_check.h"

#include <gtest/gtest.h>

#include "saca/lab/eval/scenes_for_test.h"
#include "saca/onboard/atlas/atlas_for_test.h"

namespace saca::eval::atlas_check_test {
namespace {

using manoeuvre::PolicyId;

// 12.5 m/s, a car 14 m ahead: braking and going on hit it, a lane change does not.
TEST(AtlasCheck, PutsAtlasAndPhysicsSideBySide) {
  scenario::Scenario scenario = standing_car(12.5, 14.0);
  scenario.grip = 0.85;
  const manoeuvre::Car& car = atlas::small_atlas_car();
  const auto rows =
      atlas_rows(decision_point_at(scenario, car, 0.5), atlas::small_atlas(), car, shipped_harm());
  const AtlasRow& going_on = rows[manoeuvre::index(PolicyId::no_intervention)];
  EXPECT_TRUE(going_on.told_contact && going_on.true_contact && going_on.same_partner);
  EXPECT_NEAR(going_on.speed_off, 0.0, 0.05);
  EXPECT_EQ(going_on.told_chance, 1.0);
  for (const AtlasRow& row : rows) {
    EXPECT_EQ(row.told_contact, row.true_contact) << plan_text(row.plan);
    // A metre and more of room, or of overlap: no grip within four deviations changes that.
    EXPECT_EQ(row.drawn_contact, row.true_contact) << plan_text(row.plan);
  }
}

AtlasRow row(PolicyId policy, double told, double truth) {
  AtlasRow row{.plan = {policy, std::nullopt}};
  row.forecast_harm = told;
  row.true_harm = truth;
  row.told_contact = told > 0.0;
  row.true_contact = truth > 0.0;
  row.same_partner = row.told_contact && row.true_contact;
  row.speed_off = told - truth;
  return row;
}

TEST(AtlasCheck, CountsByHand) {
  AtlasRow refused = row(PolicyId::t_drift_left, 0.0, 0.0);
  refused.refused = true;
  AtlasRow outside = row(PolicyId::aes_left, 0.0, 0.0);
  outside.outside = atlas::AtlasLimit::speed;
  // The atlas takes braking for best (1.0 < 3.0); going on is (2.0 < 2.5), by 0.5.
  const std::vector<std::vector<AtlasRow>> rows{
      {row(PolicyId::aeb, 1.0, 2.5), row(PolicyId::no_intervention, 3.0, 2.0), refused},
      {},
      {row(PolicyId::aeb, 0.0, 0.0), row(PolicyId::no_intervention, 0.5, 0.0), outside}};
  const AtlasFigures figures = atlas_figures(rows);
  EXPECT_EQ(figures.scenes, 2);
  EXPECT_EQ(figures.plans, 5);
  EXPECT_DOUBLE_EQ(figures.covered.share, 0.8);
  EXPECT_DOUBLE_EQ(figures.agreement.share, 0.75);
  EXPECT_DOUBLE_EQ(figures.speed_max, 1.5);
  EXPECT_DOUBLE_EQ(figures.regret_p95, 0.5);
  EXPECT_DOUBLE_EQ(figures.same_choice.share, 0.5);
}

// By hand: 10 plans told 0.3 of which 4 touch; told 0 and 1, which both keep their word.
TEST(AtlasCheck, ChancesAreHeldToWhatWasDrawn) {
  std::vector<std::vector<AtlasRow>> rows(1);
  const auto add = [&](double told, bool touched) {
    AtlasRow one = row(PolicyId::aeb, 0.0, 0.0);
    one.told_chance = told;
    one.drawn_contact = touched;
    rows[0].push_back(one);
  };
  for (int i = 0; i < 10; ++i) {
    add(0.25 + 0.01 * i, i < 4);
  }
  add(0.0, false);
  add(1.0, true);
  add(0.2, false);  // a bound belongs to the bin above it
  AtlasRow refused = row(PolicyId::aeb, 0.0, 0.0);
  refused.refused = true;
  refused.told_chance = 0.3;
  refused.drawn_contact = true;
  rows[0].push_back(refused);
  const ChanceBins bins = atlas_figures(rows).chances;
  EXPECT_EQ(bins[0].plans, 1);
  EXPECT_EQ(bins[0].touched.share, 0.0);
  EXPECT_EQ(bins[1].plans, 0);
  EXPECT_EQ(bins[2].plans, 11);
  EXPECT_NEAR(bins[2].told, (2.95 + 0.2) / 11.0, 1e-12);
  EXPECT_NEAR(bins[2].touched.share, 4.0 / 11.0, 1e-12);
  EXPECT_EQ(bins.back().plans, 1);
  EXPECT_EQ(bins.back().touched.share, 1.0);
}

// Two scenes with regrets of 0.5 and 1.5; in the second the atlas' choice is struck twice.
TEST(AtlasCheck, RegretIsToldApartFromThatOfSecondContacts) {
  AtlasRow twice = row(PolicyId::aeb, 1.0, 3.5);
  twice.later_contacts = 1;
  const std::vector<std::vector<AtlasRow>> rows{
      {row(PolicyId::aeb, 1.0, 2.5), row(PolicyId::no_intervention, 3.0, 2.0)},
      {twice, row(PolicyId::no_intervention, 2.0, 2.0)}};
  const LoneRegret lone = atlas_figures(rows).lone;
  EXPECT_EQ(lone.scenes, 1);
  EXPECT_DOUBLE_EQ(lone.mean, 0.5);
  EXPECT_DOUBLE_EQ(lone.share, 0.25);
  EXPECT_DOUBLE_EQ(lone.lasting_off_p95, 2.5);
}

}  // namespace
}  // namespace saca::eval::atlas_check_test
