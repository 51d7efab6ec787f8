#include "saca/lab/forecast_study/suite_forecasts.h"

#include <utility>

#include "saca/base/core/parallel.h"
#include "saca/lab/eval/forecast_score.h"
#include "saca/lab/long_work/interrupt.h"

namespace saca::forecast_study {
namespace {

EncounterForecasts forecasts_in(const SuiteStudy& study, std::uint64_t number) {
  EncounterForecasts one;
  const auto played = suites::played_encounter(study.at, study.play, number);
  if (!played.has_value()) {
    one.problem = played.error().message;
    return one;
  }
  one.family = played.value().family;
  return with_samples(std::move(one), eval::forecast_samples(
                                          played.value().stage(study.perceiver),
                                          {.mixture = study.mixture,
                                           .seed = eval::encounter_seed(study.play.seed, number)}));
}

}  // namespace

Result<eval::MixtureModel> read_places_model(const std::filesystem::path& models,
                                             const std::string& name) {
  return eval::MixtureModel::read(models / "places" / (name + ".safetensors"));
}

ForecastStudy suite_forecasts(const SuiteStudy& study) {
  ForecastStudy all{.encounters = std::vector<EncounterForecasts>(study.count), .notes = {}};
  in_parallel(study.count, study.threads, [&](std::size_t i) {
    if (!long_work::interrupted()) {
      all.encounters[i] = forecasts_in(study, i);
    }
  });
  return all;
}

}  // namespace saca::forecast_study
