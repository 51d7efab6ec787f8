#pragma once

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "saca/lab/cases/case_making.h"
#include "saca/lab/cases/case_set.h"
#include "saca/lab/cases/case_sources.h"

namespace saca::cases {

/// What became of one family's crashes.
struct FamilyTally {
  CrashCount count;
  int worked_on = 0;
  std::array<int, num_crash_ends> ends{};  ///< by CrashEnd
  int at_once = 0;                         ///< the crash happens in the first sample
  int cases = 0;
  int impact_known = 0;
  int impact_agrees = 0;
};

/// By the family's name; those without a crash, too.
using FamilyTallies = std::map<std::string, FamilyTally>;
[[nodiscard]] FamilyTallies family_tallies(const CaseSources& sources,
                                           const std::vector<CaseRow>& rows);

/// Figures of `saca cases build --json` (docs/formats.md), but for who made them.
[[nodiscard]] nlohmann::json tally_json(const CaseSources& sources, const FamilyTallies& tallies,
                                        const CaseSet& set);

/// The same as a table, after what was noted of the releases.
/// @param output  file of the cases
[[nodiscard]] std::string tally_text(const CaseSources& sources, const FamilyTallies& tallies,
                                     const CaseSet& set, const std::string& output);

}  // namespace saca::cases
