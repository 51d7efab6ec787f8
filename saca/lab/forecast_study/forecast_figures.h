#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saca/lab/eval/forecast_score.h"
#include "saca/lab/eval/suite_figures.h"
#include "saca/lab/forecast_study/encounter_forecasts.h"

namespace saca::forecast_study {

/// A figure of forecasts. Of an encounter it is the mean over its samples.
struct ForecastFigure {
  const char* name;   ///< in documents
  const char* title;  ///< for people, with its unit
  bool each_time;     ///< for each of eval::forecast_times; false: over all of them
  double (*value)(const eval::ForecastSample& sample, std::size_t model, std::size_t time);
};

/// All of them; the likelihood is the first.
[[nodiscard]] std::span<const ForecastFigure> forecast_figures();

/// One figure of one model at one time.
struct FigureLine {
  eval::MotionModel model{};
  std::size_t figure = 0;  ///< index into forecast_figures
  std::size_t time = 0;    ///< index into eval::forecast_times; 0 where the figure is over all
  eval::Estimate mean;     ///< over encounters
  std::optional<eval::Estimate> above_shipped;  ///< paired; of the likelihood of the other models
};

/// The figures of some road users.
struct FigureGroup {
  std::string name;  ///< "all", "acting", "aside", FAMILY_acting
  std::vector<FigureLine>
      lines;  ///< by figure, then time, then in the order of eval::motion_models
};

/// What a study came to.
struct StudyFigures {
  std::size_t num_encounters = 0;
  int num_failed = 0;             ///< encounters with a problem
  std::size_t num_forecasts = 0;  ///< samples
  std::size_t num_acting = 0;     ///< of them, of road users that act
  std::vector<FigureGroup> groups;
};

/// Of all road users, of those that act, of those who move aside, and of each family of those that
/// act the likelihood.
/// @param seed  of the intervals (eval::mean_over_encounters)
[[nodiscard]] StudyFigures figures_of(const ForecastStudy& study, std::uint64_t seed);

/// What is wrong with encounters, in their order.
[[nodiscard]] std::vector<std::string> problems_of(const ForecastStudy& study);

}  // namespace saca::forecast_study
