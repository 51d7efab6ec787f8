#include "saca/lab/encounter/verdict_log.h"

#include <gtest/gtest.h>

#include "saca/base/core/contract.h"
#include "saca/thinking/intent/shipped_model.h"
#include "tests/support/scenes.h"

namespace saca::encounter::verdict_log_test {
namespace {

using manoeuvre::PolicyId;

/// A log that is shown one scene after the other.
class Watched {
 public:
  /// A look at `time`, in which perhaps a verdict of the scene at `of` came.
  void look(double time, std::optional<double> of = std::nullopt) {
    world::Scene scene = test::ego_at(15.0);
    scene.time = time;
    scene.actors.push_back(test::car(1, {40.0 - time, 0.0}));
    log.note(scene, intent::beliefs_at_sight(intent::shipped_model(), scene),
             of ? std::optional(reflex::Verdict{.time = *of}) : std::nullopt);
  }
  void decide(PolicyId policy, std::optional<double> of, bool by_atlas = false) {
    reflex::Decision decision{.plan = {policy, std::nullopt}};
    if (of) {
      decision.verdict = reflex::Verdict{.time = *of};
    }
    decision.by_atlas = by_atlas;
    log.note(decision);
  }
  void switch_to(PolicyId policy) { log.note(reflex::Switch{.plan = {policy, std::nullopt}}); }

  VerdictLog log;
};

TEST(VerdictLog, KeepsEveryVerdictWithWhatWasUnderWayInItsScene) {
  Watched watched;
  watched.look(0.00);
  watched.look(0.01, 0.00);
  watched.decide(PolicyId::aeb, 0.00);
  watched.look(0.02, 0.01);  // of the scene in which braking began: nothing was under way yet
  watched.look(0.03, 0.02);
  watched.switch_to(PolicyId::aes_left);
  watched.look(0.04);
  watched.look(0.05, 0.03);
  watched.look(0.06, 0.05);
  const auto& all = watched.log.verdicts();
  ASSERT_EQ(all.size(), 5U);
  EXPECT_EQ(all[0].received, 0.01);
  EXPECT_EQ(all[0].verdict.time, 0.00);
  EXPECT_EQ(all[0].under_way, std::nullopt);
  EXPECT_EQ(all[1].under_way, std::nullopt);
  EXPECT_EQ(all[2].under_way->policy, PolicyId::aeb);
  EXPECT_EQ(all[3].under_way->policy, PolicyId::aeb);
  EXPECT_EQ(all[4].under_way->policy, PolicyId::aes_left);
}

TEST(VerdictLog, KeepsTheScenesByWhoseVerdictsPlansWereBegun) {
  Watched watched;
  watched.look(0.00);
  watched.look(0.03);
  watched.look(0.08, 0.03);
  watched.decide(PolicyId::aeb, 0.03);
  watched.look(0.10, 0.08);
  watched.look(0.12);
  watched.switch_to(PolicyId::aes_left);  // by the newest that there was
  const auto& judged = watched.log.judged();
  ASSERT_EQ(judged.size(), 2U);
  EXPECT_EQ(judged[0].begun, 0.08);
  EXPECT_EQ(judged[0].scene.time, 0.03);
  EXPECT_EQ(judged[0].scene.actors[0].X_WA.p.x, 40.0 - 0.03);
  EXPECT_EQ(judged[0].beliefs.size(), 1U);
  EXPECT_FALSE(judged[0].by_atlas);
  EXPECT_EQ(judged[1].begun, 0.12);
  EXPECT_EQ(judged[1].scene.time, 0.08);
}

// The reflex plane judges the very scene in which it decides, and does not keep that verdict.
TEST(VerdictLog, TellsTheReflexPlanesOwnVerdictFromThoseOfTheForecaster) {
  Watched watched;
  watched.look(0.00, -0.5);  // too old
  watched.decide(PolicyId::aeb, 0.00, true);
  watched.look(0.10, 0.05);
  watched.switch_to(PolicyId::aes_left);
  const auto& all = watched.log.verdicts();
  ASSERT_EQ(all.size(), 3U);
  EXPECT_FALSE(all[0].by_atlas);
  EXPECT_TRUE(all[1].by_atlas);
  EXPECT_EQ(all[1].verdict.time, 0.00);
  EXPECT_FALSE(all[2].by_atlas);
  ASSERT_EQ(watched.log.judged().size(), 1U) << "the scene at 0.05 s was not seen";
  EXPECT_TRUE(watched.log.judged()[0].by_atlas);
}

TEST(VerdictLog, KeepsNoSceneWhereNoVerdictWasDecidedBy) {
  Watched watched;
  watched.look(0.00);
  watched.decide(PolicyId::aeb, std::nullopt);
  EXPECT_TRUE(watched.log.verdicts().empty());
  EXPECT_TRUE(watched.log.judged().empty());
}

TEST(VerdictLog, IsBoundedInTheScenesThatItKeeps) {
  Watched watched;
  for (int k = 0; k < 40; ++k) {
    watched.look(0.1 * k, 0.1 * k);
    watched.switch_to(k % 2 == 0 ? PolicyId::aeb : PolicyId::no_intervention);
  }
  EXPECT_EQ(watched.log.judged().size(), VerdictLog::most_judged);
  EXPECT_EQ(watched.log.judged().back().begun, 0.1 * 7);
  EXPECT_EQ(watched.log.verdicts().size(), 40U);
}

TEST(VerdictLog, RefusesBeliefsThatAreNotOnePerActor) {
  VerdictLog log;
  world::Scene scene = test::ego_at(15.0);
  scene.actors.push_back(test::car(1, {40.0, 0.0}));
  EXPECT_THROW(log.note(scene, {}, std::nullopt), ContractViolation);
}

}  // namespace
}  // namespace saca::encounter::verdict_log_test
