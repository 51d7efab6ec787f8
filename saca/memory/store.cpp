#include "saca/memory/store.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saca/config/json_text.h"
#include "saca/core/contract.h"
#include "saca/core/fnv.h"
#include "saca/core/printable.h"
#include "saca/memory/feature_index.h"
#include "saca/memory/scene_json.h"
#include "saca/memory/similarity.h"
#include "saca/memory/sqlite.h"

namespace saca::memory {
namespace {

constexpr std::int64_t application_id = 0x53414341;  // "SACA"
constexpr std::int64_t version = 2;
constexpr std::int64_t version_without_strengths = 1;

// synchronous = EXTRA: with FULL, a power cut just after a commit may bring back the journal and
// with it the state before. A rollback journal, not WAL: one file, readable where nothing may be
// written. The last two are SQLite's advice for files that somebody else may have damaged.
constexpr const char* set_up =
    "PRAGMA journal_mode = DELETE; PRAGMA synchronous = EXTRA;"
    "PRAGMA trusted_schema = OFF; PRAGMA cell_size_check = ON;";

// As SQLite keeps it, also of a table that got its last column later.
std::string table_of_cases(bool with_strengths) {
  return std::string(
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
             " scene TEXT NOT NULL") +
         (with_strengths ? ", strength REAL" : "") + ") STRICT";
}
// SQLite's own, for AUTOINCREMENT.
constexpr const char* table_of_ids = "CREATE TABLE sqlite_sequence(name,seq)";

std::string create() {
  return table_of_cases(true) +
         ";PRAGMA application_id = 1396785985;"
         "PRAGMA user_version = 2;";
}

constexpr const char* add_strengths =
    "ALTER TABLE cases ADD COLUMN strength REAL; PRAGMA user_version = 2;";
// Before the table of the same name when a statement looks for one, in this connection only.
constexpr const char* view_with_strengths =
    "PRAGMA temp_store = MEMORY;"
    "CREATE TEMP VIEW cases AS SELECT *, NULL AS strength FROM main.cases;";

constexpr const char* insert =
    "INSERT INTO cases (policy, target_speed_mps, best_policy, harm, best_harm, collision_loss,"
    " review, source, scene, strength) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10)";

// In the order of `Column`.
constexpr const char* select_after =
    "SELECT id, policy, target_speed_mps, best_policy, harm, best_harm, collision_loss, review,"
    " source, scene, strength FROM cases WHERE id > ?1 ORDER BY id";
constexpr const char* select_one =
    "SELECT id, policy, target_speed_mps, best_policy, harm, best_harm, collision_loss, review,"
    " source, scene, strength FROM cases WHERE id = ?1";

/// Also the number of its parameter in `insert`.
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
};

constexpr std::array all_columns{
    id_column,     policy_column,    target_speed_column,   best_policy_column,
    harm_column,   best_harm_column, collision_loss_column, review_column,
    source_column, scene_column,     strength_column};

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

  void reject(Column column, const std::string& why) {
    if (!problem_) {
      problem_ = Error{Error::Code::malformed, file_ + ": table cases, id " +
                                                   std::to_string(statement_.integer(id_column)) +
                                                   ": " + statement_.name(column) + ": " + why};
    }
  }

  [[nodiscard]] const std::optional<Error>& problem() const { return problem_; }

 private:
  const Statement& statement_;
  const std::string& file_;
  std::optional<Error> problem_;
};

bool is_strength(const manoeuvre::Plan& plan) {
  return manoeuvre::takes_strength(plan.policy) && *plan.strength > 0.0 && *plan.strength <= 1.0;
}

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
  if (one.plan.target_speed && !manoeuvre::brakes_to_speed(one.plan.policy)) {
    row.reject(target_speed_column, "only policies 3 and 4 have one");
  }
  if (one.plan.strength && !is_strength(one.plan)) {
    row.reject(strength_column, "only policy 0 has one, of at most 1");
  }
  if (row.problem()) {
    return *row.problem();
  }
  return one;
}

bool is_amount(double number) {
  return std::isfinite(number) && number >= 0.0;
}

}  // namespace

Gate gate(double similarity) noexcept {
  if (similarity > 0.90) {
    return Gate::cache;
  }
  return similarity > 0.70 ? Gate::check : Gate::reason;
}

struct Store::State {
  Database database;
  std::string name;  ///< of the file, as the caller gave it

  std::optional<Error> may_not_be_upgraded;  ///< why a file of the version before stays as it is

  FeatureIndex index;  ///< of the cases that were in the file when it was last looked at

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

