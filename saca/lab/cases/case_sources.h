#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/crash_records/fars.h"
#include "saca/lab/crash_records/fars_codes.h"
#include "saca/lab/crash_records/roles.h"
#include "saca/lab/families/family.h"
#include "saca/lab/importers/hundred_car_release.h"

namespace saca::cases {

/// A crash of which an encounter may be made.
struct CrashProspect {
  std::size_t crash = 0;  ///< index into the release
  crash_records::Roles roles;
  families::Family family;
};

/// How many crashes of one family there are, and why no encounter is made of some.
struct CrashCount {
  int crashes = 0;
  int ego_is_no_car = 0;
  int other_unknown = 0;
  int not_playable = 0;  ///< what the record says of speeds
};

/// All that cases are made of.
struct CaseSources {
  crash_records::FarsRelease release;
  crash_records::FarsCodes codes;
  std::vector<CrashProspect> prospects;  ///< in the order in which they are worked on
  std::array<CrashCount, crash_records::num_crash_families> counts;  ///< by CrashFamily
  std::vector<importers::HundredCarOutcome> events;  ///< of the 100-Car study that were rebuilt
};

/// Reads releases of FARS, and of the 100-Car study.
///
/// @param root         holds the program's own data/ and scenarios/
/// @param folders      of FARS, one release each
/// @param hundred_car  empty: without
/// @param count        at most so many crashes, of the families in turn; nullopt: all
[[nodiscard]] Result<CaseSources> open_case_sources(const std::filesystem::path& root,
                                                    const std::vector<std::string>& folders,
                                                    const std::string& hundred_car,
                                                    const std::optional<int>& count);

}  // namespace saca::cases
