#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "apps/saca/inputs.h"
#include "apps/saca/suite_running.h"

namespace saca::app {

/// Where encounters come from: families of a suite, or files of a folder.
struct SuiteEncounters {
  Inputs inputs;                   ///< until planes are made of them
  std::string what;                ///< names all on which the encounters depend
  int count = 0;                   ///< as many as were asked for and there are
  std::vector<std::string> notes;  ///< on where they come from
  std::function<Result<eval::SuiteEncounter>(std::uint64_t number)> at;
};

/// Opens what the options name.
/// @param command  that asks, for the log of the test split
[[nodiscard]] Result<SuiteEncounters> open_encounters(const SuiteCommandOptions& options,
                                                      const std::string& command);

}  // namespace saca::app
