#include "saca/lab/forecast_study/figures_report.h"

#include <fmt/core.h>

#include <cstddef>
#include <filesystem>

#include "saca/lab/eval/estimate_text.h"

namespace saca::forecast_study {
namespace {

using eval::forecast_times;

std::string time_key(const FigureLine& line) {
  return forecast_figures()[line.figure].each_time
             ? fmt::format("{:.0f}ms", 1e3 * forecast_times[line.time])
             : "over_time";
}

/// @param place  "forecast.NAME.GROUP"
void add_lines(nlohmann::json& out, const std::string& place,
               const std::vector<FigureLine>& lines) {
  for (const FigureLine& line : lines) {
    const std::string key = fmt::format("{}.{}.{}.{}", place, forecast_figures()[line.figure].name,
                                        time_key(line), name(line.model));
    eval::add_estimate(out, key, line.mean);
    if (line.above_shipped) {
      eval::add_estimate(out, key + ".above_shipped", *line.above_shipped);
    }
  }
}

std::string group_text(const FigureGroup& group) {
  std::string text = fmt::format("\n{:28} {:>9}", group.name, "");
  for (const eval::MotionModel model : eval::motion_models) {
    text += fmt::format(" {:>17}", name(model));
  }
  text += '\n';
  const std::vector<FigureLine>& lines = group.lines;
  for (std::size_t i = 0; i < lines.size(); i += eval::motion_models.size()) {
    const ForecastFigure& figure = forecast_figures()[lines[i].figure];
    text +=
        fmt::format("{:28} {:>9}", figure.title,
                    figure.each_time ? fmt::format("{:g} s", forecast_times[lines[i].time]) : "");
    for (std::size_t m = 0; m < eval::motion_models.size(); ++m) {
      text += fmt::format(" {:17.3f}", lines[i + m].mean.value);
    }
    text += '\n';
  }
  return text;
}

}  // namespace

nlohmann::json json_of(const StudyFigures& figures, const StudyOrigin& origin) {
  const std::string place = "forecast." + std::filesystem::path(origin.name).filename().string();
  nlohmann::json out{{"meta.command", origin.command},
                     {"meta.seed", std::to_string(origin.seed)},
                     {"meta.version", origin.version},
                     {place + ".num_encounters", figures.num_encounters},
                     {place + ".num_failed", figures.num_failed},
                     {place + ".num_forecasts", figures.num_forecasts},
                     {place + ".num_acting", figures.num_acting}};
  for (const FigureGroup& group : figures.groups) {
    add_lines(out, place + "." + group.name, group.lines);
  }
  return out;
}

std::string text_of(const StudyFigures& figures, const std::string& name,
                    const std::vector<std::string>& notes) {
  std::string text =
      fmt::format("{}: {} encounters, {} forecasts, {} of them of road users that act\n", name,
                  figures.num_encounters, figures.num_forecasts, figures.num_acting);
  for (const std::string& note : notes) {
    text += note + "\n";
  }
  for (const FigureGroup& group : figures.groups) {
    text += group_text(group);
  }
  return text;
}

}  // namespace saca::forecast_study