  /// In one transaction, unless another process was faster and it is not needed any more.
  template <class IsNeeded>
  [[nodiscard]] std::optional<Error> run_where_needed(const char* statements,
                                                      IsNeeded is_needed) const {
    if (auto error = run("BEGIN IMMEDIATE", Access::write)) {
      return error;
    }
    const Result<bool> needed = is_needed();
    auto error = needed.has_value() ? std::nullopt : std::optional(needed.error());
    if (!error && needed.value()) {
      error = run(statements, Access::write);
    }
    if (!error) {
      error = run("COMMIT", Access::write);
    }
    if (error) {
      (void)run("ROLLBACK", Access::write);
    }
    return error;
  }

  /// The first thing in the schema that our statements do not make: a view, a trigger, an index or
  /// a rule of somebody else could change what ours do.
  [[nodiscard]] std::optional<Error> foreign_schema(bool with_strengths) const {
    std::vector<std::string> missing{table_of_cases(with_strengths), table_of_ids};
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
    if (found.value() != version && found.value() != version_without_strengths) {
      return Error{Error::Code::malformed, name + ": want version " + std::to_string(version) +
                                               ", got version " + std::to_string(found.value())};
    }
    if (auto foreign = foreign_schema(found.value() == version)) {
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

  /// A file of the version before gets the column that it lacks; one that may only be read is read
  /// as if it had it.
  [[nodiscard]] std::optional<Error> learn_strengths() {
    const auto found = integer("PRAGMA user_version");
    if (!found.has_value() || found.value() == version) {
      return found.has_value() ? std::nullopt : std::optional(found.error());
    }
    auto error = upgrade();
    if (error && error->code == Error::Code::unwritable) {
      may_not_be_upgraded = std::exchange(error, run(view_with_strengths, Access::read));
    }
    return error;
  }

  [[nodiscard]] std::optional<Error> upgrade() const {
    return run_where_needed(add_strengths, [this]() -> Result<bool> {
      const auto found = integer("PRAGMA user_version");
      if (!found.has_value()) {
        return found.error();
      }
      return found.value() != version;
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
    return each_after(index.last_id(), [this](const Case& one) { index.add(one.id, one.scene); });
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
       [](State& s) { return s.learn_strengths(); }, [](State& s) { return s.catch_up(); }});
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
       [](State& s) { return s.learn_strengths(); },
       [](State& s) { return s.run("PRAGMA query_only = ON", Access::read); },
       [](State& s) { return s.catch_up(); }});
  if (!state.has_value()) {
    return state.error();
  }
  return Store(std::move(state).value());
}

Result<CaseId> Store::add(const Case& one) {
  expects(is_amount(one.harm), "harm is finite and >= 0");
  expects(is_amount(one.best_harm), "best_harm is finite and >= 0");
  expects(is_amount(one.collision_loss), "collision_loss is finite and >= 0");
  expects(!one.plan.target_speed ||
              (is_amount(*one.plan.target_speed) && manoeuvre::brakes_to_speed(one.plan.policy)),
          "only policies 3 and 4 have a target_speed, finite and >= 0");
  expects(!one.plan.strength || is_strength(one.plan),
          "only policy 0 has a strength, of at most 1");
  if (state_->may_not_be_upgraded) {
    return *state_->may_not_be_upgraded;
  }
  const std::string scene = to_json(one.scene).dump();

  Statement statement(state_->database.get(), insert);
  statement.bind(policy_column, static_cast<std::int64_t>(one.plan.policy))
      .bind(best_policy_column, static_cast<std::int64_t>(one.best))
      .bind(harm_column, one.harm)
      .bind(best_harm_column, one.best_harm)
      .bind(collision_loss_column, one.collision_loss)
      .bind(review_column, one.review)
      .bind(source_column, one.source)
      .bind(scene_column, scene);
  if (one.plan.target_speed) {
    statement.bind(target_speed_column, *one.plan.target_speed);
  }
  if (one.plan.strength) {
    statement.bind(strength_column, *one.plan.strength);
  }
  if (statement.step() != SQLITE_DONE) {
    return state_->problem(Access::write);
  }
  return CaseId{sqlite3_last_insert_rowid(state_->database.get())};
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

Result<std::optional<Match>> Store::nearest(const world::Scene& scene) {
  const Features wanted = features(scene);
  expects(wanted.ego.usable, "the scene breaks no rule");
  const ShortPatience while_asking(state_->database.get());
  while (true) {
    if (auto error = state_->catch_up()) {
      return *error;
    }
    const auto best = state_->index.nearest(wanted);
    if (!best) {
      return std::optional<Match>();
    }
    Result<std::optional<Case>> found = find(best->id);
    if (!found.has_value()) {
      return found.error();
    }
    if (found.value()) {
      return std::optional(Match{*std::move(found).value(), similarity_at(best->difference)});
    }
    state_->index = {};  // somebody has deleted it: look again, at all
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

std::size_t Store::size() const noexcept {
  return state_->index.size();
}

}  // namespace saca::memory
