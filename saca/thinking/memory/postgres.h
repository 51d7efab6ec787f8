#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/thinking/memory/case_row.h"

struct pg_conn;  // of libpq, as is the next
struct pg_result;

namespace saca::memory {

// A thin skin over libpq, PostgreSQL's C library, for this module only: nothing here waits without
// a bound, and a statement is sent at most once.

/// "postgresql://..." or "postgres://...", as libpq takes them.
[[nodiscard]] bool is_postgres_url(std::string_view place) noexcept;

/// The same without password: what may be printed. Of what cannot be read, a text that quotes
/// nothing of it.
[[nodiscard]] std::string printable_url(const std::string& url);

/// What a statement returned.
class Rows {
 public:
  Rows() = default;
  explicit Rows(pg_result* result) : result_(result) {}

  [[nodiscard]] int size() const;
  /// By the column's type: integers, doubles, all else as text.
  [[nodiscard]] Cell cell(int row, int column) const;
  /// 0 where the cell is no integer.
  [[nodiscard]] std::int64_t integer(int row, int column) const;
  /// How many rows were changed.
  [[nodiscard]] std::int64_t changed() const;

 private:
  struct Clear {
    void operator()(pg_result* result) const;
  };
  std::unique_ptr<pg_result, Clear> result_;
};

/// Why a statement brought no rows.
struct PostgresFailure {
  enum class Kind : std::uint8_t {
    refused,  ///< the server says no; the connection goes on
    late,     ///< no answer in time; the connection is given up
    lost,     ///< the connection broke, or there was none
  };
  Kind kind = Kind::lost;
  std::string state;  ///< SQLSTATE; empty unless refused
  std::string why;    ///< one line
};

/// One connection to a server. One thread at a time. Movable, not copyable.
class PostgresConnection {
 public:
  using Time = std::chrono::steady_clock::time_point;

  explicit PostgresConnection(std::string url) : url_(std::move(url)) {}

  [[nodiscard]] bool is_open() const;
  void close() { connection_.reset(); }

  /// Connects, once. A name is looked up without a bound (the system's resolver).
  /// @return  nullopt: it is open
  [[nodiscard]] std::optional<PostgresFailure> open(Time until);

  /// Runs one statement.
  /// @param values  of $1, $2, ...; nothing: NULL
  /// @param rows    filled, unless it fails
  [[nodiscard]] std::optional<PostgresFailure> run(const std::string& sql,
                                                   std::span<const Cell> values, Time until,
                                                   Rows& rows);

 private:
  struct Finish {
    void operator()(pg_conn* connection) const;
  };

  [[nodiscard]] std::optional<PostgresFailure> lost();
  [[nodiscard]] std::optional<PostgresFailure> late();
  [[nodiscard]] std::optional<PostgresFailure> send(const std::string& sql,
                                                    std::span<const Cell> values, Time until);

  std::string url_;
  std::unique_ptr<pg_conn, Finish> connection_;
};

}  // namespace saca::memory
