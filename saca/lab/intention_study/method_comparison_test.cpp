#include "saca/lab/intention_study/method_comparison.h"

#include <gmock/gmock.h>

#include <cmath>

#include "saca/lab/intention_study/sets_for_test.h"

namespace saca::intention_study::method_comparison_test {
namespace {

using intention_scoring::Forecasts;
using testing::ElementsAre;

TEST(ScoredSequences, AreWhatWasRecordedOrSimulatedToTestWith) {
  const intention_scoring::SequenceSet set = small_set();
  EXPECT_THAT(recorded_of(set).splits, ElementsAre("part-0", "part-1"));
  const ScoredSet site = recorded_of(set, "lankershim");
  ASSERT_EQ(site.sequences.size(), 1U);
  EXPECT_EQ(site.sequences[0].name, "b");
  EXPECT_TRUE(recorded_of(set, "nowhere").sequences.empty());
  const ScoredSet simulated = simulated_of(set);
  ASSERT_EQ(simulated.sequences.size(), 1U);
  EXPECT_EQ(simulated.sequences[0].name, "d");
}

TEST(NothingShared, HidesControlsAndNothingElse) {
  ScoredSet scored = recorded_of(small_set());
  auto& seen = scored.sequences[0].observations[0];
  seen.brake = seen.throttle = seen.steering = 0.5;
  const auto hidden = nothing_shared(scored).sequences[0].observations[0];
  EXPECT_TRUE(std::isnan(hidden.brake));
  EXPECT_TRUE(std::isnan(hidden.throttle));
  EXPECT_TRUE(std::isnan(hidden.steering));
  EXPECT_EQ(hidden.speed, 10.0);
}

/// Four groups of 20 frames M, then 20 FB.
ScoredSet four() {
  ScoredSet scored;
  for (const char* const name : {"a", "b", "c", "d"}) {
    scored.sequences.push_back(
        recorded_sequence(name, "here", std::string(20, 'M') + std::string(20, 'B')));
    scored.splits.emplace_back("part-0");
  }
  return scored;
}

/// All heads are this sure of what comes at the frame that they foretell.
std::vector<Forecasts> right(const ScoredSet& scored, double sure) {
  std::vector<Forecasts> all(scored.sequences.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& labels = scored.sequences[i].labels;
    for (std::size_t head = 0; head < intention_scoring::num_heads; ++head) {
      for (std::size_t t = 0; t < labels.size(); ++t) {
        const std::size_t then =
            std::min(t + intention_scoring::frames_ahead[head], labels.size() - 1);
        all[i].at[head].push_back(intention_scoring::mostly(labels[then], sure));
      }
    }
  }
  return all;
}

TEST(AComparison, HoldsEachMethodAgainstTheFirst) {
  const ScoredSet scored = four();
  MethodComparison comparison("Four", scored, intention_scoring::recorded_classes, 1);
  comparison.add("ours", right(scored, 0.9));
  comparison.add("as good, less sure", right(scored, 0.5));
  comparison.add("M always",
                 std::vector<Forecasts>(4, intention_scoring::all_heads(std::string(40, 'M'))));
  ASSERT_EQ(comparison.methods().size(), 3U);
  EXPECT_EQ(comparison.title(), "Four");
  const MethodFigures& ours = comparison.methods()[0];
  EXPECT_EQ(ours.figures.macro_f1[0]->value, 1.0);
  EXPECT_FALSE(ours.macro_f1_difference[0].has_value());
  const MethodFigures& less_sure = comparison.methods()[1];
  EXPECT_EQ(less_sure.macro_f1_difference[2]->value, 0.0);
  EXPECT_NEAR(less_sure.log_loss_difference[0]->value, std::log(0.5) - std::log(0.9), 1e-12);
  // F1 of M: 20 of 40 called so are; of FB: none is found.
  const double of_m = 2.0 * 0.5 * 1.0 / (0.5 + 1.0);
  EXPECT_NEAR(comparison.methods()[2].macro_f1_difference[0]->value, 1.0 - 0.5 * of_m, 1e-12);
}

TEST(AComparison, TellsWhereOurForecastsSeeVehicles) {
  ScoredSet scored;
  scored.sequences = {recorded_sequence("a", "here", std::string(61, 'M'))};
  scored.splits = {"part-0"};
  MethodComparison comparison("One", scored, intention_scoring::recorded_classes, 1);
  EXPECT_EQ(comparison.displacements({}).all[0][0].num, 0U);  // nothing was foretold
  comparison.add("ours", right(scored, 1.0));
  comparison.add("other",
                 std::vector<Forecasts>{intention_scoring::all_heads(std::string(61, 'B'), 1.0)});
  const auto found = comparison.displacements({});
  for (const auto& foresight : found.all) {
    EXPECT_EQ(foresight[2].num, 7U);  // every half a second, 3 s before the end
    EXPECT_NEAR(foresight[2].mean(), 0.0, 1e-6);
  }
}

}  // namespace
}  // namespace saca::intention_study::method_comparison_test
