#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/parallel.h"
#include "saca/lab/cases/case_making.h"
#include "saca/lab/cases/case_set.h"
#include "saca/lab/cases/case_tally.h"
#include "saca/lab/vehicle_study/car_planes.h"

namespace saca::cases {

/// Which records cases are made of, and how (`saca cases build`).
struct CaseBuildRequest {
  std::vector<std::string> folders;  ///< releases of FARS
  std::string hundred_car;           ///< folder of the study's release; empty: without
  std::optional<int> count;          ///< at most so many crashes; nullopt: all
  std::string car = "compact_rwd_ev";
  CaseMakingOptions making;
  CaseOutputs outputs{.cases = "runs/crash_cases.jsonl", .memory = "", .drivers = ""};
  std::string journal;  ///< empty: beside the cases
  int threads = usual_threads();
};

/// What asks for the same again, without the program's name.
[[nodiscard]] std::string command_text(const CaseBuildRequest& request);

/// What came of it.
struct CaseBuild {
  CaseSources sources;
  FamilyTallies tallies;
  CaseSet set;
};
/// Opens what the request names and makes cases of it, with progress on the error stream, from
/// where the journal ends on.
/// @return  nullopt: interrupted
[[nodiscard]] Result<std::optional<CaseBuild>> build_cases(const installation::Installation& here,
                                                           const CaseBuildRequest& request);

/// What cases are played with there; the planes outlive it.
[[nodiscard]] CaseTools tools_of(const vehicle_study::PlanesOfCar& planes);

}  // namespace saca::cases
