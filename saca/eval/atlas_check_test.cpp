#include "saca/eval/atlas_check.h"

#include <gtest/gtest.h>

#include "saca/eval/scenes_for_test.h"
#include "saca/manoeuvre/atlas_for_test.h"

namespace saca::eval {
namespace {

using manoeuvre::PolicyId;

// 12.5 m/s, a car 14 m ahead: braking and going on hit it, a lane change does not.
TEST(AtlasCheck, PutsAtlasAndPhysicsSideBySide) {
  sim::Scenario scenario = standing_car(12.5, 14.0);
  scenario.grip = 0.85;
  const manoeuvre::Car& car = manoeuvre::small_atlas_car();
  const auto rows =
      atlas_rows(moment_at(scenario, car, 0.5), manoeuvre::small_atlas(), car, shipped_harm());
  const AtlasRow& going_on = rows[manoeuvre::index(PolicyId::no_intervention)];
  EXPECT_TRUE(going_on.told_contact && going_on.true_contact && going_on.same_partner);
  EXPECT_NEAR(going_on.speed_off, 0.0, 0.05);
  for (const AtlasRow& row : rows) {
    EXPECT_EQ(row.told_contact, row.true_contact) << name(row.policy);
  }
}

AtlasRow row(PolicyId policy, double told, double truth) {
  AtlasRow row{.policy = policy};
  row.told_harm = told;
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
  outside.outside = manoeuvre::AtlasLimit::speed;
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

}  // namespace
}  // namespace saca::eval
