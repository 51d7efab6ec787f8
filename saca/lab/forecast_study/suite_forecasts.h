#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "saca/base/core/result.h"
#include "saca/lab/eval/mixture_lstm.h"
#include "saca/lab/forecast_study/encounter_forecasts.h"
#include "saca/lab/suites/played_encounter.h"

namespace saca::forecast_study {

/// What was learnt of where vehicles go: models/places/NAME.safetensors.
/// @param models  the folder models/
[[nodiscard]] Result<eval::MixtureModel> read_places_model(const std::filesystem::path& models,
                                                           const std::string& name);

/// Encounters of a suite, and how they are played.
struct SuiteStudy {
  suites::EncounterAt at;  ///< asked from several threads
  std::size_t count = 0;
  suites::Perceiver perceiver;
  const eval::MixtureModel* mixture = nullptr;  ///< outlives the study
  suites::PlayOptions play;
  int threads = 1;  ///< they do not change the result
};

/// Plays them all, until an interrupt: of those that it spared there is nothing.
[[nodiscard]] ForecastStudy suite_forecasts(const SuiteStudy& study);

}  // namespace saca::forecast_study
