#include "saca/lab/eval/curriculum_figures.h"

#include <gmock/gmock.h>

#include <cmath>

namespace saca::eval::curriculum_figures_test {
namespace {

/// Harms of curriculum_methods, the best of all plans harming nobody.
Episode harming(const std::array<double, curriculum_methods.size()>& harms) {
  Episode episode;
  for (const double harm : harms) {
    episode.row.risk.runs.push_back({.harm = harm});
  }
  return episode;
}

/// Two seeds, three encounters of each.
std::vector<Episodes> some() {
  std::vector<Episodes> all(3);
  for (Episodes& one : all) {
    one.size = {{0, 2, 4}, {0, 3, 5}};
  }
  all[0].of = {harming({0.1, 0.0, 0.1, 0.3, 0.2, 0.1}), harming({0.2, 0.2, 0.2, 0.2, 0.2, 0.2})};
  all[1].of = {harming({0.3, 0.2, 0.3, 0.3, 0.3, 0.1}), harming({0.0, 0.2, 0.2, 0.2, 0.2, 0.2})};
  all[2].of = {harming({9.0, 9.0, 9.0, 9.0, 9.0, 9.0}), harming({0.1, 0.2, 0.2, 0.2, 0.2, 0.2})};
  all[2].of[0].row.fault = "could not be played";
  return all;
}

// Seed 1: (0.1 + 0.3) / 2, a fault left out; seed 2: (0.2 + 0 + 0.1) / 3. Student's t with 1 degree
// of freedom: 12.706 standard errors (any table).
TEST(CurriculumFigures, AreMeansOfTheMeansOfSeeds) {
  const std::vector<Episodes> all = some();
  const Estimate harm = over_seeds(all, 0, episode_harm);
  EXPECT_NEAR(harm.value, 0.15, 1e-12);
  EXPECT_NEAR(harm.high - harm.value, 12.706 * 0.1 / std::sqrt(2.0) / std::sqrt(2.0), 1e-4);
  EXPECT_EQ(harm.n, 2);
  EXPECT_NEAR(harm_over(all, {1, 0}).value, 0.5 * (-0.1 + 0.1), 1e-12);
  EXPECT_NEAR(harm_over(all, {4, 3}).value, 0.5 * (-0.05 + 0.0), 1e-12);
  // 0.3 is more than AEB's 0.1; 0.1 and 0.2 are not.
  EXPECT_NEAR(over_seeds(all, 0, episode_worse_than_aeb).value, 0.5 * (0.5 + 0.0), 1e-12);
  EXPECT_EQ(over_seeds(all, 0, episode_acts).value, 0.0);
}

TEST(CurriculumFigures, OfNothingThereIsNone) {
  const std::vector<Episodes> all = some();
  EXPECT_EQ(over_seeds(all, 0, episode_from_memory).n, 0);  // nobody thought
  EXPECT_THROW((void)over_seeds({}, 0, episode_harm), ContractViolation);
}

TEST(CurriculumFigures, CountWhatWasThoughtAndWhatIsKnown) {
  std::vector<Episodes> all = some();
  all[0].of[0].row.risk.runs[1].thinking =
      encounter::ThinkingFigures{.forecasts = 4, .from_memory = 1};
  all[1].of[1].row.risk.runs[1].thinking =
      encounter::ThinkingFigures{.forecasts = 2, .from_memory = 2};
  all[2].of[0].row.risk.runs[1].thinking =
      encounter::ThinkingFigures{.forecasts = 7};  // of a fault
  EXPECT_EQ(thought(all, 1).forecasts, 6);
  EXPECT_EQ(thought(all, 1).from_memory, 3);
  EXPECT_NEAR(over_seeds(all, 1, episode_from_memory).value, 0.5 * (0.25 + 1.0), 1e-12);
  EXPECT_EQ(mean_size(all.back(), Learner::learning), 2.5);
  EXPECT_EQ(count_episodes(all, [](const Episode& one) { return !one.row.fault.empty(); }), 1);
}

TEST(CurriculumFigures, BlocksHoldEachEpisodeOnce) {
  for (const std::size_t count : {1U, 9U, 10U, 11U, 25U}) {
    const std::vector<Episodes> all(count);
    const auto blocks = blocks_of(all);
    EXPECT_EQ(blocks.size(), std::min<std::size_t>(count, 10));
    const Episodes* next = all.data();
    for (const auto& block : blocks) {
      EXPECT_EQ(block.data(), next);
      EXPECT_LE(block.size(), count / blocks.size() + 1);
      next += block.size();
    }
    EXPECT_EQ(next, all.data() + count);
  }
}

}  // namespace
}  // namespace saca::eval::curriculum_figures_test
