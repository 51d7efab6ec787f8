#pragma once

#include <filesystem>
#include <optional>

#include "saca/base/core/result.h"
#include "saca/lab/recordings/recorded_set.h"

namespace saca::recordings {

/// Puts a set into an HDF5 file of format saca.traffic/1 (docs/formats.md), in one step: readers
/// see the old file or the whole new one. The same set makes the same bytes. Places are kept in 64
/// bits, all other numbers of samples in 32.
///
/// @return  nullopt when it is on the disk, else the reason
/// @throws ContractViolation  if the set breaks a rule (recorded_set.h)
[[nodiscard]] std::optional<Error> write_set(const std::filesystem::path& path,
                                             const RecordedSet& set);

/// Reads it back. Damage of any kind is found by a check sum before HDF5 sees the file; all that
/// the file says is checked all the same.
///
/// @return  unreadable, or malformed: one line with the file, the part, what was wanted, what came
[[nodiscard]] Result<RecordedSet> read_set(const std::filesystem::path& path);

}  // namespace saca::recordings
