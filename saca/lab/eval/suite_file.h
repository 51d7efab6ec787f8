#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/eval/suite.h"

namespace saca::eval {

/// All rows of a suite as one HDF5 file, schema saca.suite/1 of docs/formats.md: one column for
/// each number, for analyses of one's own. What is not there is NaN.
/// @param about  what was run, as `--json` says it; kept as the text `about`
/// @return       nullopt when it is on the disk, else the reason
[[nodiscard]] std::optional<Error> write_suite(const std::filesystem::path& path,
                                               std::span<const SuiteRow> rows,
                                               const std::vector<std::string>& methods,
                                               const std::string& about);

}  // namespace saca::eval
