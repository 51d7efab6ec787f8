// Longer than 400 lines: one class, whose operations keep one promise: what was learnt is on the
// disk or was refused.
#include "saca/thinking/memory/store.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/base/core/fnv.h"
#include "saca/onboard/match/similarity.h"
#include "saca/thinking/memory/case_row.h"
#include "saca/thinking/memory/case_table.h"
#include "saca/thinking/memory/experience.h"
#include "saca/thinking/memory/postgres.h"
#include "saca/thinking/memory/postgres_table.h"
#include "saca/thinking/memory/sqlite_table.h"

namespace saca::memory {

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
  std::unique_ptr<CaseTable> table;
  Experience experience;     ///< of the cases that were there when it was last looked at
  bool has_deleted = false;  ///< some of them are no longer there: they are passed over

  [[nodiscard]] std::optional<Error> each_after(match::CaseId last,
                                                const std::function<void(Case)>& take) const {
    return table->each_after(last,
                             [&](match::CaseId id, const Cells& cells) -> std::optional<Error> {
                               auto one = case_from_cells(id, cells, table->name());
                               if (!one.has_value()) {
                                 return one.error();
                               }
                               take(std::move(one).value());
                               return std::nullopt;
                             });
  }

  /// Forgets all that it knows, and reads what is there.
  [[nodiscard]] std::optional<Error> read_anew() {
    experience.clear();
    has_deleted = false;
    return catch_up();
  }

  /// Learns the features of cases that it does not know yet.
  [[nodiscard]] std::optional<Error> catch_up() {
    return each_after(experience.last_id(), [this](const Case& one) { experience.add(one); });
  }

  /// In a transaction; of a row that is there.
  [[nodiscard]] std::optional<Error> rewrite(const Case& one) const {
    const auto written = table->rewrite(one.id, cells_of(one));
    return written.has_value() ? std::nullopt : std::optional(written.error());
  }

  void relearn(const Case& one) {
    if (one.id <= experience.last_id()) {
      experience.relearn(one);
    }
  }

  /// As rewrite().
  [[nodiscard]] std::optional<Error> rewrite_and_relearn(const Case& one) {
    auto error = rewrite(one);
    if (!error) {
      relearn(one);
    }
    return error;
  }
};

Store::Store(std::unique_ptr<State> state) : state_(std::move(state)) {}
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;
Store::~Store() = default;

namespace {

std::optional<Error> missing_file(const std::string& place) {
  std::error_code problem;
  return std::filesystem::exists(place, problem) ? std::nullopt
                                                 : std::optional(no_such_bank(place));
}

}  // namespace

bool is_on_a_server(std::string_view place) noexcept {
  return is_postgres_url(place);
}

Result<Store> Store::with(Result<std::unique_ptr<CaseTable>> table, std::vector<MadeWith> car) {
  if (!table.has_value()) {
    return table.error();
  }
  auto state = std::make_unique<State>();
  state->table = std::move(table).value();
  state->experience = Experience::for_car(std::move(car));
  if (auto error = state->catch_up()) {
    return *std::move(error);
  }
  return Store(std::move(state));
}

Result<Store> Store::open(const std::string& place, std::vector<MadeWith> car) {
  return with(is_on_a_server(place) ? open_postgres(place, IfMissing::make) : open_sqlite(place),
              std::move(car));
}

Result<Store> Store::open_existing(const std::string& place) {
  if (is_on_a_server(place)) {
    return with(open_postgres(place, IfMissing::refuse), {});
  }
  auto missing = missing_file(place);
  return missing ? *std::move(missing) : open(place);
}

Result<Store> Store::snapshot(const std::string& place, std::vector<MadeWith> car) {
  if (!is_on_a_server(place)) {
    auto missing = missing_file(place);
    return missing ? *std::move(missing) : with(copy_of_sqlite(place), std::move(car));
  }
  const auto table = open_postgres(place, IfMissing::refuse);
  return table.has_value() ? with(copy_of(*table.value()), std::move(car)) : table.error();
}

namespace {

void check(const Case& one) {
  const auto broken = broken_rule(one);
  expects(!broken, broken ? broken->key + ": " + broken->why : "");
}

}  // namespace

Result<match::CaseId> Store::add(const Case& one) {
  const auto ids = add_in_turn({&one, 1}, Adding::new_ids);
  return ids.has_value() ? Result(ids.value().front()) : ids.error();
}

namespace {

/// Ids that a bank can keep: each comes once, and there is room for new ones.
bool are_ids(std::span<const Case> cases) {
  constexpr match::CaseId most = std::numeric_limits<match::CaseId>::max() / 2;
  std::set<match::CaseId> own;
  for (const Case& one : cases) {
    own.insert(one.id);
  }
  return own.size() == cases.size() && !own.empty() && *own.begin() > 0 && *own.rbegin() <= most;
}

}  // namespace

