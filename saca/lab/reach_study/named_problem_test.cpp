#include "saca/lab/reach_study/named_problem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/lab/installation/here_for_test.h"

namespace saca::reach_study::named_problem_test {
namespace {

using testing::HasSubstr;

TEST(NamedProblem, IsAShippedCaseAFileOrAir3d) {
  const auto here = installation::here_for_test();
  EXPECT_TRUE(named_problem(here, "air3d").has_value());
  EXPECT_TRUE(named_problem(here, "paper_ellipse").has_value());
  EXPECT_TRUE(named_problem(here, "data/reach/paper_ellipse.toml").has_value());
  EXPECT_THAT(named_problem(here, "none").error().message, HasSubstr(", or air3d"));
  EXPECT_THAT(named_problem(here, "scenarios/one_way.toml").error().message,
              HasSubstr("one_way.toml"));
}

}  // namespace
}  // namespace saca::reach_study::named_problem_test
