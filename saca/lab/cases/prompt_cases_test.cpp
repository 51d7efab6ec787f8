#include "saca/lab/cases/prompt_cases.h"

#include <gtest/gtest.h>

#include "saca/onboard/match/example_scenes.h"

namespace saca::cases::prompt_cases_test {
namespace {

memory::Case case_in(const world::Scene& scene, match::CaseId id, manoeuvre::PolicyId best) {
  memory::Case one;
  one.id = id;
  one.scene = scene;
  one.best = best;
  return one;
}

TEST(PromptCasesTest, TellsOfTheMostAlike) {
  const PromptCases told({case_in(match::empty_road(), 7, manoeuvre::PolicyId::no_intervention),
                          case_in(match::crossing_truck(), 3, manoeuvre::PolicyId::aeb)});
  const auto found = told.in(match::crossing_truck());
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->found.id, 3);
  EXPECT_DOUBLE_EQ(found->similarity, 1.0);
  EXPECT_EQ(told.in(match::empty_road())->found.id, 7);
}

TEST(PromptCasesTest, OfNoneThereIsNothingToTell) {
  EXPECT_FALSE(PromptCases({}).in(match::empty_road()).has_value());
}

}  // namespace
}  // namespace saca::cases::prompt_cases_test