Result<std::vector<match::CaseId>> Store::add_all(std::span<const Case> cases) {
  return add_in_turn(cases, are_ids(cases) ? Adding::own_ids_where_empty : Adding::new_ids);
}

std::optional<Error> Store::begin_with(std::span<const Case> cases) {
  expects(are_ids(cases), "each has an id of its own");
  const auto ids = add_in_turn(cases, Adding::only_where_empty);
  return ids.has_value() ? std::nullopt : std::optional(ids.error());
}

Result<std::vector<match::CaseId>> Store::add_in_turn(std::span<const Case> cases, Adding how) {
  std::for_each(cases.begin(), cases.end(), check);
  CaseTable& table = *state_->table;
  std::vector<match::CaseId> ids;
  auto error = table.in_one_transaction([&]() -> std::optional<Error> {
    ids.clear();
    const auto is_empty = how == Adding::new_ids ? Result(false) : table.is_empty();
    if (!is_empty.has_value()) {
      return is_empty.error();
    }
    if (how == Adding::only_where_empty && !is_empty.value()) {
      return std::nullopt;
    }
    return insert_all(cases, is_empty.value(), ids);
  });
  if (error) {
    return *std::move(error);
  }
  return ids;
}

std::optional<Error> Store::insert_all(std::span<const Case> cases, bool with_own_ids,
                                       std::vector<match::CaseId>& ids) {
  for (const Case& one : cases) {
    const auto id =
        state_->table->insert(cells_of(one), with_own_ids ? std::optional(one.id) : std::nullopt);
    if (!id.has_value()) {
      return id.error();
    }
    ids.push_back(id.value());
  }
  return std::nullopt;
}

Result<std::vector<match::CaseId>> Store::add_new(std::span<const Case> cases,
                                                  const KeyOf& key_of) {
  std::for_each(cases.begin(), cases.end(), check);
  std::vector<match::CaseId> ids;
  auto error = state_->table->in_one_transaction([&]() -> std::optional<Error> {
    ids.clear();
    std::set<std::string> keys;
    if (auto unread = state_->each_after(0, [&](const Case& one) { keys.insert(key_of(one)); })) {
      return unread;
    }
    const bool is_empty = keys.empty();
    std::vector<Case> fresh;
    std::copy_if(cases.begin(), cases.end(), std::back_inserter(fresh),
                 [&](const Case& one) { return keys.insert(key_of(one)).second; });
    return insert_all(fresh, is_empty && are_ids(fresh), ids);
  });
  if (error) {
    return *std::move(error);
  }
  return ids;
}

Result<LearningResult> Store::learn_now(const Case& one) {
  if (auto error = state_->catch_up()) {
    return *std::move(error);
  }
  std::optional<Case> doubted;  // the nearest that contradicts it
  for (const match::CaseId id : state_->experience.same_encounter_as(match::features(one.scene))) {
    auto found = find(id);
    if (!found.has_value()) {
      return found.error();
    }
    if (!found.value()) {
      continue;  // somebody has deleted it
    }
    Case known = *std::move(found).value();
    if (known.trust == Trust::quarantined) {  // since it was read
      state_->experience.pass_over(id);
    } else if (!may_be_the_same_car(known.made_with, one.made_with)) {
      continue;
    } else if (!contradict(known, one)) {
      auto error = state_->rewrite_and_relearn(merged(known, one));
      return error ? Result<LearningResult>(*std::move(error))
                   : LearningResult{.how = LearningResult::How::merged, .id = id, .other = id};
    } else if (!doubted) {
      doubted = std::move(known);
    }
  }
  Case added = one;
  if (doubted) {
    added.trust = std::max(added.trust, Trust::unchecked);
    doubted->trust = std::max(doubted->trust, Trust::unchecked);
    if (auto error = state_->rewrite_and_relearn(*doubted)) {
      return *std::move(error);
    }
  }
  const auto id = state_->table->insert(cells_of(added), std::nullopt);
  if (!id.has_value()) {
    return id.error();
  }
  return doubted ? LearningResult{LearningResult::How::contradicted, id.value(), doubted->id}
                 : LearningResult{LearningResult::How::added, id.value(), 0};
}

Result<LearningResult> Store::learn(const Case& one) {
  check(one);
  if (state_->has_deleted) {
    if (auto unread = state_->read_anew()) {
      return *std::move(unread);
    }
  }
  LearningResult learnt;
  auto error = state_->table->in_one_transaction([&]() -> std::optional<Error> {
    const auto done = learn_now(one);
    if (!done.has_value()) {
      return done.error();
    }
    learnt = done.value();
    return std::nullopt;
  });
  if (error) {
    state_->experience.clear();  // it may know of what did not happen
    return *std::move(error);
  }
  return learnt;
}

