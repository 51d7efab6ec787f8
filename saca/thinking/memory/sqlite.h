#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <memory>
#include <string>

#include "saca/base/core/result.h"
#include "saca/thinking/memory/case_table.h"

namespace saca::memory {

// A thin skin over SQLite, for this module only.

struct Close {
  void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Database = std::unique_ptr<sqlite3, Close>;

/// Steps of SQLite's machine after which a statement is given up: ten million cases take fewer, and
/// seconds.
constexpr int most_work = 200'000'000;

/// A connection for a file that somebody else may have made: its views and triggers are not run,
/// its schema cannot be written past SQL, and no value is longer than 16 MiB.
void be_wary(sqlite3* database);

/// One prepared SQL statement, the only one of its connection that is stepped while it lives. A
/// failure shows in `step`, also one for too much work.
class Statement {
 public:
  /// @param most  steps of work, > 0
  Statement(sqlite3* database, const char* sql, int most = most_work) : database_(database) {
    sqlite3_stmt* statement = nullptr;
    problem_ = sqlite3_prepare_v2(database, sql, -1, &statement, nullptr);
    statement_.reset(statement);
    sqlite3_progress_handler(
        database, most, [](void* /*nothing*/) { return 1; }, nullptr);
  }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;
  ~Statement() { sqlite3_progress_handler(database_, 0, nullptr, nullptr); }

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

  sqlite3* database_;
  std::unique_ptr<sqlite3_stmt, Close> statement_;
  int problem_ = SQLITE_OK;
};

/// The connection's last problem, with the file's name as its user knows it.
[[nodiscard]] Error sqlite_problem(sqlite3* database, const std::string& name, Access access);

}  // namespace saca::memory
