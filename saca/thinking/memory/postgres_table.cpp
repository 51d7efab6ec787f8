// Longer than 400 lines: one class, and the statements of SQL that only it asks.
#include "saca/thinking/memory/postgres_table.h"

#include <fmt/core.h>

#include <thread>
#include <utility>

#include "saca/thinking/memory/postgres.h"

namespace saca::memory {
namespace {

using Failure = PostgresFailure;
using Time = PostgresConnection::Time;

constexpr std::array<const char*, 3> postgres_types{"bigint", "double precision", "text"};

/// Its one row is held by whoever writes: so ids are given in the order in which others see them.
constexpr const char* create_head =
    "CREATE TABLE IF NOT EXISTS saca_bank (version integer NOT NULL, last_id bigint NOT NULL)";
constexpr const char* fill_head =
    "INSERT INTO saca_bank SELECT $1, 0 WHERE NOT EXISTS (SELECT FROM saca_bank)";
/// Who makes or upgrades the tables holds this number, in the database ("SACA").
constexpr const char* hold_tables =
    "SELECT pg_current_xact_id()::text, pg_advisory_xact_lock(1396785985)";

/// Rows that are read at once: some MB.
constexpr int rows_at_once = 1000;

// Of PostgreSQL's table of error codes.
constexpr const char* no_such_table = "42P01";
constexpr const char* no_such_column = "42703";
constexpr const char* reading_only = "25006";
constexpr const char* takes_no_writing = "55000";  // of a replica
constexpr const char* not_in_time = "57014";
constexpr const char* held_by_others = "55P03";

std::string create_cases() {
  std::string text = "CREATE TABLE IF NOT EXISTS saca_cases (id bigint PRIMARY KEY";
  for (const Column& column : case_columns) {
    text += ", " + column_definition(column, postgres_types);
  }
  return text + ")";
}

std::string columns_since(std::int64_t older) {
  std::string text = "ALTER TABLE saca_cases";
  const char* comma = " ";
  for (const Column& column : case_columns) {
    if (column.since > older) {
      text += comma + ("ADD COLUMN " + column_definition(column, postgres_types));
      comma = ", ";
    }
  }
  return text;
}

class PostgresTable final : public CaseTable {
 public:
  explicit PostgresTable(const std::string& url) : name_(printable_url(url)), connection_(url) {}

  /// After the tables were found, made or brought to the newest version.
  [[nodiscard]] std::optional<Error> look_at_tables(IfMissing missing) {
    auto version = stored_version();
    if (version.has_value() && version.value() == 0) {
      if (missing == IfMissing::refuse) {
        return no_such_bank(name_);
      }
      if (auto error = change_tables([this] { return create(); })) {
        return error;
      }
      version = stored_version();
    }
    if (!version.has_value()) {
      return version.error();
    }
    if (auto wrong = wrong_version(version.value(), name_)) {
      return wrong;
    }
    return version.value() == table_version ? std::nullopt
                                            : change_tables([this] { return upgrade(); });
  }

  // ---- CaseTable

  [[nodiscard]] const std::string& name() const noexcept override { return name_; }

  void wait_at_most(std::chrono::milliseconds patience) override { patience_ = patience; }

  [[nodiscard]] std::optional<Error> each_after(match::CaseId last, const Take& take) override {
    static const std::string sql =
        fmt::format("SELECT {} FROM saca_cases WHERE id > $1 ORDER BY id LIMIT {}", column_names(),
                    rows_at_once);
    while (true) {
      const auto rows = read(sql, last);
      if (!rows.has_value()) {
        return rows.error();
      }
      const int count = rows.value().size();
      for (int row = 0; row < count; ++row) {
        last = rows.value().integer(row, 0);
        if (auto error = take(last, cells_at(rows.value(), row))) {
          return error;
        }
      }
      if (count < rows_at_once) {
        return std::nullopt;
      }
    }
  }

