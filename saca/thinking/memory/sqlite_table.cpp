// Longer than 400 lines: one class, and the statements of SQL that only it asks.
#include "saca/thinking/memory/sqlite_table.h"

#include <algorithm>
#include <initializer_list>
#include <utility>
#include <vector>

#include "saca/base/core/printable.h"
#include "saca/thinking/memory/sqlite.h"

namespace saca::memory {
namespace {

constexpr std::int64_t application_id = 0x53414341;  // "SACA"

// synchronous = EXTRA: with FULL, a power cut just after a commit may bring back the journal and
// with it the state before. A rollback journal, not WAL: one file, readable where nothing may be
// written. The last two are SQLite's advice for files that somebody else may have damaged.
constexpr const char* set_up =
    "PRAGMA journal_mode = DELETE; PRAGMA synchronous = EXTRA;"
    "PRAGMA trusted_schema = OFF; PRAGMA cell_size_check = ON;";

constexpr std::array<const char*, 3> sqlite_types{"INTEGER", "REAL", "TEXT"};

// As SQLite keeps it, also of a table that got its last columns later.
std::string table_of_cases(std::int64_t of_version) {
  std::string text = "CREATE TABLE cases ( id INTEGER PRIMARY KEY AUTOINCREMENT";
  for (const Column& column : case_columns) {
    if (column.since <= of_version) {
      text += ", " + column_definition(column, sqlite_types);
    }
  }
  return text + ") STRICT";
}
// SQLite's own, for AUTOINCREMENT.
constexpr const char* table_of_ids = "CREATE TABLE sqlite_sequence(name,seq)";

std::string set_version() {
  return "PRAGMA user_version = " + std::to_string(table_version) + ";";
}

std::string create() {
  return table_of_cases(table_version) + ";PRAGMA application_id = 1396785985;" + set_version();
}

std::string upgrade_from(std::int64_t older) {
  std::string sql;
  for (const Column& column : case_columns) {
    if (column.since > older) {
      sql += "ALTER TABLE cases ADD COLUMN " + column_definition(column, sqlite_types) + ";";
    }
  }
  return sql + set_version();
}

// Before the table of the same name when a statement looks for one, in this connection only.
std::string view_of(std::int64_t older) {
  std::string more;
  for (const Column& column : case_columns) {
    if (column.since > older) {
      more += std::string(", ") +
              (column.of_older_rows == nullptr ? "NULL" : column.of_older_rows) + " AS " +
              column.name;
    }
  }
  return "PRAGMA temp_store = MEMORY; CREATE TEMP VIEW cases AS SELECT *" + more +
         " FROM main.cases;";
}

Cell cell_at(const Statement& statement, int column) {
  switch (statement.type(column)) {
    case SQLITE_INTEGER:
      return statement.integer(column);
    case SQLITE_FLOAT:
      return statement.number(column);
    case SQLITE_TEXT:
      return statement.text(column);
    default:  // nothing; a blob is in no column of a strict table
      return {};
  }
}

/// Of a row whose first column is the id.
Cells cells_at(const Statement& statement) {
  Cells cells;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells.at(i) = cell_at(statement, static_cast<int>(i) + 1);
  }
  return cells;
}

/// To the parameters after the first. The cells must live until the statement is done.
void bind(Statement& statement, const Cells& cells) {
  int parameter = 2;
  for (const Cell& cell : cells) {
    std::visit(
        [&](const auto& value) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(value)>, std::monostate>) {
            statement.bind(parameter, value);
          }
        },
        cell);
    ++parameter;
  }
}

class SqliteTable final : public CaseTable {
 public:
  explicit SqliteTable(std::string name) : name_(std::move(name)) {}

  /// A file is opened, and then one step after the other until one fails.
  using Step = std::optional<Error> (*)(SqliteTable&);
  [[nodiscard]] static Result<std::unique_ptr<CaseTable>> opened(
      const std::filesystem::path& path, int flags, std::initializer_list<Step> steps) {
    auto table = std::make_unique<SqliteTable>(path.string());
    auto error = table->connect(path, flags);
    if (!error) {
      error = table->run(set_up, Access::read);
    }
    for (const Step step : steps) {
      if (!error) {
        error = step(*table);
      }
    }
    if (error) {
      return *error;
    }
    return Result<std::unique_ptr<CaseTable>>(std::move(table));
  }

