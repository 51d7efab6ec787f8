#include "saca/lab/intention_study/evaluation.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "saca/lab/intention_scoring/forecast_file.h"
#include "saca/lab/intention_scoring/intention_baselines.h"
#include "saca/lab/intention_study/sets_for_test.h"

namespace saca::intention_study::evaluation_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> names_of(const Comparison& comparison) {
  std::vector<std::string> names;
  for (const MethodFigures& method : comparison.methods) {
    names.push_back(method.method);
  }
  return names;
}

intention_scoring::ModelsByLeftOut shipped() {
  auto models = intention_scoring::read_models("models/intent");
  EXPECT_TRUE(models.has_value());
  return std::move(models).value();
}

TEST(AnEvaluation, ScoresWhatWasRecordedSimulatedAndSeenAtSitesThatModelsLeftOut) {
  const auto found = evaluate(small_set(), shipped(), {}, 1, 2);
  ASSERT_TRUE(found.has_value()) << found.error().message;
  const auto& all = found.value().comparisons;
  ASSERT_EQ(all.size(), 4U);
  EXPECT_THAT(names_of(all[0]), ElementsAre("LSTM-CRF", "LSTM-CRF, nothing shared", "CRF by hand",
                                            "causal rule", "constant motion"));
  EXPECT_EQ(all[0].methods[4].figures.tallies[0].confusion.counts[0][0], 60U);  // M, called M
  EXPECT_EQ(all[0].methods[4].figures.tallies[0].confusion.counts[3][0], 20U);  // FB, called M
  EXPECT_EQ(all[1].title, "Simulated vehicles (LB, RB)");
  EXPECT_EQ(all[1].methods[0].figures.tallies[0].confusion.total(), 60U);
  EXPECT_EQ(all[2].title, "Transfer: lankershim");
  EXPECT_THAT(names_of(all[2]), ElementsAre("its site seen", "its site never seen"));
  EXPECT_EQ(all[2].methods[0].figures.tallies[0].confusion.total(), 40U);
  EXPECT_EQ(all[3].title, "Transfer: us101");
  EXPECT_EQ(found.value().displacements.all[0][0].num, 4U);  // 2 in each 4 s, but for the last 3 s
}

TEST(AnEvaluation, DoesWithoutWhatTheSetHasNot) {
  intention_scoring::SequenceSet set = small_set();
  set.sequences.resize(1);
  set.splits.resize(1);
  const auto found = evaluate(set, shipped(), {}, 1, 1);
  ASSERT_TRUE(found.has_value());
  ASSERT_EQ(found.value().comparisons.size(), 2U);
  EXPECT_EQ(found.value().comparisons[1].title, "Transfer: us101");
}

TEST(AnEvaluation, HasRivalsInTheirOrder) {
  const std::string file = testing::TempDir() + "evaluation_test_forecasts.h5";
  const auto recorded = recorded_of(small_set());
  intention_scoring::ForecastSet foreign{.model = "foreign", .names = {}, .forecasts = {}};
  for (const auto& sequence : recorded.sequences) {
    foreign.names.push_back(sequence.name);
    foreign.forecasts.push_back(intention_scoring::constant_motion(sequence));
  }
  ASSERT_EQ(intention_scoring::write_forecasts(file, foreign), std::nullopt);
  const Rivals rivals{
      .plain_models = "models/intent", .other_models = "models/intent", .forecasts = {file}};
  const auto found = evaluate(small_set(), shipped(), rivals, 1, 2);
  ASSERT_TRUE(found.has_value()) << found.error().message;
  const Comparison& first = found.value().comparisons[0];
  EXPECT_THAT(names_of(first),
              ElementsAre("LSTM-CRF", "LSTM-CRF, nothing shared", "LSTM-CRF of another training",
                          "LSTM without CRF", "CRF by hand", "causal rule", "constant motion",
                          "foreign", "foreign, calibrated as ours"));
  EXPECT_EQ(first.methods[2].log_loss_difference[0]->value, 0.0);  // the same weights
  EXPECT_EQ(first.methods[7].figures.tallies[0].confusion.counts,
            first.methods[6].figures.tallies[0].confusion.counts);
}

TEST(AnEvaluation, RefusesWhatIsMissing) {
  intention_scoring::SequenceSet set = small_set();
  EXPECT_THAT(evaluate(set, shipped(), {.other_models = "nowhere"}, 1, 1).error().message,
              HasSubstr("nowhere"));
  EXPECT_THAT(evaluate(set, shipped(), {.plain_models = "nobody"}, 1, 1).error().message,
              HasSubstr("nobody"));
  EXPECT_THAT(evaluate(set, shipped(), {.forecasts = {"none.h5"}}, 1, 1).error().message,
              HasSubstr("none.h5"));
  set.splits[0] = "part-77";
  EXPECT_THAT(evaluate(set, shipped(), {}, 1, 1).error().message, HasSubstr("part-77"));
}

TEST(TheConfusion, IsDrawnOfOurModelsNow) {
  Evaluation evaluation;
  evaluation.comparisons.push_back({.title = "x", .methods = std::vector<MethodFigures>(2)});
  evaluation.comparisons[0].methods[0].figures.tallies[0].confusion.counts[0][3] = 4711;
  evaluation.comparisons[0].methods[1].figures.tallies[0].confusion.counts[0][3] = 815;
  const std::string svg = confusion_svg(evaluation);
  EXPECT_THAT(svg, testing::StartsWith("<svg"));
  EXPECT_THAT(svg, HasSubstr("4711"));
  EXPECT_THAT(svg, testing::Not(HasSubstr("815<")));
}

}  // namespace
}  // namespace saca::intention_study::evaluation_test