  [[nodiscard]] Result<std::optional<Cells>> find(match::CaseId id) override {
    static const std::string sql = "SELECT " + column_names() + " FROM saca_cases WHERE id = $1";
    const auto rows = read(sql, id);
    if (!rows.has_value()) {
      return rows.error();
    }
    return rows.value().size() == 0 ? std::optional<Cells>()
                                    : std::optional(cells_at(rows.value(), 0));
  }

  [[nodiscard]] std::optional<Error> in_one_transaction(const Work& work) override {
    return transaction("SELECT pg_current_xact_id()::text FROM saca_bank FOR UPDATE", work);
  }

  [[nodiscard]] Result<bool> is_empty() override {
    const auto rows = run("SELECT FROM saca_cases LIMIT 1", {}, Access::read);
    return rows.has_value() ? Result(rows.value().size() == 0) : rows.error();
  }

  [[nodiscard]] Result<match::CaseId> insert(const Cells& cells,
                                             std::optional<match::CaseId> id) override {
    // A new id is one more than the last that was given, also to a case that was forgotten since.
    static const std::string sql = fmt::format(
        "WITH given AS (UPDATE saca_bank SET last_id = greatest(last_id, coalesce($1::bigint, "
        "last_id + 1)) RETURNING coalesce($1::bigint, last_id) AS id) INSERT INTO saca_cases ({}) "
        "SELECT (SELECT id FROM given), {} RETURNING id",
        column_names(), parameters('$'));
    const auto rows = write(sql, id ? Cell(*id) : Cell(), cells);
    return rows.has_value() ? Result(match::CaseId{rows.value().integer(0, 0)}) : rows.error();
  }

  [[nodiscard]] Result<bool> rewrite(match::CaseId id, const Cells& cells) override {
    static const std::string sql = "UPDATE saca_cases SET " + assignments('$') + " WHERE id = $1";
    const auto rows = write(sql, id, cells);
    return rows.has_value() ? Result(rows.value().changed() > 0) : rows.error();
  }

  [[nodiscard]] std::optional<Error> remove(match::CaseId id) override {
    const Cell value = id;
    const auto rows = run("DELETE FROM saca_cases WHERE id = $1", {&value, 1}, Access::write);
    return rows.has_value() ? std::nullopt : std::optional(rows.error());
  }

 private:
  [[nodiscard]] static Cells cells_at(const Rows& rows, int row) {
    Cells cells;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      cells.at(i) = rows.cell(row, static_cast<int>(i) + 1);
    }
    return cells;
  }

  [[nodiscard]] Time patience_from_now() const {
    return std::chrono::steady_clock::now() + patience_;
  }

  [[nodiscard]] Error error_of(const Failure& failure, Access access) const {
    const std::string what =
        name_ + (access == Access::read ? ": cannot be read: " : ": cannot be written: ");
    const auto code = access == Access::read ? Error::Code::unreadable : Error::Code::unwritable;
    const std::string& state = failure.state;
    if (failure.kind == Failure::Kind::late || state == not_in_time || state == held_by_others) {
      return {Error::Code::too_late, what + failure.why};
    }
    if (state == no_such_table || state == no_such_column) {
      return {Error::Code::malformed, name_ + ": want a memory bank's own tables: " + failure.why};
    }
    if (state == reading_only || state == takes_no_writing) {
      return {Error::Code::unwritable, name_ + ": may only be read: " + failure.why};
    }
    return {code, what + failure.why};
  }

  /// Connected, before `until`; where a server starts or has been lost it is tried again.
  [[nodiscard]] std::optional<Failure> connect(Time until) {
    constexpr std::chrono::milliseconds pause{50};
    const bool is_first = !was_connected_;
    while (!connection_.is_open()) {
      auto failure = connection_.open(until);
      if (!failure) {
        failure = set_up(until);
      }
      if (!failure) {
        was_connected_ = true;
        break;
      }
      connection_.close();
      if (is_first || std::chrono::steady_clock::now() + pause > until) {
        return failure;
      }
      std::this_thread::sleep_for(pause);
    }
    return std::nullopt;
  }