  // ---- CaseTable

  [[nodiscard]] const std::string& name() const noexcept override { return name_; }

  void wait_at_most(std::chrono::milliseconds patience) override {
    sqlite3_busy_timeout(database_.get(), static_cast<int>(patience.count()));
  }

  [[nodiscard]] std::optional<Error> each_after(match::CaseId last, const Take& take) override {
    static const std::string sql =
        "SELECT " + column_names() + " FROM cases WHERE id > ?1 ORDER BY id";
    Statement statement(database_.get(), sql.c_str());
    statement.bind(1, last);
    int code = statement.step();
    for (; code == SQLITE_ROW; code = statement.step()) {
      if (auto error = take(statement.integer(0), cells_at(statement))) {
        return error;
      }
    }
    return code == SQLITE_DONE ? std::nullopt : std::optional(problem(Access::read));
  }

  [[nodiscard]] Result<std::optional<Cells>> find(match::CaseId id) override {
    static const std::string sql = "SELECT " + column_names() + " FROM cases WHERE id = ?1";
    Statement statement(database_.get(), sql.c_str());
    switch (statement.bind(1, id).step()) {
      case SQLITE_ROW:
        return std::optional(cells_at(statement));
      case SQLITE_DONE:
        return std::optional<Cells>();
      default:
        return problem(Access::read);
    }
  }

  [[nodiscard]] std::optional<Error> in_one_transaction(const Work& work) override {
    if (may_not_be_upgraded_) {
      return may_not_be_upgraded_;
    }
    return transaction(work);
  }

  [[nodiscard]] Result<bool> is_empty() override {
    const auto present = integer("SELECT count(*) FROM cases");
    return present.has_value() ? Result(present.value() == 0) : present.error();
  }

  [[nodiscard]] Result<match::CaseId> insert(const Cells& cells,
                                             std::optional<match::CaseId> id) override {
    static const std::string sql =
        "INSERT INTO cases (" + column_names() + ") VALUES (?1, " + parameters('?') + ")";
    Statement statement(database_.get(), sql.c_str());
    if (id) {
      statement.bind(1, *id);
    }
    bind(statement, cells);
    if (statement.step() != SQLITE_DONE) {
      return problem(Access::write);
    }
    return match::CaseId{sqlite3_last_insert_rowid(database_.get())};
  }

  [[nodiscard]] Result<bool> rewrite(match::CaseId id, const Cells& cells) override {
    static const std::string sql = "UPDATE cases SET " + assignments('?') + " WHERE id = ?1";
    Statement statement(database_.get(), sql.c_str());
    statement.bind(1, id);
    bind(statement, cells);
    if (statement.step() != SQLITE_DONE) {
      return problem(Access::write);
    }
    return sqlite3_changes(database_.get()) > 0;
  }

  [[nodiscard]] std::optional<Error> remove(match::CaseId id) override {
    Statement statement(database_.get(), "DELETE FROM cases WHERE id = ?1");
    return statement.bind(1, id).step() == SQLITE_DONE ? std::nullopt
                                                       : std::optional(problem(Access::write));
  }

  // ---- Opening

  [[nodiscard]] Error problem(Access access) const {
    return sqlite_problem(database_.get(), name_, access);
  }

  [[nodiscard]] std::optional<Error> connect(const std::filesystem::path& path, int flags) {
    // Absolute, so that no name is special to SQLite (":memory:", "file:...").
    std::error_code no_folder;
    const std::string file = std::filesystem::absolute(path, no_folder).string();
    if (std::filesystem::exists(file, no_folder) &&
        !std::filesystem::is_regular_file(file, no_folder)) {
      return Error{Error::Code::unreadable, name_ + ": cannot be read: is no file"};
    }
    sqlite3* opened = nullptr;
    const int code = sqlite3_open_v2(file.c_str(), &opened, flags, nullptr);
    database_.reset(opened);
    if (opened == nullptr || path.empty()) {
      return Error{Error::Code::unreadable, name_ + ": want a file"};
    }
    be_wary(opened);
    if (code != SQLITE_OK) {
      return problem(Access::read);
    }
    sqlite3_busy_timeout(opened, static_cast<int>(usual_patience.count()));
    return std::nullopt;
  }

