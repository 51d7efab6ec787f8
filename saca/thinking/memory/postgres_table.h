#pragma once

#include <memory>
#include <string>

#include "saca/base/core/result.h"
#include "saca/thinking/memory/case_table.h"

namespace saca::memory {

enum class IfMissing : std::uint8_t { refuse, make };

/// A bank in two tables of a PostgreSQL server (docs/formats.md), which any number of processes may
/// have open. What a server may only give, such as a replica, is read; nothing is then written.
///
/// Where the connection breaks, the next operation connects again, as long as it may wait. A
/// transaction that broke is done again; where it broke at its end, the server is asked whether it
/// happened, so that nothing is written twice or lost.
/// @param url  "postgresql://USER@HOST:PORT/DATABASE?...", as libpq takes it: also certificates and
///             how far the server is to prove who it is (sslmode)
/// @return     unreadable when there is no connection, or no bank and none is to be made; malformed
///             when the tables are no memory bank or of another version
[[nodiscard]] Result<std::unique_ptr<CaseTable>> open_postgres(const std::string& url,
                                                               IfMissing missing);

}  // namespace saca::memory
