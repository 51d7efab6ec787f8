#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "saca/base/core/result.h"
#include "saca/thinking/memory/case_table.h"

namespace saca::memory {

/// A bank in one SQLite file, which several processes may have open. One that is not there is made;
/// one of an older version is brought to the newest. A file that may only be read is opened for
/// reading: nothing is then written, and an older version is read as it is.
/// @return  unreadable when it cannot be opened; malformed when it is damaged, is no memory bank or
///          has another version
[[nodiscard]] Result<std::unique_ptr<CaseTable>> open_sqlite(const std::filesystem::path& path);

/// A copy in memory, to be read only, of what a file holds now.
/// @return  unreadable when there is no such file; else as `open_sqlite`
[[nodiscard]] Result<std::unique_ptr<CaseTable>> copy_of_sqlite(const std::filesystem::path& path);

/// A copy in memory, to be read only, of what another bank holds now.
[[nodiscard]] Result<std::unique_ptr<CaseTable>> copy_of(CaseTable& other);

}  // namespace saca::memory
