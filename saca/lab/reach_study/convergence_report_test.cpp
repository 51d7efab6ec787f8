#include "saca/lab/reach_study/convergence_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace saca::reach_study::convergence_report_test {
namespace {

using testing::HasSubstr;

/// Of second order: half the spacing, a quarter of the error.
std::vector<verification::Refinement> of_second_order() {
  std::vector<verification::Refinement> all;
  for (const char* const name : {"a wave: upwind", "b", "c", "d", "Brake, (wall)"}) {
    all.push_back({name, {0.2, 0.1}, {4e-3, 1e-3}});
  }
  return all;
}

TEST(ConvergenceReport, NamesFiguresByTheProblem) {
  const nlohmann::json all = json_of(of_second_order());
  EXPECT_EQ(all.size(), 10U);
  EXPECT_DOUBLE_EQ(all.at("reach.check.a_wave_upwind.order"), 2.0);
  EXPECT_EQ(all.at("reach.check.a_wave_upwind.error_m"), 1e-3);
  EXPECT_DOUBLE_EQ(all.at("reach.check.brake_wall_.order"), 2.0);
}

TEST(ConvergenceReport, HasALineForEach) {
  const std::string text = text_of(of_second_order());
  EXPECT_THAT(text, testing::StartsWith("a wave: upwind                   mean error 1.00e-03 m at "
                                        "0.1000 m, order 2.00\nb "));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 5);
}

TEST(ConvergenceReport, DrawsSmoothOnesAndThoseWithKinksApart) {
  const std::string svg = convergence_chart(of_second_order());
  EXPECT_THAT(svg, HasSubstr("Smooth"));
  EXPECT_THAT(svg, HasSubstr("With kinks"));
  EXPECT_THAT(svg, HasSubstr("order 2.00 in the end"));
  EXPECT_LT(svg.find("a wave: upwind"), svg.find("Brake, (wall)"));
}

}  // namespace
}  // namespace saca::reach_study::convergence_report_test
