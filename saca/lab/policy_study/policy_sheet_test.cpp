#include "saca/lab/policy_study/policy_sheet.h"

#include <gmock/gmock.h>

#include "saca/lab/policy_study/oracle_for_test.h"

namespace saca::policy_study::policy_sheet_test {
namespace {

using testing::ElementsAre;

TEST(PolicySheet, WhatIsDrivenIsShownWithAllItsContactsInOrder) {
  eval::Oracle oracle = oracle_by_hand();
  encounter::Hindsight& tried = oracle.verdicts[7].written;
  tried.facts.outcome().later.push_back(collision::Contact{.time = 4.5, .actor = 0});
  tried.sequence.ego.track.X_WA = {{}, {{1.0, 0.0}, 0.0}};
  tried.sequence.others.resize(1);
  const report::SceneView view = view_of(oracle.scene, tried);
  EXPECT_EQ(view.title, "NI");
  EXPECT_EQ(view.policy, manoeuvre::PolicyId::no_intervention);
  ASSERT_EQ(view.contacts.size(), 2U);
  EXPECT_EQ(view.contacts[0].time, 4.0);
  EXPECT_EQ(view.contacts[1].time, 4.5);
  EXPECT_EQ(view.ego.X_WA.size(), 2U);
  EXPECT_EQ(view.others.size(), 1U);
}

TEST(PolicySheet, WhatIsRefusedShowsTheOthersWhereTheyStand) {
  eval::Oracle oracle = oracle_by_hand();
  oracle.scene.actors[0].X_WA.p = {30.0, 1.0};
  const report::SceneView view = view_of(oracle.scene, oracle.verdicts[5].written);
  EXPECT_THAT(view.lines, ElementsAre("no room"));
  EXPECT_TRUE(view.ego.X_WA.empty());
  ASSERT_EQ(view.others.size(), 1U);
  EXPECT_EQ(view.others[0].start, 2.5);
  ASSERT_EQ(view.others[0].X_WA.size(), 1U);
  EXPECT_EQ(view.others[0].X_WA[0].p.x, 30.0);
}

TEST(PolicySheet, TheBestComesFirstAndTheRefusedLast) {
  scenario::Scenario scenario;
  scenario.title = "A title";
  scenario.why = "A reason";
  scenario.source = "A source";
  const report::ContactSheet sheet = sheet_of(oracle_by_hand(), scenario);
  EXPECT_EQ(sheet.heading, "A title");
  EXPECT_THAT(sheet.lines, ElementsAre("A reason", "A source"));
  EXPECT_TRUE(sheet.same_ground);
  ASSERT_EQ(sheet.scenes.size(), 8U);
  EXPECT_EQ(sheet.scenes[0].title, "AEB");
  EXPECT_EQ(sheet.scenes[0].badge, "best");
  EXPECT_EQ(sheet.scenes[0].lines.back(), "expected harm 0.0100 (0.0050 to 0.0150)");
  EXPECT_EQ(sheet.scenes[1].title, "NI");
  EXPECT_EQ(sheet.scenes[1].badge, "");
  EXPECT_THAT(sheet.scenes[7].lines, ElementsAre("no room"));
}

}  // namespace
}  // namespace saca::policy_study::policy_sheet_test
