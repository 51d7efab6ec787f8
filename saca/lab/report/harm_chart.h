#pragma once

#include <string>
#include <vector>

#include "saca/onboard/collision/harm.h"

namespace saca::report {

/// What a risk is told over.
enum class HarmOver { delta_v, closing_speed };

/// A risk of one person, as decisions use it.
struct HarmRisk {
  std::string key;     ///< of JSON: "occupant_side_severe"
  std::string name;    ///< in words
  std::string source;  ///< where the curve comes from
  HarmOver over = HarmOver::delta_v;
  std::vector<double> values;  ///< (one per speed)
};

/// Probabilities that are due to the impact: occupants MAIS 3+ by the face struck; people outside
/// vehicles MAIS 3+ and killed.
/// @param speeds  [m/s], >= 0
[[nodiscard]] std::vector<HarmRisk> injury_risks(const collision::HarmModel& model,
                                                 const std::vector<double>& speeds);

/// Weighted harm of one person.
[[nodiscard]] std::vector<HarmRisk> person_harms(const collision::HarmModel& model,
                                                 const std::vector<double>& speeds);

/// All of them as charts up to 100 km/h.
[[nodiscard]] std::string harm_svg(const collision::HarmModel& model);

}  // namespace saca::report
