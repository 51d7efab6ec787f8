#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/proportion.h"
#include "saca/lab/installation/installation.h"
#include "saca/onboard/manoeuvre/car.h"

namespace saca::vehicle_study {

/// How each T-drift of a table is repeated.
struct DriftDraws {
  int count = 0;  ///< of each, > 0
  std::uint64_t seed = 1;
  int threads = 1;  ///< they do not change the result
};

/// 5 %, 50 % and 95 % of the draws are below.
struct DriftSpread {
  double p05 = 0.0;
  double p50 = 0.0;
  double p95 = 0.0;
};

/// Where the draws of one T-drift end.
struct DriftEndings {
  Proportion across;     ///< at rest within 10 deg of across the lane
  DriftSpread forward;   ///< along the lane [m]
  DriftSpread sideways;  ///< to the left [m]
};

/// One cell of the table: T-drifts to the left from one speed on one grip.
struct DriftCell {
  std::string car;                      ///< its name
  double speed = 0.0;                   ///< [m/s]
  double grip = 0.0;                    ///< friction coefficient [-]
  std::optional<DriftEndings> endings;  ///< nullopt: refused
};

/// T-drifts of one car over speed and grip, each many times.
/// @param done  told of each cell when it is done, row by row
void table_drifts(const std::string& name, const manoeuvre::Car& car, const DriftDraws& draws,
                  const std::function<void(const DriftCell& cell)>& done);

/// Adds the figures of a cell to those of `saca physics --json`: docs/formats.md.
void add_to(nlohmann::json& figures, const DriftCell& cell);

/// For people: the lines above the table, and the line of a cell.
[[nodiscard]] std::string drift_table_head(const DriftDraws& draws);
[[nodiscard]] std::string text_of(const DriftCell& cell);

/// The table of several cars, printed line by line as it grows, and added to the figures.
/// @param cars  files, or names of shipped ones
/// @param tell  takes lines
/// @return      a car that cannot be read
[[nodiscard]] std::optional<Error> add_drift_table(
    const installation::Installation& here, const std::vector<std::string>& cars,
    const DriftDraws& draws, nlohmann::json& figures,
    const std::function<void(const std::string& lines)>& tell);

}  // namespace saca::vehicle_study
