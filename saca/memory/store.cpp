#include "saca/memory/store.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saca/config/json_text.h"
#include "saca/core/contract.h"
#include "saca/core/fnv.h"
#include "saca/core/printable.h"
#include "saca/memory/case_json.h"
#include "saca/memory/experience.h"
#include "saca/memory/scene_json.h"
#include "saca/memory/similarity.h"
#include "saca/memory/sqlite.h"

namespace saca::memory {
namespace {

constexpr std::int64_t application_id = 0x53414341;  // "SACA"
constexpr std::int64_t version = 3;

// synchronous = EXTRA: with FULL, a power cut just after a commit may bring back the journal and
// with it the state before. A rollback journal, not WAL: one file, readable where nothing may be
// written. The last two are SQLite's advice for files that somebody else may have damaged.
constexpr const char* set_up =
    "PRAGMA journal_mode = DELETE; PRAGMA synchronous = EXTRA;"
    "PRAGMA trusted_schema = OFF; PRAGMA cell_size_check = ON;";

// What each version added to the table of the version before, from version 2 on.
constexpr std::array added_columns{"strength REAL", "details TEXT NOT NULL DEFAULT '{}'"};
static_assert(added_columns.size() + 1 == version);

// As SQLite keeps it, also of a table that got its last columns later.
std::string table_of_cases(std::int64_t of_version) {
  std::string columns =
      "CREATE TABLE cases ("
      " id INTEGER PRIMARY KEY AUTOINCREMENT,"
      " policy INTEGER NOT NULL,"
      " target_speed_mps REAL,"
      " best_policy INTEGER NOT NULL,"
      " harm REAL NOT NULL,"
      " best_harm REAL NOT NULL,"
      " collision_loss REAL NOT NULL,"
      " review TEXT NOT NULL,"
      " source TEXT NOT NULL,"
      " scene TEXT NOT NULL";
  for (std::size_t i = 0; i + 1 < static_cast<std::size_t>(of_version); ++i) {
    columns += std::string(", ") + added_columns.at(i);
  }
  return columns + ") STRICT";
}
// SQLite's own, for AUTOINCREMENT.
constexpr const char* table_of_ids = "CREATE TABLE sqlite_sequence(name,seq)";

std::string set_version() {
  return "PRAGMA user_version = " + std::to_string(version) + ";";
}

std::string create() {
  return table_of_cases(version) + ";PRAGMA application_id = 1396785985;" + set_version();
}

std::string upgrade_from(std::int64_t older) {
  std::string sql;
  for (auto i = static_cast<std::size_t>(older - 1); i < added_columns.size(); ++i) {
    sql += std::string("ALTER TABLE cases ADD COLUMN ") + added_columns.at(i) + ";";
  }
  return sql + set_version();
}

// Before the table of the same name when a statement looks for one, in this connection only.
std::string view_of(std::int64_t older) {
  return std::string("PRAGMA temp_store = MEMORY; CREATE TEMP VIEW cases AS SELECT *,") +
         (older < 2 ? " NULL AS strength," : "") + " '{}' AS details FROM main.cases;";
}

constexpr const char* insert =
    "INSERT INTO cases (policy, target_speed_mps, best_policy, harm, best_harm, collision_loss,"
    " review, source, scene, strength, details, id)"
    " VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12)";
constexpr const char* rewrite =
    "UPDATE cases SET policy = ?1, target_speed_mps = ?2, best_policy = ?3, harm = ?4,"
    " best_harm = ?5, collision_loss = ?6, review = ?7, source = ?8, scene = ?9, strength = ?10,"
    " details = ?11 WHERE id = ?12";
constexpr int id_parameter = 12;  // of these two

// In the order of `Column`.
constexpr const char* select_after =
    "SELECT id, policy, target_speed_mps, best_policy, harm, best_harm, collision_loss, review,"
    " source, scene, strength, details FROM cases WHERE id > ?1 ORDER BY id";
constexpr const char* select_one =
    "SELECT id, policy, target_speed_mps, best_policy, harm, best_harm, collision_loss, review,"
    " source, scene, strength, details FROM cases WHERE id = ?1";

constexpr const char* remove_one = "DELETE FROM cases WHERE id = ?1";

/// Also the number of its parameter in `insert` and `rewrite`, but for the id.
enum Column : int {
  id_column,
  policy_column,
  target_speed_column,
  best_policy_column,
  harm_column,
  best_harm_column,
  collision_loss_column,
  review_column,
  source_column,
  scene_column,
  strength_column,
  details_column,
};

constexpr std::array all_columns{
    id_column,     policy_column,    target_speed_column,   best_policy_column,
    harm_column,   best_harm_column, collision_loss_column, review_column,
    source_column, scene_column,     strength_column,       details_column};

/// Reads the columns of the row at which a statement stands; the first thing wrong is kept.
class Row {
 public:
  Row(const Statement& statement, const std::string& file) : statement_(statement), file_(file) {}