  /// From now on a copy in memory is asked.
  [[nodiscard]] std::optional<Error> move_into_memory() {
    auto opened = in_memory();
    if (!opened.has_value()) {
      return opened.error();
    }
    Database copy = std::move(opened).value();
    sqlite3_backup* const backup = sqlite3_backup_init(copy.get(), "main", database_.get(), "main");
    if (backup != nullptr) {
      sqlite3_backup_step(backup, -1);  // the whole; `finish` tells what went wrong
    }
    if (backup == nullptr || sqlite3_backup_finish(backup) != SQLITE_OK) {
      return sqlite_problem(copy.get(), name_, Access::read);
    }
    database_ = std::move(copy);
    return std::nullopt;
  }

  /// An empty bank that is in no file.
  [[nodiscard]] std::optional<Error> start_in_memory() {
    auto opened = in_memory();
    if (!opened.has_value()) {
      return opened.error();
    }
    database_ = std::move(opened).value();
    return run(create().c_str(), Access::write);
  }

  /// From now on it is only read.
  [[nodiscard]] std::optional<Error> take_no_more() const {
    return run("PRAGMA query_only = ON", Access::read);
  }

  [[nodiscard]] std::optional<Error> run(const char* sql, Access access) const {
    if (sqlite3_exec(database_.get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) {
      return problem(access);
    }
    return std::nullopt;
  }

  /// The one integer that a statement returns.
  [[nodiscard]] Result<std::int64_t> integer(const char* sql) const {
    Statement statement(database_.get(), sql);
    if (statement.step() != SQLITE_ROW) {
      return problem(Access::read);
    }
    return statement.integer(0);
  }

  [[nodiscard]] Result<bool> is_new() const {
    for (const char* number :
         {"SELECT count(*) FROM sqlite_schema", "PRAGMA application_id", "PRAGMA user_version"}) {
      const auto found = integer(number);
      if (!found.has_value() || found.value() != 0) {
        return found.has_value() ? Result(false) : found.error();
      }
    }
    return true;
  }

  [[nodiscard]] std::optional<Error> create_if_new() const {
    const auto is_empty = is_new();
    if (!is_empty.has_value()) {
      return is_empty.error();
    }
    if (!is_empty.value()) {
      return std::nullopt;
    }
    return run_where_needed(create().c_str(), [this] { return is_new(); });
  }

  /// All that `work` does happens, or nothing of it.
  /// @param work  returns what went wrong
  template <class Work>
  [[nodiscard]] std::optional<Error> transaction(const Work& work) const {
    if (auto error = run("BEGIN IMMEDIATE", Access::write)) {
      return error;
    }
    struct UndoUnlessDone {
      const SqliteTable& table;
      bool is_done = false;
      ~UndoUnlessDone() {
        if (!is_done) {
          (void)table.run("ROLLBACK", Access::write);
        }
      }
    } undo{*this};
    std::optional<Error> error = work();
    if (!error) {
      error = run("COMMIT", Access::write);
    }
    undo.is_done = !error;
    return error;
  }

  /// In one transaction, unless another process was faster and it is not needed any more.
  template <class IsNeeded>
  [[nodiscard]] std::optional<Error> run_where_needed(const char* statements,
                                                      IsNeeded is_needed) const {
    return transaction([&]() -> std::optional<Error> {
      const Result<bool> needed = is_needed();
      if (!needed.has_value()) {
        return needed.error();
      }
      return needed.value() ? run(statements, Access::write) : std::nullopt;
    });
  }

  /// The first thing in the schema that our statements do not make: a view, a trigger, an index or
  /// a rule of somebody else could change what ours do.
  [[nodiscard]] std::optional<Error> foreign_schema(std::int64_t of_version) const {
    std::vector<std::string> missing{table_of_cases(of_version), table_of_ids};
    Statement statement(database_.get(), "SELECT type, name, sql FROM main.sqlite_schema");
    int code = statement.step();
    for (; code == SQLITE_ROW; code = statement.step()) {
      const auto found = std::find(missing.begin(), missing.end(), statement.text(2));
      if (found == missing.end()) {
        return Error{Error::Code::malformed, name_ + ": want a memory bank's own tables, got the " +
                                                 one_line(statement.text(0), 20) + " " +
                                                 one_line(statement.text(1), 40) + ": " +
                                                 one_line(statement.text(2))};
      }
      missing.erase(found);
    }
    if (code != SQLITE_DONE) {
      return problem(Access::read);
    }
    return missing.empty()
               ? std::nullopt
               : std::optional(Error{Error::Code::malformed, name_ + ": is damaged: lacks " +
                                                                 one_line(missing.front(), 60)});
  }

  [[nodiscard]] std::optional<Error> wrong_kind() const {
    const auto owner = integer("PRAGMA application_id");
    const auto found = integer("PRAGMA user_version");
    if (!owner.has_value() || !found.has_value()) {
      return owner.has_value() ? found.error() : owner.error();
    }
    if (owner.value() != application_id) {
      return Error{Error::Code::malformed,
                   name_ + ": want a memory bank, got a database of another program"};
    }
    if (auto wrong = wrong_version(found.value(), name_)) {
      return wrong;
    }
    if (auto foreign = foreign_schema(found.value())) {
      return foreign;
    }
    Statement check(database_.get(), "PRAGMA quick_check(1)");
    if (check.step() != SQLITE_ROW) {
      return problem(Access::read);
    }
    if (check.text(0) != "ok") {
      return Error{Error::Code::malformed, name_ + ": is damaged: " + check.text(0)};
    }
    return std::nullopt;
  }

  /// A file of an older version gets the columns that it lacks; one that may only be read is read
  /// as if it had them.
  [[nodiscard]] std::optional<Error> bring_up_to_date() {
    const auto found = integer("PRAGMA user_version");
    if (!found.has_value() || found.value() == table_version) {
      return found.has_value() ? std::nullopt : std::optional(found.error());
    }
    auto error = upgrade(found.value());
    if (error && error->code == Error::Code::unwritable) {
      may_not_be_upgraded_ =
          std::exchange(error, run(view_of(found.value()).c_str(), Access::read));
    }
    return error;
  }

  [[nodiscard]] std::optional<Error> upgrade(std::int64_t older) const {
    return run_where_needed(upgrade_from(older).c_str(), [this, older]() -> Result<bool> {
      const auto found = integer("PRAGMA user_version");
      if (!found.has_value()) {
        return found.error();
      }
      return found.value() == older;
    });
  }

 private:
  [[nodiscard]] Result<Database> in_memory() const {
    sqlite3* opened = nullptr;
    const int code =
        sqlite3_open_v2(":memory:", &opened, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
    Database database(opened);
    if (code != SQLITE_OK) {
      return Error{Error::Code::unreadable, name_ + ": want memory for a copy of it, got none"};
    }
    be_wary(opened);
    return database;
  }

  std::string name_;  ///< of the file, as the caller gave it
  Database database_;
  std::optional<Error> may_not_be_upgraded_;  ///< why a file of an older version stays as it is
};

}  // namespace

Result<std::unique_ptr<CaseTable>> open_sqlite(const std::filesystem::path& path) {
  return SqliteTable::opened(path, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE,
                             {[](SqliteTable& t) { return t.create_if_new(); },
                              [](SqliteTable& t) { return t.wrong_kind(); },
                              [](SqliteTable& t) { return t.bring_up_to_date(); }});
}

Result<std::unique_ptr<CaseTable>> copy_of_sqlite(const std::filesystem::path& path) {
  // For writing where that may be: only so can what a killed process left half-done be rolled back.
  return SqliteTable::opened(path, SQLITE_OPEN_READWRITE,
                             {[](SqliteTable& t) { return t.wrong_kind(); },
                              [](SqliteTable& t) { return t.move_into_memory(); },
                              [](SqliteTable& t) { return t.bring_up_to_date(); },
                              [](SqliteTable& t) { return t.take_no_more(); }});
}

Result<std::unique_ptr<CaseTable>> copy_of(CaseTable& other) {
  auto copy = std::make_unique<SqliteTable>(other.name());
  auto error = copy->start_in_memory();
  if (!error) {
    error = copy->in_one_transaction([&] {
      return other.each_after(0, [&](match::CaseId id, const Cells& cells) -> std::optional<Error> {
        const auto added = copy->insert(cells, id);
        return added.has_value() ? std::nullopt : std::optional(added.error());
      });
    });
  }
  if (!error) {
    error = copy->take_no_more();
  }
  if (error) {
    return *error;
  }
  return Result<std::unique_ptr<CaseTable>>(std::move(copy));
}

}  // namespace saca::memory
