#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "saca/lab/banks/case_build.h"
#include "saca/lab/suites/suite_request.h"
#include "saca/lab/vehicle_study/car_planes.h"

namespace saca::banks {

/// Of which encounters cases are made, and how (`saca memory build`).
struct SuiteCasesRequest {
  suites::SuiteRequest from;  ///< nobody acts in them
  std::size_t draws = 64;     ///< that expected harm is the mean of
  bool no_twins = false;
};

/// What asks for the same again, without the program's name.
[[nodiscard]] std::string command_text(const SuiteCasesRequest& request);

/// What cases are worked out with there; the planes outlive it.
[[nodiscard]] CaseTools case_tools(const vehicle_study::PlanesOfCar& planes, std::size_t draws);

/// Opens what the request names, and makes cases of it (build_cases).
/// @return  nullopt: interrupted
[[nodiscard]] Result<std::optional<CaseBuild>> suite_cases(const installation::Installation& here,
                                                           const SuiteCasesRequest& request);

}  // namespace saca::banks
