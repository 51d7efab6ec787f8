#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "saca/lab/vehicle_study/car_tuning.h"

namespace saca::vehicle_study {

/// A car whose tuning was found.
struct TunedCar {
  std::string command;  ///< the line that made it
  std::string output;   ///< file of the tuning
  manoeuvre::Tuning tuning;
  LawCosts costs;
};

/// The text of the tuning's file: how it was found, and all digits of every number
/// (prepare::tuning_text).
[[nodiscard]] std::string tuning_file_of(const TunedCar& tuned);

/// The document of `saca tune --json`, schema saca.tune/1: docs/formats.md.
[[nodiscard]] nlohmann::json json_of(const TunedCar& tuned);
/// The same for people: one line.
[[nodiscard]] std::string text_of(const TunedCar& tuned);

}  // namespace saca::vehicle_study
