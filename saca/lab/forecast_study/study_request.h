#pragma once

#include <cstdint>
#include <string>

#include "saca/lab/forecast_study/forecast_figures.h"
#include "saca/lab/installation/installation.h"
#include "saca/lab/suites/suite_request.h"

namespace saca::forecast_study {

/// What asks for the same figures again, without the program's name.
[[nodiscard]] std::string command_text(const suites::SuiteRequest& request);

/// Plays the encounters that a request names, until an interrupt that is watched for, and holds
/// what is forecast in them against what happens. Nothing is decided in them.
/// @param request  "traffic": others around recorded cars, of the folders of its `data`
[[nodiscard]] Result<ForecastStudy> study_of(const installation::Installation& here,
                                             const suites::SuiteRequest& request);

/// One road user at one instant of an encounter.
struct FanRequest {
  suites::SuiteRequest from;  ///< its count follows from the encounter
  std::uint64_t encounter = 0;
  std::string who;  ///< "car1"
  double at = 0.0;  ///< [s]
};

/// What is forecast of it then, and what happened, as SVG.
/// @return  an error where there is no such encounter, road user or instant
[[nodiscard]] Result<std::string> picture_of(const installation::Installation& here,
                                             const FanRequest& request);

}  // namespace saca::forecast_study
