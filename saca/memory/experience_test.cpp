#include "saca/memory/experience.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "saca/memory/example_scenes.h"
#include "saca/memory/similarity.h"
#include "tests/support/count_allocations.h"

namespace saca::memory::experience_test {
namespace {

/// Told 0.1 of every policy, and this much more happened.
Case wrong_by(const world::Scene& scene, double error) {
  Case one;
  one.scene = scene;
  one.told.emplace();
  one.happened.emplace();
  for (std::size_t p = 0; p < manoeuvre::num_policies; ++p) {
    (*one.told)[p] = 0.1;
    (*one.happened)[p] = 0.1 + error;
  }
  return one;
}

TEST(Experience, OfNothingCorrectsNothing) {
  const Experience none({});
  EXPECT_EQ(none.size(), 0U);
  EXPECT_EQ(none.corrections(crossing_truck()), Corrections{});
}

// The same scene 60 times: 60 of 80 parts of the error, as 20 more erred by nothing.
TEST(Experience, IsShrunkAsIfSomeHadNotErred) {
  const std::vector<Case> cases(60, wrong_by(crossing_truck(), 0.2));
  const Experience experience(cases);
  EXPECT_EQ(experience.size(), 60U);
  for (const double one : experience.corrections(crossing_truck())) {
    EXPECT_NEAR(one, 0.2 * 60.0 / 80.0, 1e-12);
  }
}

TEST(Experience, FadesWithTheDifference) {
  const std::vector<Case> cases(20, wrong_by(empty_road(), -0.08));
  const Experience experience(cases);
  world::Scene faster = empty_road();
  faster.ego.v_B.x += 3.0;  // differs by 3, which is the reach
  const double weight = 20.0 * std::exp(-0.5);
  EXPECT_NEAR(experience.corrections(faster)[0], -0.08 * weight / (weight + 20.0), 1e-12);
  faster.ego.v_B.x += 60.0;
  EXPECT_NEAR(experience.corrections(faster)[0], 0.0, 1e-12);
}

TEST(Experience, CountsOneCrashByNoMoreThanTheBound) {
  const std::vector<Case> cases{wrong_by(empty_road(), 40.0)};
  EXPECT_NEAR(Experience(cases).corrections(empty_road())[3], 0.5 / 21.0, 1e-12);
}

TEST(Experience, KnowsOfEachPolicyWhatIsKnownOfIt) {
  Case one = wrong_by(empty_road(), 0.2);
  (*one.told)[5] = std::nullopt;
  (*one.happened)[6] = std::nullopt;
  const Corrections learnt = Experience({&one, 1}).corrections(empty_road());
  EXPECT_EQ(learnt[5], 0.0);
  EXPECT_EQ(learnt[6], 0.0);
  EXPECT_NEAR(learnt[7], 0.2 / 21.0, 1e-12);
}

TEST(Experience, LeavesOutWhoIsQuarantinedOrKnowsTooLittle) {
  Case distrusted = wrong_by(empty_road(), 0.2);
  distrusted.trust = Trust::quarantined;
  Case untold = wrong_by(empty_road(), 0.2);
  untold.told.reset();
  Case old = wrong_by(empty_road(), 0.2);
  old.happened.reset();
  const std::vector<Case> cases{distrusted, untold, old};
  EXPECT_EQ(Experience(cases).size(), 0U);
}

// Oracle: all cases, sorted.
TEST(Experience, IsThatOfTheNearest) {
  std::mt19937 rng(1);
  std::normal_distribution<double> error(0.0, 0.1);
  std::vector<Case> cases;
  for (int i = 0; i < 500; ++i) {
    world::Scene scene = random_scene(rng, 2);
    cases.push_back(wrong_by(scene, error(rng)));
  }
  const Experience experience(cases);
  for (int i = 0; i < 10; ++i) {
    const world::Scene scene = random_scene(rng, 2);
    std::vector<std::pair<double, double>> by_difference;
    for (const Case& one : cases) {
      const double apart = std::log(similarity(one.scene, scene)) / std::log(0.9);
      by_difference.emplace_back(apart, (*one.happened)[0].value() - 0.1);
    }
    std::sort(by_difference.begin(), by_difference.end());
    by_difference.resize(Experience::most_cases);
    double sum = 0.0;
    double weights = Experience::prior_cases;
    for (const auto& [apart, wrong] : by_difference) {
      const double weight = std::exp(-0.5 * apart * apart / 9.0);
      sum += weight * wrong;
      weights += weight;
    }
    EXPECT_NEAR(experience.corrections(scene)[0], sum / weights, 1e-9);
  }
}

TEST(Experience, IsNothingInASceneThatIsNone) {
  const std::vector<Case> cases(5, wrong_by(crossing_truck(), 0.2));
  world::Scene broken = crossing_truck();
  broken.ego.v_B.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Experience(cases).corrections(broken), Corrections{});
}

TEST(Experience, AllocatesNothingWhenAsked) {
  std::mt19937 rng(2);
  std::vector<Case> cases;
  for (int i = 0; i < 300; ++i) {
    cases.push_back(wrong_by(random_scene(rng, 4), 0.1));
  }
  const Experience experience(cases);
  const world::Scene scene = random_scene(rng, 4);
  const std::size_t before = num_allocations;
  const double asked = experience.corrections(scene)[0];
  EXPECT_EQ(num_allocations, before);
  EXPECT_GE(asked, 0.0);
}

}  // namespace
}  // namespace saca::memory::experience_test
