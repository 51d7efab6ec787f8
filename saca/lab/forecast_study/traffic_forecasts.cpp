#include "saca/lab/forecast_study/traffic_forecasts.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <utility>

#include "saca/base/core/parallel.h"
#include "saca/lab/forecast_study/suite_forecasts.h"
#include "saca/lab/long_work/interrupt.h"

namespace saca::forecast_study {
namespace {

/// Weights that have not seen a site.
struct ModelsWithout {
  intent::Model intent;
  eval::MixtureModel mixture;
};
using ModelsBySite = std::map<std::string, ModelsWithout>;  ///< by its name

Result<ModelsBySite> models_without(const std::vector<eval::TrafficDrive>& drives,
                                    const std::filesystem::path& folder) {
  ModelsBySite models;
  for (const eval::TrafficDrive& drive : drives) {
    if (models.contains(drive.site)) {
      continue;
    }
    const std::string name = "without_" + drive.site;
    auto intent = intent::read_model(folder / "intent" / (name + ".safetensors"));
    if (!intent.has_value()) {
      return intent.error();
    }
    auto mixture = read_places_model(folder, name);
    if (!mixture.has_value()) {
      return mixture.error();
    }
    models.emplace(drive.site,
                   ModelsWithout{std::move(intent).value(), std::move(mixture).value()});
  }
  return models;
}

/// What a drive tells with nothing left to chance but what perception gets wrong.
EncounterForecasts forecasts_of_drive(const TrafficStudy& study, const eval::TrafficDrive& drive,
                                      std::uint64_t number, const ModelsWithout& models) {
  EncounterForecasts one{.family = drive.site, .problem = {}, .samples = {}};
  const auto made = eval::played_drive(drive);
  if (!made.has_value()) {
    one.problem = made.error().message;
    return one;
  }
  const eval::SuiteOptions as_suite{
      .methods = {}, .seed = study.play.seed, .exact = study.play.exact};
  const scenario::Scenario world = eval::as_played(made.value().scenario, as_suite);
  const std::uint64_t seed = eval::encounter_seed(study.play.seed, number);
  const encounter::Stage stage{.scenario = &world,
                               .car = study.car,
                               .harm = study.harm,
                               .intent = &models.intent,
                               .thresholds = {},
                               .chance = {.perception = study.play.exact ? 0 : seed}};
  return with_samples(std::move(one),
                      eval::forecast_samples(stage, {.mixture = &models.mixture, .seed = seed},
                                             made.value().window));
}

}  // namespace

ForecastStudy by_group(const eval::FoundDrives& found, std::vector<EncounterForecasts> drives) {
  std::map<std::pair<std::string, std::string>, EncounterForecasts> groups;
  std::size_t num_left_out = 0;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    if (drives[i].samples.empty()) {
      ++num_left_out;
      continue;
    }
    EncounterForecasts& group = groups[{drives[i].family, found.drives[i].group}];
    group.family = drives[i].family;
    std::move(drives[i].samples.begin(), drives[i].samples.end(),
              std::back_inserter(group.samples));
  }
  ForecastStudy all;
  for (const auto& [reason, count] : found.skipped) {
    all.notes.push_back(fmt::format("Passed over: {} x {}.", count, reason));
  }
  for (auto& [key, group] : groups) {
    all.encounters.push_back(std::move(group));
  }
  all.notes.push_back(fmt::format(
      "{} drives in {} groups that share no road user; {} more gave nothing to hold a forecast "
      "against.",
      drives.size() - num_left_out, groups.size(), num_left_out));
  return all;
}

Result<ForecastStudy> traffic_forecasts(const TrafficStudy& study) {
  const auto found = eval::traffic_drives(study.folders, study.most, study.play.seed,
                                          [] { return !long_work::interrupted(); });
  if (!found.has_value()) {
    return found.error();
  }
  const std::vector<eval::TrafficDrive>& drives = found.value().drives;
  const auto models = models_without(drives, study.models);
  if (!models.has_value()) {
    return models.error();
  }
  std::vector<EncounterForecasts> all(drives.size());
  in_parallel(all.size(), study.threads, [&](std::size_t i) {
    if (!long_work::interrupted()) {
      all[i] = forecasts_of_drive(study, drives[i], i, models.value().at(drives[i].site));
    }
  });
  return by_group(found.value(), std::move(all));
}

}  // namespace saca::forecast_study
