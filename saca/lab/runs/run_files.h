#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/encounter/encounter.h"

namespace saca::runs {

/// What a run leaves; an empty name: it does not.
struct RunFiles {
  std::filesystem::path record;  ///< JSON, schema saca.record/1
  std::filesystem::path report;  ///< HTML, made of the record
  std::filesystem::path trace;   ///< motions: .csv, else a line of JSON each
  std::filesystem::path tape;    ///< what was decided by, for `saca replay`
};

/// What came of a run.
struct PlayedRun {
  const encounter::Setup& setup;
  const encounter::Record& record;
  const std::string& record_text;  ///< encounter::record_json
  std::string program;             ///< version, for the tape
};

/// Writes all that is wanted, in the order above, until something cannot be written.
/// @return  nullopt when it is there
[[nodiscard]] std::optional<Error> write_run(const RunFiles& files, const PlayedRun& run);

/// What came, what was weighed and why this was done, in sentences; none where the record does not
/// tell.
/// @param record_text  encounter::record_json
[[nodiscard]] std::vector<std::string> in_short(const std::string& record_text);

}  // namespace saca::runs
