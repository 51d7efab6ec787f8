#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "saca/base/core/result.h"
#include "saca/lab/levelset/solve.h"
#include "saca/lab/long_work/progress.h"
#include "saca/thinking/danger/value_file.h"

namespace saca::reach_study {

/// A case that is to be solved into a file.
struct CaseTask {
  std::string name;              ///< of progress and messages
  std::filesystem::path output;  ///< HDF5; until it is complete, OUTPUT.part
  levelset::Scheme scheme;
  std::optional<double> memory_mib;  ///< it may take at most; nullopt: what the machine can spare
  long_work::ProgressDisplay display = long_work::ProgressDisplay::shown;
};

struct SolvedCase {
  danger::Solution solution;
  double seconds = 0.0;  ///< that this took, without what was there before
};

/// Why the problem takes more memory than it may.
/// @return  Error::Code::out_of_range, naming what is needed and what there is [MiB]; nullopt: it
///          does not, or nobody knows
[[nodiscard]] std::optional<Error> why_too_large(const levelset::Problem& problem,
                                                 const CaseTask& task);

/// Solves it and keeps it, with progress on the error stream; goes on from what an earlier, stopped
/// call left in OUTPUT.part. SIGINT and SIGTERM stop it from when it begins to solve.
/// @return  Error::Code::too_late when stopped; out_of_range, as why_too_large; malformed or
///          unreadable: what was begun cannot be gone on with; unwritable: the output, or its part
[[nodiscard]] Result<SolvedCase> solve_case(const levelset::Problem& problem, const CaseTask& task);

}  // namespace saca::reach_study
