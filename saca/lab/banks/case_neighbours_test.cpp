#include "saca/lab/banks/case_neighbours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>

#include "saca/lab/banks/banks_for_test.h"

namespace saca::banks::case_neighbours_test {
namespace {

using manoeuvre::PolicyId;

memory::Case at_speed(match::CaseId id, double speed) {
  memory::Case one = best_is(PolicyId::aeb, speed, "case");
  one.id = id;
  return one;
}

// A difference of 1 is 0.7 m/s (match::Scales) and 0.9 of similarity.
TEST(NearestCases, ComeWithWhatTheyDifferIn) {
  const std::vector<memory::Case> all{at_speed(1, 10.0), at_speed(2, 10.0), at_speed(3, 11.4),
                                      at_speed(4, 10.7)};
  const auto near = nearest_cases(all[0], all);
  ASSERT_EQ(near.size(), 3U) << "without itself";
  EXPECT_EQ(near[0].one, &all[1]);
  EXPECT_DOUBLE_EQ(near[0].similarity, 1.0);
  EXPECT_EQ(near[0].differs, "the same scene");
  EXPECT_EQ(near[1].one, &all[3]);
  EXPECT_NEAR(near[1].similarity, 0.9, 1e-4);
  EXPECT_EQ(near[1].differs, "differs: speed 1.0");
  EXPECT_EQ(near[2].one, &all[2]);
  EXPECT_NEAR(near[2].similarity, 0.81, 1e-4);
}

TEST(NearestCases, TellThreePartsTheLargestFirst) {
  std::vector<memory::Case> all{at_speed(1, 10.0), at_speed(2, 17.0)};
  all[1].scene.ego.X_WB.p.y = 0.5;
  all[1].scene.ego.yaw_rate = 0.05;
  all[1].scene.grip = 0.5;
  const std::string differs = nearest_cases(all[0], all).at(0).differs;
  EXPECT_EQ(differs.rfind("differs: speed 10.0, ", 0), 0U) << differs;
  EXPECT_EQ(std::count(differs.begin(), differs.end(), ','), 2);
}

TEST(NearestCases, AreFive) {
  std::vector<memory::Case> all;
  for (int k = 0; k < 9; ++k) {
    all.push_back(at_speed(k + 1, 10.0 + k));
  }
  EXPECT_EQ(nearest_cases(all[0], all).size(), 5U);
  EXPECT_TRUE(nearest_cases(all[0], {}).empty());
  EXPECT_TRUE(nearest_cases(all[0], std::span(all).first(1)).empty());
}

}  // namespace
}  // namespace saca::banks::case_neighbours_test
