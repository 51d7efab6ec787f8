#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/eval/traffic_drives.h"
#include "saca/lab/forecast_study/encounter_forecasts.h"
#include "saca/lab/suites/played_encounter.h"

namespace saca::forecast_study {

/// Recorded traffic in which the ego takes the place of a recorded car. Of each site it believes,
/// and others predict, by weights that have not seen it (models/intent/without_SITE.safetensors,
/// models/places likewise).
struct TrafficStudy {
  std::vector<std::filesystem::path> folders;  ///< with CommonRoad files, at least one
  std::size_t most = 1;                        ///< drives of each site, >= 1
  std::filesystem::path models;                ///< the folder models/
  const manoeuvre::Car* car = nullptr;         ///< outlives the study
  const collision::HarmModel* harm = nullptr;  ///< likewise
  suites::PlayOptions play;
  int threads = 1;  ///< they do not change the result
};

/// Plays all drives, until an interrupt.
/// @return  as eval::traffic_drives; an error where there are no weights that have not seen a site
[[nodiscard]] Result<ForecastStudy> traffic_forecasts(const TrafficStudy& study);

/// Drives of one group have road users in common: they count as one encounter. Those without
/// samples are left out, and told of in the notes.
/// @param found   the drives, and what was passed over
/// @param drives  one for each of `found.drives`
[[nodiscard]] ForecastStudy by_group(const eval::FoundDrives& found,
                                     std::vector<EncounterForecasts> drives);

}  // namespace saca::forecast_study
