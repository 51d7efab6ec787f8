#include "saca/lab/forecast_study/figures_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace saca::forecast_study::figures_report_test {
namespace {

using eval::MotionModel;
using testing::HasSubstr;

/// One group, with the likelihood at 0.5 s and the mean miss of six ways, all models alike.
StudyFigures two_figures() {
  StudyFigures figures{.num_encounters = 4,
                       .num_failed = 1,
                       .num_forecasts = 30,
                       .num_acting = 7,
                       .groups = {{.name = "acting", .lines = {}}}};
  for (const auto& [figure, value] : {std::pair<std::size_t, double>{0, 1.25}, {7, 0.5}}) {
    for (const MotionModel model : eval::motion_models) {
      figures.groups[0].lines.push_back(
          {.model = model, .figure = figure, .mean = {value, value - 0.25, value + 0.25, 3}});
    }
  }
  figures.groups[0].lines[0].above_shipped = eval::Estimate{0.125, 0.0, 0.25, 3};
  figures.groups[0].lines[1].mean.n = 0;  // constant_turn: nobody counts
  return figures;
}

TEST(StudyReport, NamesFiguresByGroupTimeAndModel) {
  const nlohmann::json out =
      json_of(two_figures(), {"some/folder", "saca forecast eval some/folder", 9, "1.2.3"});
  EXPECT_EQ(out.at("meta.command"), "saca forecast eval some/folder");
  EXPECT_EQ(out.at("meta.seed"), "9");
  EXPECT_EQ(out.at("meta.version"), "1.2.3");
  EXPECT_EQ(out.at("forecast.folder.num_encounters"), 4);
  EXPECT_EQ(out.at("forecast.folder.num_failed"), 1);
  EXPECT_EQ(out.at("forecast.folder.num_forecasts"), 30);
  EXPECT_EQ(out.at("forecast.folder.num_acting"), 7);
  const std::string nll = "forecast.folder.acting.nll.500ms.";
  EXPECT_EQ(out.at(nll + "constant_velocity"), 1.25);
  EXPECT_EQ(out.at(nll + "constant_velocity.lo"), 1.0);
  EXPECT_EQ(out.at(nll + "constant_velocity.hi"), 1.5);
  EXPECT_EQ(out.at(nll + "constant_velocity.n"), 3);
  EXPECT_EQ(out.at(nll + "constant_velocity.above_shipped"), 0.125);
  EXPECT_EQ(out.at(nll + "constant_velocity.above_shipped.n"), 3);
  EXPECT_FALSE(out.contains(nll + "constant_turn")) << "nobody counts";
  EXPECT_EQ(out.at("forecast.folder.acting.mean_miss_of_6.over_time.shipped"), 0.5);
}

TEST(StudyReport, IsATableForPeople) {
  const std::string text = text_of(two_figures(), "some/folder", {"Of two sites.", "One is wet."});
  EXPECT_THAT(text, testing::StartsWith(
                        "some/folder: 4 encounters, 30 forecasts, 7 of them of road users that "
                        "act\nOf two sites.\nOne is wet.\n\nacting                                "
                        " constant_velocity     constant_turn"));
  EXPECT_THAT(text, HasSubstr("\nnegative log likelihood          0.5 s             1.250"));
  EXPECT_THAT(text, HasSubstr("\nleast mean miss of 6 [m]                           0.500"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 7);
}

TEST(StudyReport, OfNothingIsOneLine) {
  EXPECT_EQ(text_of({}, "nothing", {}),
            "nothing: 0 encounters, 0 forecasts, 0 of them of road users that act\n");
}

}  // namespace
}  // namespace saca::forecast_study::figures_report_test
