#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <memory>
#include <string>

#include "saca/core/result.h"

namespace saca::memory {

// A thin skin over SQLite, for this module only.

/// How long another process may hold a file before an operation on it gives up [ms].
constexpr int usual_patience = 5'000;
/// Likewise where a decision waits for the answer: longer than another's commit takes.
constexpr int short_patience = 200;

struct Close {
  void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Database = std::unique_ptr<sqlite3, Close>;

/// One prepared SQL statement. A failure shows in `step`.
class Statement {
 public:
  Statement(sqlite3* database, const char* sql) {
    sqlite3_stmt* statement = nullptr;
    problem_ = sqlite3_prepare_v2(database, sql, -1, &statement, nullptr);
    statement_.reset(statement);
  }

  Statement& bind(int parameter, std::int64_t value) {
    return note(sqlite3_bind_int64(statement_.get(), parameter, value));
  }
  Statement& bind(int parameter, double value) {
    return note(sqlite3_bind_double(statement_.get(), parameter, value));
  }
  /// The text must live until the statement is done.
  Statement& bind(int parameter, const std::string& text) {
    return note(sqlite3_bind_text64(statement_.get(), parameter, text.data(), text.size(),
                                    SQLITE_STATIC, SQLITE_UTF8));
  }

  /// @return  SQLITE_ROW, SQLITE_DONE or an error
  int step() { return problem_ != SQLITE_OK ? problem_ : sqlite3_step(statement_.get()); }

  [[nodiscard]] int type(int column) const { return sqlite3_column_type(statement_.get(), column); }
  [[nodiscard]] std::int64_t integer(int column) const {
    return sqlite3_column_int64(statement_.get(), column);
  }
  [[nodiscard]] double number(int column) const {
    return sqlite3_column_double(statement_.get(), column);
  }
  [[nodiscard]] std::string text(int column) const {
    const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement_.get(), column));
    const int size = sqlite3_column_bytes(statement_.get(), column);
    return bytes == nullptr ? "" : std::string(bytes, static_cast<std::size_t>(size));
  }
  [[nodiscard]] std::string name(int column) const {
    return sqlite3_column_name(statement_.get(), column);
  }

 private:
  Statement& note(int code) {
    problem_ = problem_ == SQLITE_OK ? code : problem_;
    return *this;
  }

  std::unique_ptr<sqlite3_stmt, Close> statement_;
  int problem_ = SQLITE_OK;
};

enum class Access : std::uint8_t { read, write };

/// The connection's last problem, with the file's name as its user knows it.
[[nodiscard]] Error sqlite_problem(sqlite3* database, const std::string& name, Access access);

}  // namespace saca::memory
