#include "saca/lab/encounter/verdict_json.h"

#include <gtest/gtest.h>

#include "saca/base/core/contract.h"
#include "saca/thinking/intent/shipped_model.h"
#include "tests/support/scenes.h"

namespace saca::encounter::verdict_json_test {
namespace {

using manoeuvre::PolicyId;
using nlohmann::json;

/// Braking harms 0.3, a braked swerve to 7 m/s 0.01, and a drift cannot be driven.
reflex::Verdict verdict_at(double time) {
  reflex::Verdict verdict{.time = time};
  verdict.plans.push_back(
      {.plan = manoeuvre::full_braking, .drivable = true, .harm = 0.3, .contact = 0.75});
  verdict.plans.push_back(
      {.plan = {PolicyId::es_b_left, 7.0}, .drivable = true, .harm = 0.01, .contact = 0.0625});
  verdict.plans.push_back({.plan = {PolicyId::t_drift_left, std::nullopt}});
  return verdict;
}

/// A look in which a verdict of that very scene came.
void look(VerdictLog& log, const reflex::Verdict& verdict) {
  world::Scene scene = test::ego_at(15.0);
  scene.time = verdict.time;
  scene.actors.push_back(test::car(1, {40.0, 0.0}));
  scene.actors[0].kind = world::ActorKind::obstacle;
  log.note(scene, intent::beliefs_at_sight(intent::shipped_model(), scene), verdict);
}

TEST(VerdictJson, TellsEveryPlanAndWhatIsAdmissible) {
  const json out = verdict_json(verdict_at(2.0), std::nullopt);
  EXPECT_EQ(out["t_s"], 2.0);
  // 0.01 and 3 % of the 0.29 that braking has above it.
  EXPECT_TRUE(out["waiting_cost"].is_null());
  EXPECT_DOUBLE_EQ(out["admissible_harm"].get<double>(), 0.01 + 0.03 * 0.29);
  ASSERT_EQ(out["plans"].size(), 3U);
  EXPECT_EQ(out["plans"][1], (json{{"policy", 3},
                                   {"name", "ES-B-L"},
                                   {"target_speed_mps", 7.0},
                                   {"strength", nullptr},
                                   {"harm", 0.01},
                                   {"contact", 0.0625}}));
  EXPECT_TRUE(out["plans"][2]["harm"].is_null());
  EXPECT_TRUE(out["plans"][2]["contact"].is_null());
  EXPECT_TRUE(out["under_way"].is_null());
  // Braking is not admissible, and only one other plan is.
  EXPECT_EQ(
      out["speaks_for"],
      (json{{"policy", 3}, {"name", "ES-B-L"}, {"target_speed_mps", 7.0}, {"strength", nullptr}}));
}

// Of a swerve it is the rest, which is no longer what would begin now; braking can only begin now.
TEST(VerdictJson, TellsWhatGoingOnIsExpectedToEndIn) {
  reflex::Verdict verdict = verdict_at(2.0);
  EXPECT_EQ(verdict_json(verdict, manoeuvre::full_braking)["under_way"]["harm"], 0.3);
  EXPECT_TRUE(
      verdict_json(verdict, manoeuvre::Plan{PolicyId::es_b_left, 7.0})["under_way"].is_null());
  verdict.under_way = reflex::JudgedPlan{
      .plan = {PolicyId::es_b_left, 7.5}, .drivable = true, .harm = 0.02, .contact = 0.125};
  const json rest = verdict_json(verdict, manoeuvre::Plan{PolicyId::es_b_left, 7.5})["under_way"];
  EXPECT_EQ(rest["target_speed_mps"], 7.5);
  EXPECT_EQ(rest["harm"], 0.02);
  EXPECT_EQ(rest["contact"], 0.125);
}

TEST(VerdictJson, KeepsAllWhereThereIsRoom) {
  VerdictLog log;
  for (int k = 0; k < 12; ++k) {
    look(log, verdict_at(0.1 * k));
  }
  const json out = verdicts_json(log);
  EXPECT_EQ(out["left_out"], 0);
  ASSERT_EQ(out["in_hand"].size(), 12U);
  EXPECT_EQ(out["in_hand"][3]["t_s"], 0.1 * 3);
  EXPECT_EQ(out["in_hand"][3]["received_s"], 0.1 * 3);
  EXPECT_EQ(out["in_hand"][3]["by_atlas"], false);
}

TEST(VerdictJson, LeavesOutEvenlyButNeverThoseByWhichAPlanWasBegun) {
  VerdictLog log;
  for (int k = 0; k < 100; ++k) {
    look(log, verdict_at(0.1 * k));
    if (k == 40) {
      log.note(reflex::Decision{.plan = manoeuvre::full_braking, .verdict = verdict_at(0.1 * k)});
    } else if (k == 43) {
      log.note(reflex::Switch{.plan = {PolicyId::es_b_left, 7.0}});
    }
  }
  const json out = verdicts_json(log, 20);
  EXPECT_EQ(out["left_out"], 80);
  ASSERT_EQ(out["in_hand"].size(), 20U);
  bool has_trigger = false;
  bool has_switch = false;
  double before = -0.1;
  for (const json& one : out["in_hand"]) {
    const double time = one["t_s"].get<double>();
    EXPECT_GT(time, before);
    EXPECT_LT(time - before, 0.75) << "98 others on 18 places: every fifth or sixth";
    has_trigger = has_trigger || time == 0.1 * 40;
    has_switch = has_switch || time == 0.1 * 43;
    before = time;
  }
  EXPECT_TRUE(has_trigger && has_switch);
  EXPECT_THROW((void)verdicts_json(log, VerdictLog::most_judged), ContractViolation);
}

TEST(VerdictJson, TellsPathsAsRowsOfWholeNumbers) {
  VerdictLog log;
  look(log, verdict_at(2.0));
  log.note(reflex::Decision{.plan = manoeuvre::full_braking, .verdict = verdict_at(2.0)});
  const json out = hypotheses_json(log);
  ASSERT_EQ(out.size(), 1U);
  EXPECT_EQ(out[0]["t_s"], 2.0);
  EXPECT_EQ(out[0]["scene_s"], 2.0);
  EXPECT_EQ(out[0]["step_s"], 0.25);
  EXPECT_EQ(out[0]["horizon_s"], 4.0);
  EXPECT_EQ(out[0]["reacting"], json::array());
  ASSERT_EQ(out[0]["motions"].size(), 1U);
  EXPECT_EQ(out[0]["motions"][0]["probability"], 1.0);
  EXPECT_EQ(
      out[0]["motions"][0]["paths"],
      json::array({{{"id", "obstacle1"}, {"x_cm", "4000"}, {"y_cm", "0"}, {"heading_deg", "0"}}}));
}

}  // namespace
}  // namespace saca::encounter::verdict_json_test