  /// The server ends what lasts too long of its own accord, and who stops in a transaction.
  [[nodiscard]] std::optional<Failure> set_up(Time until) {
    const auto most = usual_patience.count();
    Rows nothing;
    return connection_.run(
        fmt::format("SELECT set_config('statement_timeout', '{0}', false), "
                    "set_config('idle_in_transaction_session_timeout', '{0}', false)",
                    most),
        {}, until, nothing);
  }

  /// One statement; outside of a transaction it is sent again where the connection was lost.
  [[nodiscard]] Result<Rows> run(const std::string& sql, std::span<const Cell> values,
                                 Access access) {
    const Time until = patience_from_now();
    while (true) {
      Rows rows;
      auto failure = in_transaction_ ? std::nullopt : connect(until);
      if (!failure) {
        failure = connection_.run(sql, values, until, rows);
      }
      if (!failure) {
        return rows;
      }
      if (in_transaction_ || failure->kind != Failure::Kind::lost || !was_connected_ ||
          std::chrono::steady_clock::now() > until) {
        return error_of(*failure, access);
      }
    }
  }

  [[nodiscard]] Result<Rows> read(const std::string& sql, match::CaseId id) {
    const Cell value = id;
    return run(sql, {&value, 1}, Access::read);
  }

  [[nodiscard]] Result<Rows> write(const std::string& sql, const Cell& id, const Cells& cells) {
    std::vector<Cell> values{id};
    values.insert(values.end(), cells.begin(), cells.end());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto* const text = std::get_if<std::string>(&cells.at(i));
      if (text != nullptr && text->find('\0') != std::string::npos) {
        return Error{Error::Code::unwritable, fmt::format("{}: {}: want text without the character "
                                                          "NUL, which no server takes",
                                                          name_, case_columns.at(i).name)};
      }
    }
    return run(sql, values, Access::write);
  }

  // ---- Transactions

  /// What became of a try.
  struct Try {
    std::optional<Error> error;    ///< nullopt: it happened
    bool may_be_repeated = false;  ///< it did not happen, because the connection was lost
    std::string unknown;           ///< the transaction of which the end was not heard; or empty
  };

  /// @param begin  a statement that makes others wait, and whose first column is the transaction's
  ///               own number
  [[nodiscard]] std::optional<Error> transaction(const std::string& begin, const Work& work) {
    const Time until = patience_from_now();
    while (true) {
      if (const auto failure = connect(until)) {
        return error_of(*failure, Access::write);
      }
      Try one = try_transaction(begin, work, until);
      if (!one.unknown.empty()) {
        one = fate_of(one.unknown, patience_from_now());
      }
      if (!one.error || !one.may_be_repeated || std::chrono::steady_clock::now() > until) {
        return one.error;
      }
    }
  }

  [[nodiscard]] Try try_transaction(const std::string& begin, const Work& work, Time until) {
    const auto failed = [this](const Failure& failure) {
      return Try{.error = error_of(failure, Access::write),
                 .may_be_repeated = failure.kind == Failure::Kind::lost,
                 .unknown = {}};
    };
    Rows rows;
    if (const auto failure =
            connection_.run("BEGIN ISOLATION LEVEL READ COMMITTED", {}, until, rows)) {
      return failed(*failure);
    }
    if (const auto failure = connection_.run(begin, {}, until, rows)) {
      end_transaction(until);
      return failed(*failure);
    }
    const Cell number = rows.size() > 0 ? rows.cell(0, 0) : Cell();
    in_transaction_ = true;
    std::optional<Error> error;
    try {
      error = work();
    } catch (...) {
      in_transaction_ = false;
      end_transaction(until);
      throw;
    }
    in_transaction_ = false;
    if (error) {
      const bool lost = !connection_.is_open();
      end_transaction(until);
      return {.error = std::move(error), .may_be_repeated = lost, .unknown = {}};
    }
    const auto failure = connection_.run("COMMIT", {}, patience_from_now(), rows);
    if (!failure) {
      return {};
    }
    if (failure->kind == Failure::Kind::refused) {
      end_transaction(until);
      return failed(*failure);
    }
    return {.error = error_of(*failure, Access::write),
            .may_be_repeated = false,
            .unknown = text_of(number)};
  }

