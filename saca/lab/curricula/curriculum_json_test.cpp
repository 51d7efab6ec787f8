#include "saca/lab/curricula/curriculum_json.h"

#include <gtest/gtest.h>

#include "saca/lab/curricula/episodes_for_test.h"

namespace saca::curricula::curriculum_json_test {
namespace {

using nlohmann::json;

// Means of seeds: frozen (0.1 + 0.3) / 2 and (0.2 + 0) / 2; learning 0.1 and 0.2.
TEST(CurriculumJson, TellsMeansOverSeedsOfEachMethod) {
  const json out = json_of(some_episodes(), "made");
  EXPECT_DOUBLE_EQ(out["learn.made.frozen.harm"].get<double>(), 0.15);
  EXPECT_EQ(out["learn.made.frozen.harm.n"], 2);
  EXPECT_LT(out["learn.made.frozen.harm.lo"], out["learn.made.frozen.harm"]);
  EXPECT_DOUBLE_EQ(out["learn.made.learning.harm"].get<double>(), 0.15);
  EXPECT_DOUBLE_EQ(out["learn.made.frozen.regret"].get<double>(), 0.15);
  // 0.3 is materially more than AEB's 0.1; 0.2 and 0 are not.
  EXPECT_DOUBLE_EQ(out["learn.made.frozen.materially_worse_than_aeb"].get<double>(), 0.25);
  EXPECT_EQ(out["learn.made.aeb.acts"], 0.0);
  EXPECT_EQ(out["learn.made.episodes"], 2);
  EXPECT_EQ(out["learn.made.seeds"], 2);
  EXPECT_EQ(out["learn.made.faults"], 0);
  EXPECT_EQ(out["learn.made.lies"], 0);
}

TEST(CurriculumJson, OnlyWhoRemembersHasCases) {
  std::vector<eval::Episodes> all = some_episodes();
  all[1].of[0].refuted[1] = match::CaseId{7};
  const json out = json_of(all, "made");
  EXPECT_EQ(out["learn.made.learning.cases"], 2.5);
  EXPECT_EQ(out["learn.made.poisoned.cases"], 4.5);
  EXPECT_EQ(out["learn.made.learning.forecasts"], 6);
  EXPECT_EQ(out["learn.made.learning.from_memory"], 3);
  EXPECT_EQ(out["learn.made.learning.asked_model"], 2);
  EXPECT_EQ(out["learn.made.learning.refuted"], 1);
  EXPECT_EQ(out["learn.made.frozen.refuted"], 0);
  all[1].of[0].row.fault = "a method threw";
  EXPECT_EQ(json_of(all, "made")["learn.made.learning.refuted"], 0)
      << "it is left out, and not learnt";
  EXPECT_FALSE(out.contains("learn.made.aeb.cases"));
  EXPECT_FALSE(out.contains("learn.made.drawn.forecasts"));
}

TEST(CurriculumJson, PairsAreComparedAndSoIsEachPart) {
  const json out = json_of(some_episodes(), "made");
  EXPECT_NEAR(out["learn.made.learning.harm_over_frozen"].get<double>(), 0.0, 1e-12);
  EXPECT_NEAR(out["learn.made.corrected.harm_over_drawn"].get<double>(), -0.025, 1e-12);
  // Each part has one encounter: of the first -0.1 and 0, of the second -0.1 and 0.2.
  EXPECT_NEAR(out["learn.made.learning.block1.harm_over_frozen"].get<double>(), -0.05, 1e-12);
  EXPECT_NEAR(out["learn.made.learning.block2.harm_over_frozen"].get<double>(), 0.05, 1e-12);
  EXPECT_NEAR(out["learn.made.frozen.block1.regret"].get<double>(), 0.15, 1e-12);
  EXPECT_FALSE(out.contains("learn.made.frozen.block3.regret"));
}

TEST(CurriculumJson, WhatCouldNotBePlayedIsCountedAndLeftOut) {
  std::vector<eval::Episodes> all = some_episodes();
  all[0].of[0].row.fault = "it could not be drawn";
  const json out = json_of(all, "made");
  EXPECT_EQ(out["learn.made.faults"], 1);
  EXPECT_DOUBLE_EQ(out["learn.made.frozen.harm"].get<double>(), 0.2);  // 0.3 and 0.1
}

}  // namespace
}  // namespace saca::curricula::curriculum_json_test
