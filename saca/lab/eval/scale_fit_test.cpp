#include "saca/lab/eval/scale_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace saca::eval::scale_fit_test {
namespace {

/// Somebody stands ahead, and what every policy harms follows from the ego's speed alone.
memory::Case case_at(double speed, double grip, const std::string& source) {
  memory::Case one;
  one.scene.ego.v_B = {speed, 0.0};
  one.scene.ego_footprint = {.length = 4.7, .width = 1.9};
  one.scene.ego_mass = 1'700.0;
  one.scene.grip = grip;
  one.scene.road.left_edge = 5.25;
  memory::PolicyHarms harms{};
  harms.fill(0.02 * speed);
  one.told = harms;
  one.source = source;
  return one;
}

std::vector<memory::Case> many(std::size_t count, std::uint32_t seed) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> speed(5.0, 25.0);
  std::uniform_real_distribution<double> grip(0.3, 0.9);
  std::vector<memory::Case> cases;
  cases.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    cases.push_back(case_at(speed(rng), grip(rng), "a" + std::to_string(i)));
  }
  return cases;
}

TEST(ScaleError, IsTheMeanAbsoluteErrorOfTheWeightedMean) {
  // Two cases, 0.7 and 1.4 m/s away: weights exp(-1/2) and exp(-2).
  const std::vector<memory::Case> cases{case_at(10.7, 0.9, "a"), case_at(11.4, 0.9, "b")};
  const std::vector<memory::Case> queries{case_at(10.0, 0.9, "c")};
  const double near = std::exp(-0.5);
  const double far = std::exp(-2.0);
  const double predicted = 0.02 * (near * 10.7 + far * 11.4) / (near + far);
  EXPECT_NEAR(*scale_error(cases, queries, {}, 1), predicted - 0.2, 1e-5);
}

TEST(ScaleError, AsksNoCaseOfTheSameEncounterNorOfItsTwin) {
  const std::vector<memory::Case> cases{case_at(10.0, 0.9, "a"), case_at(10.0, 0.9, "a_twin"),
                                        case_at(12.0, 0.9, "b")};
  const std::vector<memory::Case> queries{case_at(10.0, 0.9, "a")};
  EXPECT_NEAR(*scale_error(cases, queries, {}, 1), 0.04, 1e-6);
}

TEST(ScaleError, SkipsWhatIsNotKnown) {
  std::vector<memory::Case> cases{case_at(10.0, 0.9, "a")};
  std::vector<memory::Case> queries{case_at(10.0, 0.9, "b"), case_at(15.0, 0.9, "c")};
  queries[1].told.reset();
  queries[0].told->at(3).reset();
  EXPECT_NEAR(*scale_error(cases, queries, {}, 2), 0.0, 1e-9);
  queries[0].told.reset();
  EXPECT_FALSE(scale_error(cases, queries, {}, 2).has_value());
}

TEST(ScaleFit, FindsThatSpeedMattersAndGripDoesNot) {
  const auto cases = many(600, 1);
  const auto queries = many(150, 2);
  int num_asked = 0;
  const auto fit =
      fit_scales(cases, queries, {}, 2, [&](int, double) { return ++num_asked < 400; });
  ASSERT_TRUE(fit && fit->is_done);
  EXPECT_GT(fit->scales.log_grip, 3.0 * match::Scales{}.log_grip);
  EXPECT_LT(fit->scales.speed, match::Scales{}.speed);
  EXPECT_LT(fit->error, 0.5 * fit->error_before);
  EXPECT_NEAR(*scale_error(cases, queries, fit->scales, 1), fit->error, 1e-12);
  EXPECT_EQ(fit->scales.heading, match::Scales{}.heading) << "assumed";
}

TEST(ScaleFit, EndsWhereItIsTold) {
  const auto cases = many(60, 1);
  const auto fit = fit_scales(cases, many(10, 2), {}, 1, [](int, double) { return false; });
  ASSERT_TRUE(fit);
  EXPECT_FALSE(fit->is_done);
  EXPECT_EQ(fit->error, fit->error_before);
}

}  // namespace
}  // namespace saca::eval::scale_fit_test
