#pragma once

#include <string>
#include <utility>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/eval/forecast_score.h"

namespace saca::forecast_study {

/// Forecasts of one encounter held against what happened; of recorded traffic, of all drives that
/// share road users.
struct EncounterForecasts {
  std::string family;   ///< or the site
  std::string problem;  ///< why there are none; empty: nothing went wrong
  std::vector<eval::ForecastSample> samples;
};

/// With the samples, or why there are none.
[[nodiscard]] inline EncounterForecasts with_samples(
    EncounterForecasts one, Result<std::vector<eval::ForecastSample>> samples) {
  if (samples.has_value()) {
    one.samples = std::move(samples).value();
  } else {
    one.problem = samples.error().message;
  }
  return one;
}

/// Of all encounters.
struct ForecastStudy {
  std::vector<EncounterForecasts> encounters;
  std::vector<std::string> notes;  ///< on where they come from, in sentences
};

}  // namespace saca::forecast_study