  /// @return  in [0, 7]
  manoeuvre::PolicyId policy(Column column) {
    const std::int64_t number = statement_.integer(column);
    if (statement_.type(column) != SQLITE_INTEGER || number < 0 ||
        number >= static_cast<std::int64_t>(manoeuvre::num_policies)) {
      reject(column, "want an integer from 0 to 7, got " + statement_.text(column));
      return manoeuvre::PolicyId::aeb;
    }
    return manoeuvre::all_policies[static_cast<std::size_t>(number)];
  }

  double amount(Column column) {
    const int type = statement_.type(column);
    const double number = statement_.number(column);
    if ((type != SQLITE_FLOAT && type != SQLITE_INTEGER) || !std::isfinite(number) ||
        number < 0.0) {
      reject(column, "want a finite number >= 0, got " +
                         (type == SQLITE_NULL ? "nothing" : statement_.text(column)));
    }
    return number;
  }

  std::optional<double> optional_amount(Column column) {
    return statement_.type(column) == SQLITE_NULL ? std::nullopt : std::optional(amount(column));
  }

  std::string text(Column column) {
    if (statement_.type(column) != SQLITE_TEXT) {
      reject(column, "want text");
    }
    return statement_.text(column);
  }

  world::Scene scene(Column column) {
    const auto parsed = config::parse_json(text(column));
    if (!parsed.has_value()) {
      reject(column, parsed.error().message);
      return {};
    }
    Result<world::Scene> scene = scene_from_json(parsed.value());
    if (!scene.has_value()) {
      reject(column, scene.error().message);
      return {};
    }
    return std::move(scene).value();
  }

  /// What version 2 did not know, and the rules of a whole case.
  void read_details(Case& one) {
    const auto parsed = config::parse_json(text(details_column));
    if (!parsed.has_value()) {
      reject(details_column, parsed.error().message);
    } else if (const auto problem = memory::read_details(parsed.value(), one)) {
      reject(details_column, problem->message);
    }
    if (const auto broken = broken_rule(one)) {
      reject(broken->key, broken->why);
    }
  }

  void reject(Column column, const std::string& why) { reject(statement_.name(column), why); }
  void reject(const std::string& key, const std::string& why) {
    if (!problem_) {
      problem_ = Error{Error::Code::malformed, file_ + ": table cases, id " +
                                                   std::to_string(statement_.integer(id_column)) +
                                                   ": " + key + ": " + why};
    }
  }

  [[nodiscard]] const std::optional<Error>& problem() const { return problem_; }

 private:
  const Statement& statement_;
  const std::string& file_;
  std::optional<Error> problem_;
};

Result<Case> case_at(const Statement& statement, const std::string& file) {
  Row row(statement, file);
  Case one{.id = statement.integer(id_column),
           .scene = row.scene(scene_column),
           .plan = {row.policy(policy_column), row.optional_amount(target_speed_column),
                    row.optional_amount(strength_column)},
           .best = row.policy(best_policy_column),
           .harm = row.amount(harm_column),
           .best_harm = row.amount(best_harm_column),
           .collision_loss = row.amount(collision_loss_column),
           .review = row.text(review_column),
           .source = row.text(source_column)};
  row.read_details(one);
  if (row.problem()) {
    return *row.problem();
  }
  return one;
}

}  // namespace

Gate gate(double confidence) noexcept {
  if (confidence > 0.90) {
    return Gate::cache;
  }
  return confidence > 0.70 ? Gate::check : Gate::reason;
}

Gate gate(const Match& match) noexcept {
  return gate(match.trusted_confidence) == Gate::cache
             ? Gate::cache
             : std::max(gate(match.confidence), Gate::check);
}

struct Store::State {
  Database database;
  std::string name;  ///< of the file, as the caller gave it

