#include "saca/memory/sqlite.h"

namespace saca::memory {

Error sqlite_problem(sqlite3* database, const std::string& name, Access access) {
  const std::string what = access == Access::read ? "cannot be read" : "cannot be written";
  const std::string why = sqlite3_errmsg(database);
  switch (sqlite3_errcode(database) & 0xff) {
    case SQLITE_NOTADB:
      return {Error::Code::malformed, name + ": want a memory bank (SQLite 3), got something else"};
    case SQLITE_CORRUPT:
    case SQLITE_ERROR:  // such as a missing column
      return {Error::Code::malformed, name + ": is damaged: " + why};
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
