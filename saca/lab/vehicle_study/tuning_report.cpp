#include "saca/lab/vehicle_study/tuning_report.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "saca/lab/prepare/tuning_file.h"

namespace saca::vehicle_study {

std::string tuning_file_of(const TunedCar& tuned) {
  return prepare::tuning_text(
      tuned.tuning,
      fmt::format(
          "Made by: {}\nCosts: lane change {:.4f}, T-drift {:.4f} (saca/lab/tune/trials.h).",
          tuned.command, tuned.costs.swerve, tuned.costs.drift));
}

nlohmann::json json_of(const TunedCar& tuned) {
  return {{"schema", "saca.tune/1"},
          {"output", tuned.output},
          {"swerve_cost", tuned.costs.swerve},
          {"drift_cost", tuned.costs.drift},
          {"drift_grip", manoeuvre::DriftDomain::grips},
          {"drift_slowest_mps", tuned.tuning.domain.slowest},
          {"drift_fastest_mps", tuned.tuning.domain.fastest}};
}

std::string text_of(const TunedCar& tuned) {
  return fmt::format("{}: lane change {:.4f}, T-drift {:.4f}\n", tuned.output, tuned.costs.swerve,
                     tuned.costs.drift);
}

}  // namespace saca::vehicle_study