  std::optional<Error> may_not_be_upgraded;  ///< why a file of an older version stays as it is

  Experience experience;  ///< of the cases that were in the file when it was last looked at

  [[nodiscard]] Error problem(Access access) const {
    return sqlite_problem(database.get(), name, access);
  }

  [[nodiscard]] std::optional<Error> connect(const std::filesystem::path& path, int flags) {
    name = path.string();
    // Absolute, so that no name is special to SQLite (":memory:", "file:...").
    std::error_code no_folder;
    const std::string file = std::filesystem::absolute(path, no_folder).string();
    if (std::filesystem::exists(file, no_folder) &&
        !std::filesystem::is_regular_file(file, no_folder)) {
      return Error{Error::Code::unreadable, name + ": cannot be read: is no file"};
    }
    sqlite3* opened = nullptr;
    const int code = sqlite3_open_v2(file.c_str(), &opened, flags, nullptr);
    database.reset(opened);
    if (opened == nullptr || path.empty()) {
      return Error{Error::Code::unreadable, name + ": want a file"};
    }
    be_wary(opened);
    if (code != SQLITE_OK) {
      return problem(Access::read);
    }
    sqlite3_busy_timeout(opened, usual_patience);
    return std::nullopt;
  }

  /// From now on a copy in memory is asked.
  [[nodiscard]] std::optional<Error> move_into_memory() {
    sqlite3* opened = nullptr;
    const int code =
        sqlite3_open_v2(":memory:", &opened, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
    Database copy(opened);
    if (code != SQLITE_OK) {
      return Error{Error::Code::unreadable, name + ": want memory for a copy of it, got none"};
    }
    be_wary(opened);
    sqlite3_backup* const backup = sqlite3_backup_init(opened, "main", database.get(), "main");
    if (backup != nullptr) {
      sqlite3_backup_step(backup, -1);  // the whole; `finish` tells what went wrong
    }
    if (backup == nullptr || sqlite3_backup_finish(backup) != SQLITE_OK) {
      return sqlite_problem(opened, name, Access::read);
    }
    database = std::move(copy);
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Error> run(const char* sql, Access access) const {
    if (sqlite3_exec(database.get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) {
      return problem(access);
    }
    return std::nullopt;
  }

  /// The one integer that a statement returns.
  [[nodiscard]] Result<std::int64_t> integer(const char* sql) const {
    Statement statement(database.get(), sql);
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
  [[nodiscard]] std::optional<Error> in_one_transaction(Work work) const {
    if (auto error = run("BEGIN IMMEDIATE", Access::write)) {
      return error;
    }
    std::optional<Error> error = work();
    if (!error) {
      error = run("COMMIT", Access::write);
    }
    if (error) {
      (void)run("ROLLBACK", Access::write);
    }
    return error;
  }

  /// In one transaction, unless another process was faster and it is not needed any more.
  template <class IsNeeded>
  [[nodiscard]] std::optional<Error> run_where_needed(const char* statements,
                                                      IsNeeded is_needed) const {
    return in_one_transaction([&]() -> std::optional<Error> {
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
    Statement statement(database.get(), "SELECT type, name, sql FROM main.sqlite_schema");
    int code = statement.step();
    for (; code == SQLITE_ROW; code = statement.step()) {
      const auto found = std::find(missing.begin(), missing.end(), statement.text(2));
      if (found == missing.end()) {
        return Error{Error::Code::malformed, name + ": want a memory bank's own tables, got the " +
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
               : std::optional(Error{Error::Code::malformed, name + ": is damaged: lacks " +
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
                   name + ": want a memory bank, got a database of another program"};
    }
    if (found.value() < 1 || found.value() > version) {
      return Error{Error::Code::malformed, name + ": want version " + std::to_string(version) +
                                               " of a memory bank or an older one, got version " +
                                               std::to_string(found.value())};
    }
    if (auto foreign = foreign_schema(found.value())) {
      return foreign;
    }
    Statement check(database.get(), "PRAGMA quick_check(1)");
    if (check.step() != SQLITE_ROW) {
      return problem(Access::read);
    }
    if (check.text(0) != "ok") {
      return Error{Error::Code::malformed, name + ": is damaged: " + check.text(0)};
    }
    return std::nullopt;
  }

  /// A file of an older version gets the columns that it lacks; one that may only be read is read
  /// as if it had them.
  [[nodiscard]] std::optional<Error> bring_up_to_date() {
    const auto found = integer("PRAGMA user_version");
    if (!found.has_value() || found.value() == version) {
      return found.has_value() ? std::nullopt : std::optional(found.error());
    }
    auto error = upgrade(found.value());
    if (error && error->code == Error::Code::unwritable) {
      may_not_be_upgraded = std::exchange(error, run(view_of(found.value()).c_str(), Access::read));
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

  /// Calls `take` with each case after `last`, in order.
  template <class Take>
  [[nodiscard]] std::optional<Error> each_after(CaseId last, Take take) const {
    Statement statement(database.get(), select_after);
    statement.bind(1, last);
    int code = statement.step();
    for (; code == SQLITE_ROW; code = statement.step()) {
      Result<Case> one = case_at(statement, name);
      if (!one.has_value()) {
        return one.error();
      }
      take(std::move(one).value());
    }
    return code == SQLITE_DONE ? std::nullopt : std::optional(problem(Access::read));
  }

  /// A file is opened, and then one step after the other until one fails.
  using Step = std::optional<Error> (*)(State&);
  [[nodiscard]] static Result<std::unique_ptr<State>> opened(const std::filesystem::path& path,
                                                             int flags,
                                                             std::initializer_list<Step> steps) {
    auto state = std::make_unique<State>();
    auto error = state->connect(path, flags);
    if (!error) {
      error = state->run(set_up, Access::read);
    }
    for (const Step step : steps) {
      if (!error) {
        error = step(*state);
      }
    }
    if (error) {
      return *error;
    }
    return state;
  }

  /// Learns the features of cases that it does not know yet.
  [[nodiscard]] std::optional<Error> catch_up() {
    return each_after(experience.last_id(), [this](const Case& one) { experience.add(one); });
  }
};

Store::Store(std::unique_ptr<State> state) : state_(std::move(state)) {}
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;
Store::~Store() = default;

Result<Store> Store::open(const std::filesystem::path& path) {
  auto state = State::opened(
      path, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE,
      {[](State& s) { return s.create_if_new(); }, [](State& s) { return s.wrong_kind(); },
       [](State& s) { return s.bring_up_to_date(); }, [](State& s) { return s.catch_up(); }});
  if (!state.has_value()) {
    return state.error();
  }
  return Store(std::move(state).value());
}

Result<Store> Store::snapshot(const std::filesystem::path& path) {
  std::error_code problem;
  if (!std::filesystem::exists(path, problem)) {
    return Error{Error::Code::unreadable, path.string() + ": there is no such memory bank"};
  }
  // For writing where that may be: only so can what a killed process left half-done be rolled back.
  auto state = State::opened(
      path, SQLITE_OPEN_READWRITE,
      {[](State& s) { return s.wrong_kind(); }, [](State& s) { return s.move_into_memory(); },
       [](State& s) { return s.bring_up_to_date(); },
       [](State& s) { return s.run("PRAGMA query_only = ON", Access::read); },
       [](State& s) { return s.catch_up(); }});
  if (!state.has_value()) {
    return state.error();
  }
  return Store(std::move(state).value());
}

namespace {

void check(const Case& one) {
  const auto broken = broken_rule(one);
  expects(!broken, broken ? broken->key + ": " + broken->why : "");
}

/// Runs `insert` or `rewrite`.
/// @param id  nullopt: a new one
int write(sqlite3* database, const char* sql, const Case& one, const std::optional<CaseId>& id) {
  const std::string scene = to_json(one.scene).dump();
  const std::string details = details_json(one).dump();
  Statement statement(database, sql);
  statement.bind(policy_column, static_cast<std::int64_t>(one.plan.policy))
      .bind(best_policy_column, static_cast<std::int64_t>(one.best))
      .bind(harm_column, one.harm)
      .bind(best_harm_column, one.best_harm)
      .bind(collision_loss_column, one.collision_loss)
      .bind(review_column, one.review)
      .bind(source_column, one.source)
      .bind(scene_column, scene)
      .bind(details_column, details);
  if (one.plan.target_speed) {
    statement.bind(target_speed_column, *one.plan.target_speed);
  }
  if (one.plan.strength) {
    statement.bind(strength_column, *one.plan.strength);
  }
  if (id) {
    statement.bind(id_parameter, *id);
  }
  return statement.step();
}

}  // namespace

Result<CaseId> Store::add(const Case& one) {
  check(one);
  if (state_->may_not_be_upgraded) {
    return *state_->may_not_be_upgraded;
  }
  sqlite3* const database = state_->database.get();
  if (write(database, insert, one, std::nullopt) != SQLITE_DONE) {
    return state_->problem(Access::write);
  }
  return CaseId{sqlite3_last_insert_rowid(database)};
}

Result<std::vector<CaseId>> Store::add_all(std::span<const Case> cases) {
  std::for_each(cases.begin(), cases.end(), check);
  if (state_->may_not_be_upgraded) {
    return *state_->may_not_be_upgraded;
  }
  sqlite3* const database = state_->database.get();
  std::vector<CaseId> ids;
  const auto add_in_turn = [&]() -> std::optional<Error> {
    const auto present = state_->integer("SELECT count(*) FROM cases");
    if (!present.has_value()) {
      return present.error();
    }
    std::set<CaseId> own;
    for (const Case& one : cases) {
      own.insert(one.id);
    }
    const bool keeps_ids =
        present.value() == 0 && own.size() == cases.size() && !own.empty() && *own.begin() > 0;
    for (const Case& one : cases) {
      const auto id = keeps_ids ? std::optional(one.id) : std::nullopt;
      if (write(database, insert, one, id) != SQLITE_DONE) {
        return state_->problem(Access::write);
      }
      ids.push_back(sqlite3_last_insert_rowid(database));
    }
    return std::nullopt;
  };
  if (auto error = state_->in_one_transaction(add_in_turn)) {
    return *std::move(error);
  }
  return ids;
}

Result<Learnt> Store::learn(const Case& one) {
  check(one);
  Learnt learnt;
  const auto learn_now = [&]() -> std::optional<Error> {
    if (auto error = state_->catch_up()) {
      return error;
    }
    std::optional<Case> same;
    if (const auto id = state_->experience.same_encounter_as(features(one.scene))) {
      auto found = find(*id);
      if (!found.has_value()) {
        return found.error();
      }
      same = std::move(found).value();  // unless somebody has deleted it
    }
    if (same && !contradict(*same, one)) {
      learnt = {.how = Learnt::How::merged, .id = same->id, .other = same->id};
      return update(merged(*same, one));
    }
    Case doubtful = one;
    if (same) {
      doubtful.trust = std::max(doubtful.trust, Trust::unchecked);
      same->trust = std::max(same->trust, Trust::unchecked);
      if (auto error = update(*same)) {
        return error;
      }
    }
    const auto id = add(doubtful);
    if (!id.has_value()) {
      return id.error();
    }
    learnt = same ? Learnt{Learnt::How::contradicted, id.value(), same->id}
                  : Learnt{Learnt::How::added, id.value(), 0};
    return std::nullopt;
  };
  if (auto error = state_->in_one_transaction(learn_now)) {
    state_->experience = {};  // it may know of what did not happen
    return *std::move(error);
  }
  return learnt;
}

std::optional<Error> Store::update(const Case& one) {
  check(one);
  if (state_->may_not_be_upgraded) {
    return *state_->may_not_be_upgraded;
  }
  sqlite3* const database = state_->database.get();
  if (write(database, rewrite, one, one.id) != SQLITE_DONE) {
    return state_->problem(Access::write);
  }
  if (sqlite3_changes(database) == 0) {
    return Error{Error::Code::out_of_range,
                 state_->name + ": there is no case " + std::to_string(one.id)};
  }
  if (one.id <= state_->experience.last_id()) {
    state_->experience.relearn(one);
  }
  return std::nullopt;
}

std::optional<Error> Store::forget(std::span<const CaseId> ids) {
  if (state_->may_not_be_upgraded) {
    return state_->may_not_be_upgraded;
  }
  const auto forget_all = [&]() -> std::optional<Error> {
    for (const CaseId id : ids) {
      Statement statement(state_->database.get(), remove_one);
      if (statement.bind(1, id).step() != SQLITE_DONE) {
        return state_->problem(Access::write);
      }
    }
    return std::nullopt;
  };
  if (auto error = state_->in_one_transaction(forget_all)) {
    return error;
  }
  state_->experience = {};  // what is left is read anew
  return state_->catch_up();
}

Result<std::vector<Case>> Store::all() {
  std::vector<Case> cases;
  if (auto error = state_->each_after(0, [&cases](Case one) { cases.push_back(std::move(one)); })) {
    return *error;
  }
  return cases;
}

Result<std::optional<Case>> Store::find(CaseId id) {
  Statement statement(state_->database.get(), select_one);
  switch (statement.bind(1, id).step()) {
    case SQLITE_ROW: {
      Result<Case> one = case_at(statement, state_->name);
      if (!one.has_value()) {
        return one.error();
      }
      return std::optional(std::move(one).value());
    }
    case SQLITE_DONE:
      return std::optional<Case>();
    default:
      return state_->problem(Access::read);
  }
}

namespace {

/// While it lives, the connection waits for another process no longer than a decision can.
class ShortPatience {
 public:
  explicit ShortPatience(sqlite3* database) : database_(database) {
    sqlite3_busy_timeout(database_, short_patience);
  }
  ShortPatience(const ShortPatience&) = delete;
  ShortPatience& operator=(const ShortPatience&) = delete;
  ~ShortPatience() { sqlite3_busy_timeout(database_, usual_patience); }

 private:
  sqlite3* database_;
};

}  // namespace

Result<std::optional<Match>> Store::recall(const world::Scene& scene) {
  const Features wanted = features(scene);
  expects(wanted.ego.usable, "the scene breaks no rule");
  const ShortPatience while_asking(state_->database.get());
  while (true) {
    if (auto error = state_->catch_up()) {
      return *error;
    }
    const auto recalled = state_->experience.recall(wanted);
    if (!recalled) {
      return std::optional<Match>();
    }
    Result<std::optional<Case>> found = find(recalled->nearest);
    if (!found.has_value()) {
      return found.error();
    }
    if (!found.value()) {
      state_->experience = {};  // somebody has deleted it: look again, at all
    } else if (found.value()->trust == Trust::quarantined) {
      state_->experience.pass_over(recalled->nearest);  // since it was read
    } else {
      return std::optional(Match{.found = *std::move(found).value(),
                                 .similarity = recalled->similarity,
                                 .policy = recalled->policy,
                                 .confidence = confidence_at(recalled->share),
                                 .trusted_confidence = confidence_at(recalled->trusted_share)});
    }
  }
}

Result<std::uint64_t> Store::digest() const {
  Statement statement(state_->database.get(), select_after);
  statement.bind(1, std::int64_t{0});
  Fnv hash;
  int code = statement.step();
  for (; code == SQLITE_ROW; code = statement.step()) {
    for (const Column column : all_columns) {
      hash.add(statement.text(column));
      hash.add(std::uint64_t{0x100});  // no character: where one column ends
    }
  }
  return code == SQLITE_DONE ? Result(hash.value()) : state_->problem(Access::read);
}

const Experience& Store::experience() const noexcept {
  return state_->experience;
}

std::size_t Store::size() const noexcept {
  return state_->experience.size();
}

}  // namespace saca::memory