  /// Nothing of it happens, also where the connection is given up.
  void end_transaction(Time until) {
    Rows rows;
    if (connection_.is_open() && connection_.run("ROLLBACK", {}, until, rows)) {
      connection_.close();
    }
  }

  /// The connection was lost while the transaction was to end: the server knows.
  [[nodiscard]] Try fate_of(const std::string& number, Time until) {
    constexpr std::chrono::milliseconds pause{20};
    const Cell value = number;
    std::string why = "the connection was lost when the transaction was to end";
    do {
      Rows rows;
      auto failure = connect(until);
      if (!failure) {
        failure =
            connection_.run("SELECT pg_xact_status($1::text::xid8)", {&value, 1}, until, rows);
      }
      if (failure && failure->kind != Failure::Kind::lost) {
        why = failure->why;
        break;
      }
      const std::string fate = failure ? "" : text_of(rows.cell(0, 0));
      if (fate == "committed") {
        return {};
      }
      if (fate == "aborted") {
        return {.error = Error{Error::Code::unwritable, name_ + ": cannot be written: " + why},
                .may_be_repeated = true,
                .unknown = {}};
      }
      std::this_thread::sleep_for(pause);
    } while (std::chrono::steady_clock::now() < until);
    return {.error = Error{Error::Code::unwritable,
                           name_ + ": it is not known whether it was written: " + why},
            .may_be_repeated = false,
            .unknown = {}};
  }

  // ---- Tables

  /// @return  0: there are none
  [[nodiscard]] Result<std::int64_t> stored_version() {
    const auto there =
        run("SELECT to_regclass('saca_bank') IS NOT NULL AND "
            "to_regclass('saca_cases') IS NOT NULL",
            {}, Access::read);
    if (!there.has_value()) {
      return there.error();
    }
    if (text_of(there.value().cell(0, 0)) != "t") {
      return std::int64_t{0};
    }
    const auto rows = run("SELECT version FROM saca_bank", {}, Access::read);
    if (!rows.has_value()) {
      return rows.error();
    }
    return rows.value().size() == 1
               ? Result(rows.value().integer(0, 0))
               : Error{Error::Code::malformed,
                       fmt::format("{}: is damaged: want one row in table saca_bank, got {}", name_,
                                   rows.value().size())};
  }

  [[nodiscard]] std::optional<Error> change_tables(const Work& work) {
    return transaction(hold_tables, work);
  }

  [[nodiscard]] std::optional<Error> create() {
    for (const std::string& sql : {std::string(create_head), create_cases()}) {
      const auto made = run(sql, {}, Access::write);
      if (!made.has_value()) {
        return made.error();
      }
    }
    const Cell version = std::int64_t{table_version};
    const auto filled = run(fill_head, {&version, 1}, Access::write);
    return filled.has_value() ? std::nullopt : std::optional(filled.error());
  }

  [[nodiscard]] std::optional<Error> upgrade() {
    const auto older = stored_version();  // unless somebody was faster
    if (!older.has_value() || older.value() == table_version) {
      return older.has_value() ? std::nullopt : std::optional(older.error());
    }
    const auto added = run(columns_since(older.value()), {}, Access::write);
    if (!added.has_value()) {
      return added.error();
    }
    const Cell version = std::int64_t{table_version};
    const auto set = run("UPDATE saca_bank SET version = $1", {&version, 1}, Access::write);
    return set.has_value() ? std::nullopt : std::optional(set.error());
  }

  std::string name_;  ///< without password
  PostgresConnection connection_;
  std::chrono::milliseconds patience_ = usual_patience;
  bool was_connected_ = false;
  bool in_transaction_ = false;
};

}  // namespace

Result<std::unique_ptr<CaseTable>> open_postgres(const std::string& url, IfMissing missing) {
  auto table = std::make_unique<PostgresTable>(url);
  if (auto error = table->look_at_tables(missing)) {
    return *std::move(error);
  }
  return Result<std::unique_ptr<CaseTable>>(std::move(table));
}

}  // namespace saca::memory
