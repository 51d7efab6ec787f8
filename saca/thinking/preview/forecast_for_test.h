#pragma once

// What forecasts of the small atlas' car are made with, for the tests of this module.

#include "saca/lab/prepare/harm_file.h"
#include "saca/onboard/atlas/atlas_for_test.h"
#include "saca/onboard/collision/harm.h"
#include "saca/thinking/preview/forecast_facts.h"

namespace saca::preview {

inline const collision::HarmModel& shipped_harm() {
  static const collision::HarmModel harm = prepare::read_harm("data/harm.toml").value();
  return harm;
}

inline ForecastTools rolling() {
  return {.car = &atlas::small_atlas_car(), .harm = &shipped_harm()};
}

inline ForecastTools reading() {
  return {
      .car = &atlas::small_atlas_car(), .harm = &shipped_harm(), .atlas = &atlas::small_atlas()};
}

}  // namespace saca::preview
