#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "saca/lab/family_samples/sample_sheet.h"
#include "saca/lab/installation/inputs.h"

namespace saca::family_samples {

/// Which encounters of a family are drawn (`saca family`).
struct FamilyRequest {
  std::string name;  ///< of a shipped family, or a file
  std::string car = "compact_rwd_ev";
  int count = 12;
  int first = 0;  ///< number of the first
  std::string split = "tuning";
  std::string test_log;
  std::string cues;  ///< a suite whose cues they have; empty: they have none
  bool twins = false;
};

/// What was drawn.
struct DrawnFamily {
  std::string name;  ///< of the family
  std::uint64_t seed = 0;
  std::vector<scenario::Scenario> scenarios;
  report::ContactSheet sheet;  ///< their pictures
};

/// @return  an error where the family, its suite of cues or the split's log cannot be used
[[nodiscard]] Result<DrawnFamily> drawn_family(const installation::Installation& here,
                                               const FamilyRequest& request);

}  // namespace saca::family_samples
