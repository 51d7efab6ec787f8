#include "saca/lab/forecast_study/forecast_figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace saca::forecast_study::forecast_figures_test {
namespace {

using eval::ForecastSample;
using eval::MotionModel;

constexpr auto shipped = static_cast<std::size_t>(MotionModel::shipped);
constexpr auto law = static_cast<std::size_t>(MotionModel::law);

/// All models give this likelihood at all times, but the shipped one, which is better by 1.
ForecastSample sample(double nll, bool acts) {
  ForecastSample one{.who = "car1", .acts = acts};
  for (std::size_t m = 0; m < eval::motion_models.size(); ++m) {
    for (eval::PlaceScore& score : one.scores[m]) {
      score = {
          .nll = m == shipped ? nll - 1.0 : nll, .miss = 0.0, .pit_along = 0.5, .pit_across = 0.5};
    }
  }
  return one;
}

/// In the first encounter two samples, one of which acts; in the second, of another family, one.
ForecastStudy two_encounters() {
  return {.encounters = {{.family = "b", .samples = {sample(2.0, true), sample(4.0, false)}},
                         {.family = "a", .samples = {sample(7.0, false)}},
                         {.family = "b", .problem = "cannot be drawn", .samples = {}}},
          .notes = {}};
}

const FigureLine& line_of(const FigureGroup& group, MotionModel model, const std::string& figure,
                          std::size_t time) {
  for (const FigureLine& line : group.lines) {
    if (line.model == model && forecast_figures()[line.figure].name == figure &&
        line.time == time) {
      return line;
    }
  }
  throw std::runtime_error("no such line: " + figure);
}

TEST(ForecastFigures, AreMeansOverEncountersNotOverRoadUsers) {
  const StudyFigures figures = figures_of(two_encounters(), 1);
  EXPECT_EQ(figures.num_encounters, 3U);
  EXPECT_EQ(figures.num_failed, 1);
  EXPECT_EQ(figures.num_forecasts, 3U);
  EXPECT_EQ(figures.num_acting, 1U);
  const FigureLine& all = line_of(figures.groups.at(0), MotionModel::law, "nll", 2);
  EXPECT_DOUBLE_EQ(all.mean.value, (3.0 + 7.0) / 2.0);
  EXPECT_EQ(all.mean.n, 2) << "in the third there is nobody";
  const FigureLine& acting = line_of(figures.groups.at(1), MotionModel::law, "nll", 2);
  EXPECT_DOUBLE_EQ(acting.mean.value, 2.0);
  EXPECT_EQ(acting.mean.n, 1);
  EXPECT_EQ(line_of(figures.groups.at(2), MotionModel::law, "nll", 2).mean.n, 0)
      << "nobody moves aside";
}

TEST(ForecastFigures, AreOfGroupsInTheirOrder) {
  const StudyFigures figures = figures_of(two_encounters(), 1);
  std::vector<std::string> names;
  for (const FigureGroup& group : figures.groups) {
    names.push_back(group.name);
  }
  EXPECT_THAT(names, testing::ElementsAre("all", "acting", "aside", "a_acting", "b_acting"));
  // Seven figures at four times and two over all; of a family the likelihood alone.
  EXPECT_EQ(figures.groups[0].lines.size(), (7U * 4U + 2U) * eval::motion_models.size());
  EXPECT_EQ(figures.groups[3].lines.size(), 4U * eval::motion_models.size());
  EXPECT_EQ(line_of(figures.groups[3], MotionModel::law, "nll", 0).mean.n, 0);
  EXPECT_EQ(line_of(figures.groups[4], MotionModel::law, "nll", 0).mean.n, 1);
}

TEST(ForecastFigures, OfTheLikelihoodAreHeldAgainstTheShippedModelInPairs) {
  const FigureGroup all = figures_of(two_encounters(), 1).groups.at(0);
  const auto& above = line_of(all, MotionModel::constant_turn, "nll", 0).above_shipped;
  ASSERT_TRUE(above);
  EXPECT_DOUBLE_EQ(above->value, 1.0);
  EXPECT_DOUBLE_EQ(above->low, 1.0) << "it is so in every encounter";
  EXPECT_DOUBLE_EQ(above->high, 1.0);
  EXPECT_FALSE(line_of(all, MotionModel::shipped, "nll", 0).above_shipped);
  EXPECT_FALSE(line_of(all, MotionModel::law, "miss_of_6", 0).above_shipped);
}

TEST(ForecastFigures, CountWhatLiesInTheCentralRegions) {
  ForecastSample one = sample(0.0, false);
  one.scores[law][1] = {.nll = 0.0, .miss = 2.5, .pit_along = 0.8, .pit_across = 0.04};
  one.mean_miss_of_6[law] = 1.5;
  one.mean_miss_of_12[law] = 1.25;
  const ForecastStudy study{.encounters = {{.family = "a", .samples = {one}}}, .notes = {}};
  const FigureGroup all = figures_of(study, 1).groups.at(0);
  const auto value = [&all](const char* figure, std::size_t time) {
    return line_of(all, MotionModel::law, figure, time).mean.value;
  };
  EXPECT_EQ(value("within_50_along", 1), 0.0);  // 0.25 to 0.75
  EXPECT_EQ(value("within_90_along", 1), 1.0);  // 0.05 to 0.95
  EXPECT_EQ(value("within_50_across", 1), 0.0);
  EXPECT_EQ(value("within_90_across", 1), 0.0);
  EXPECT_EQ(value("within_50_across", 0), 1.0);
  EXPECT_EQ(value("miss_of_6", 1), 2.5);
  EXPECT_EQ(value("missed", 1), 1.0);
  EXPECT_EQ(value("missed", 0), 0.0);
  EXPECT_EQ(value("mean_miss_of_6", 0), 1.5);
  EXPECT_EQ(value("mean_miss_of_12", 0), 1.25);
}

TEST(ForecastFigures, OfNothingAreNone) {
  const StudyFigures figures = figures_of({}, 1);
  EXPECT_EQ(figures.num_encounters, 0U);
  EXPECT_EQ(figures.groups.size(), 3U) << "there is no family";
  EXPECT_EQ(figures.groups[0].lines.at(0).mean.n, 0);
}

TEST(StudyProblems, AreThoseThatThereAre) {
  EXPECT_THAT(problems_of(two_encounters()), testing::ElementsAre("cannot be drawn"));
}

}  // namespace
}  // namespace saca::forecast_study::forecast_figures_test
