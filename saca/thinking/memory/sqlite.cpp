#include "saca/thinking/memory/sqlite.h"

#include <utility>

#include "saca/base/core/printable.h"

namespace saca::memory {

void be_wary(sqlite3* database) {
  for (const auto& [option, value] :
       {std::pair{SQLITE_DBCONFIG_DEFENSIVE, 1}, std::pair{SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
        std::pair{SQLITE_DBCONFIG_ENABLE_TRIGGER, 0}, std::pair{SQLITE_DBCONFIG_ENABLE_VIEW, 0}}) {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): SQLite's interface
    sqlite3_db_config(database, option, value, nullptr);
  }
  constexpr int longest_value = 16 << 20;  // bytes; a case has some 20 KiB
  sqlite3_limit(database, SQLITE_LIMIT_LENGTH, longest_value);
}

Error sqlite_problem(sqlite3* database, const std::string& name, Access access) {
  const std::string what = access == Access::read ? "cannot be read" : "cannot be written";
  const std::string why = one_line(sqlite3_errmsg(database));
  switch (sqlite3_errcode(database) & 0xff) {
    case SQLITE_NOTADB:
      return {Error::Code::malformed, name + ": want a memory bank (SQLite 3), got something else"};
    case SQLITE_CORRUPT:
    case SQLITE_ERROR:  // such as a missing column
      return {Error::Code::malformed, name + ": is damaged: " + why};
    case SQLITE_INTERRUPT:
      return {Error::Code::malformed, name + ": want a memory bank, got what takes too much work"};
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return {Error::Code::too_late, name + ": " + what + ": another process holds it"};
    case SQLITE_READONLY:
    case SQLITE_FULL:
      return {Error::Code::unwritable, name + ": cannot be written: " + why};
    default:
      return {access == Access::read ? Error::Code::unreadable : Error::Code::unwritable,
              name + ": " + what + ": " + why};
  }
}

}  // namespace saca::memory
