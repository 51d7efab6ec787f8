#pragma once

// What forecasts of the small atlas' car are made with, for the tests of this module.

#include "saca/manoeuvre/atlas_for_test.h"
#include "saca/outcome/harm.h"
#include "saca/preview/policy_facts.h"

namespace saca::preview {

inline const outcome::HarmModel& shipped_harm() {
  static const outcome::HarmModel harm = outcome::read_harm("data/harm.toml").value();
  return harm;
}

inline ForecastTools rolling() {
  return {.car = &manoeuvre::small_atlas_car(), .harm = &shipped_harm()};
}

inline ForecastTools reading() {
  return {.car = &manoeuvre::small_atlas_car(),
          .harm = &shipped_harm(),
          .atlas = &manoeuvre::small_atlas()};
}

}  // namespace saca::preview
