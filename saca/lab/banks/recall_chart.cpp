#include "saca/lab/banks/recall_chart.h"

#include <fmt/core.h>

#include <filesystem>
#include <vector>

#include "saca/lab/eval/transfer.h"
#include "saca/lab/report/chart_svg.h"

namespace saca::banks {
namespace {

/// The curves of the chart, without points.
struct RecallCurves {
  report::ChartLine truth{.name = "as good as the best, in truth",
                          .note = "with the exact 95 % interval",
                          .colour = report::ChartColour::blue,
                          .points = {}};
  report::ChartLine as_told{
      .name = "by what was expected there", .colour = report::ChartColour::orange, .points = {}};
  report::ChartLine braking{.name = "braking is as good as the best",
                            .colour = report::ChartColour::grey,
                            .dashed = true,
                            .points = {}};
};

RecallCurves curves_of(const std::vector<eval::Transfer>& all) {
  constexpr int bins = 10;
  RecallCurves curves;
  for (int k = 0; k < bins; ++k) {
    const double from = static_cast<double>(k) / bins;
    const double to = static_cast<double>(k + 1) / bins;
    const eval::TransferFigures figures = eval::transfer_figures(all, from, to);
    if (figures.in_truth.of == 0) {
      continue;
    }
    const double middle = 0.5 * (from + to);
    const eval::ShareInterval interval = eval::interval_of(figures.in_truth);
    curves.truth.points.push_back({middle, 100.0 * figures.in_truth.value()});
    curves.truth.low.push_back(100.0 * interval.low);
    curves.truth.high.push_back(100.0 * interval.high);
    curves.as_told.points.push_back({middle, 100.0 * figures.as_told.value()});
    curves.braking.points.push_back({middle, 100.0 * figures.braking.value()});
  }
  return curves;
}

}  // namespace

std::string recall_chart(const RecallCalibration& calibration) {
  const std::vector<eval::Transfer>& drawn =
      calibration.checks ? *calibration.checks : calibration.within;
  const std::string name = calibration.checks
                               ? calibration.check_files
                               : std::filesystem::path(calibration.file).filename().string();
  const RecallCurves curves = curves_of(drawn);
  return report::chart_svg(
      {.heading = "How often what is recalled holds",
       .lines = {fmt::format("{}: {} scenes in which the choice matters", name, drawn.size())},
       .charts = {{.title = "",
                   .x = {.name = "confidence", .low = 0.0, .high = 1.0},
                   .y = {.name = "share", .unit = "%", .low = 0.0, .high = 100.0},
                   .curves = {curves.truth, curves.as_told, curves.braking}}}});
}

}  // namespace saca::banks
