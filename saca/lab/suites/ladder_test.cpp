#include "saca/lab/suites/ladder.h"

#include <gmock/gmock.h>

#include "saca/lab/eval/methods.h"
#include "saca/lab/suites/rows_for_test.h"

namespace saca::suites::ladder_test {
namespace {

using testing::Contains;
using testing::Not;

const ThinkingOptions everything{.memory = "bank.db", .model = "local", .untuned = ""};

TEST(Rungs, AreMethodsEachBelowOneThatIsThere) {
  for (const auto& rungs : {rungs_with({}, ""), rungs_with(everything, "weights")}) {
    const auto names = names_of(rungs);
    ASSERT_EQ(names.size(), rungs.size());
    EXPECT_THAT(names, Contains("aeb"));
    for (const Rung& rung : rungs) {
      EXPECT_NE(eval::find_method(rung.method), nullptr) << rung.method;
      if (rung.above != nullptr) {
        EXPECT_THAT(names, Contains(rung.above)) << rung.method;
      }
    }
  }
}

TEST(Rungs, OfWhatWasNotGivenAreLeftOut) {
  EXPECT_THAT(names_of(rungs_with({}, "")), Not(Contains("saca")));
  EXPECT_THAT(names_of(rungs_with({}, "")), Not(Contains("least_danger")));
  EXPECT_THAT(names_of(rungs_with({}, "weights")), Contains("least_danger"));
  EXPECT_THAT(names_of(rungs_with({.memory = "", .model = "local", .untuned = ""}, "")),
              Contains("saca"));
  EXPECT_THAT(names_of(rungs_with(everything, "")), Contains("beliefs_and_experience"));
}

TEST(Climb, HoldsEachRungAgainstTheOneAbove) {
  const std::vector<Rung> rungs{{"oracle", nullptr, "top"}, {"aeb", "oracle", "always braking"}};
  const auto climbed = climb(made_run({"oracle", "aeb"}, {made_row(0, "a", {0.0, 0.3}, 0.0),
                                                          made_row(1, "a", {0.1, 0.2}, 0.0),
                                                          failed_row(2, "a", "no road")}),
                             rungs, 1);
  ASSERT_EQ(climbed.size(), 2U);
  EXPECT_FALSE(climbed[0].step.has_value());
  EXPECT_EQ(climbed[1].rung.method, std::string("aeb"));
  EXPECT_NEAR(climbed[1].figures.regret.value, 0.25, 1e-12);
  ASSERT_TRUE(climbed[1].step.has_value());
  EXPECT_NEAR(climbed[1].step->value, 0.2, 1e-12);
  EXPECT_EQ(climbed[1].step->n, 2);
}

TEST(Climb, WithoutARowThereIsNoRung) {
  EXPECT_TRUE(
      climb(made_run({"aeb"}, {failed_row(0, "a", "no road")}), {{"aeb", nullptr, "top"}}, 1)
          .empty());
}

}  // namespace
}  // namespace saca::suites::ladder_test