std::optional<Error> Store::change(match::CaseId id, const Change& change) {
  std::optional<Case> changed;
  auto error = state_->table->in_one_transaction([&]() -> std::optional<Error> {
    changed.reset();
    auto found = find(id);
    if (!found.has_value() || !found.value()) {
      return found.has_value() ? std::nullopt : std::optional(found.error());
    }
    Case one = *std::move(found).value();
    const world::Scene scene = one.scene;
    if (!change(one)) {
      return std::nullopt;
    }
    one.id = id;
    one.scene = scene;
    check(one);
    changed = std::move(one);
    return state_->rewrite(*changed);
  });
  if (!error && changed) {
    state_->relearn(*changed);
  }
  return error;
}

Result<std::size_t> Store::forget(std::span<const Case> as_read) {
  std::size_t changed = 0;
  const auto forget_all = [&]() -> std::optional<Error> {
    changed = 0;
    for (const Case& one : as_read) {
      const auto now = find(one.id);
      if (!now.has_value()) {
        return now.error();
      }
      if (!now.value()) {
        continue;
      }
      if (cells_of(*now.value()) != cells_of(one)) {
        ++changed;
      } else if (auto error = state_->table->remove(one.id)) {
        return error;
      }
    }
    return std::nullopt;
  };
  auto error = state_->table->in_one_transaction(forget_all);
  if (!error) {
    error = state_->read_anew();
  }
  return error ? Result<std::size_t>(*std::move(error)) : changed;
}

Result<std::vector<Case>> Store::all() {
  std::vector<Case> cases;
  if (auto error = state_->each_after(0, [&cases](Case one) { cases.push_back(std::move(one)); })) {
    return *error;
  }
  return cases;
}

Result<std::optional<Case>> Store::find(match::CaseId id) {
  const auto cells = state_->table->find(id);
  if (!cells.has_value()) {
    return cells.error();
  }
  if (!cells.value()) {
    return std::optional<Case>();
  }
  auto one = case_from_cells(id, *cells.value(), state_->table->name());
  return one.has_value() ? Result(std::optional(std::move(one).value())) : one.error();
}

namespace {

/// While it lives, the table waits for nobody longer than a decision can.
class ShortPatience {
 public:
  explicit ShortPatience(CaseTable& table) : table_(table) { table_.wait_at_most(short_patience); }
  ShortPatience(const ShortPatience&) = delete;
  ShortPatience& operator=(const ShortPatience&) = delete;
  ~ShortPatience() { table_.wait_at_most(usual_patience); }

 private:
  CaseTable& table_;
};

}  // namespace

Result<std::optional<Match>> Store::recall(const world::Scene& scene) {
  const match::Features wanted = match::features(scene);
  expects(wanted.ego.usable, "the scene breaks no rule");
  const ShortPatience while_asking(*state_->table);
  constexpr int most_rounds = 100;  // each may wait for a server, and a decision waits for all
  for (int round = 0; round < most_rounds; ++round) {
    if (auto error = state_->catch_up()) {
      return *error;
    }
    Experience& experience = state_->experience;
    const auto recalled = experience.recall(wanted);
    if (!recalled) {
      return std::optional<Match>();
    }
    Result<std::optional<Case>> found = find(recalled->nearest);
    if (!found.has_value()) {
      return found.error();
    }
    // What somebody has done to it since it was read:
    if (!found.value()) {
      experience.pass_over(recalled->nearest);
      state_->has_deleted = true;
    } else if (found.value()->trust == Trust::quarantined ||
               !experience.is_known_as(*found.value())) {
      experience.relearn(*found.value());
    } else {
      return std::optional(Match{.found = *std::move(found).value(),
                                 .similarity = recalled->similarity,
                                 .policy = recalled->policy,
                                 .confidence = confidence_at(recalled->share),
                                 .trusted_confidence = confidence_at(recalled->trusted_share)});
    }
  }
  return std::optional<Match>();
}

Result<std::uint64_t> Store::digest() const {
  Fnv hash;
  const auto add = [&hash](const std::string& text) {
    hash.add(text);
    hash.add(std::uint64_t{0x100});  // no character: where one column ends
  };
  auto error = state_->table->each_after(
      0, [&](match::CaseId id, const Cells& cells) -> std::optional<Error> {
        add(std::to_string(id));
        for (const Cell& cell : cells) {
          add(text_of(cell));
        }
        return std::nullopt;
      });
  if (error) {
    return *std::move(error);
  }
  return hash.value();
}

std::optional<Error> Store::catch_up() {
  return state_->catch_up();
}

const std::string& Store::name() const noexcept {
  return state_->table->name();
}

const Experience& Store::experience() const noexcept {
  return state_->experience;
}

std::size_t Store::size() const noexcept {
  return state_->experience.size();
}

}  // namespace saca::memory
