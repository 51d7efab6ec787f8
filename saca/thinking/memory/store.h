#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/base/world/scene.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/memory/experience.h"
#include "saca/thinking/memory/learning.h"

namespace saca::memory {

class CaseTable;

/// What the paper's Algorithm 1 does with what memory speaks for.
enum class Gate : std::uint8_t {
  cache,   ///< above 0.90: its plan is used as it is
  check,   ///< above 0.70: its plan is used if a rollout confirms it
  reason,  ///< the language model is asked
};

[[nodiscard]] Gate gate(double confidence) noexcept;

/// What the stored cases speak for in a scene.
struct Match {
  Case found;               ///< the most alike in which the policy was as good as the best
  double similarity = 0.0;  ///< of its scene, in [0, 1]
  manoeuvre::PolicyId policy = manoeuvre::PolicyId::aeb;  ///< that they speak for
  double confidence = 0.0;          ///< how far it can be relied on, in [0, 1] (confidence_at)
  double trusted_confidence = 0.0;  ///< by trusted cases alone
};

/// The gate of its confidence; what trusted cases alone do not support is not used unchecked.
[[nodiscard]] Gate gate(const Match& match) noexcept;

/// Is a bank of this name on a PostgreSQL server, and in no file?
[[nodiscard]] bool is_on_a_server(std::string_view place) noexcept;

/// The memory bank: one SQLite file, or two tables on a PostgreSQL server
/// ("postgresql://USER@HOST/DATABASE"), which several processes may have open.
///
/// One thread at a time. It waits for disk or network, and for another process (then: too_late) up
/// to 5 s, `recall` some tenths of a second, so it belongs to the thinking plane. What other
/// processes add is seen by the next call; what they change of a case, when it is the one that is
/// served or learnt into, or when the bank is opened anew. Movable, not copyable. Table and
/// versions: docs/formats.md.
///
/// Every error names the bank, without a password, and, where one row is at fault, table, id and
/// key.
class Store {
 public:
  /// Opens the bank, or makes it where there is none. Its features are read into memory, so a
  /// damaged row is told here.
  ///
  /// A bank of an older version is brought to the newest. One that may only be read, such as a
  /// server's replica, is opened for reading: `add` then returns unwritable.
  /// @param car  that asks: cases that another car was worked out with are not trusted by it
  ///             (is_trusted_by); empty: no matter which
  /// @return  unreadable when it cannot be opened; malformed when it is damaged, is no memory bank,
  ///          has another version, or a row cannot be used
  [[nodiscard]] static Result<Store> open(const std::string& place, std::vector<MadeWith> car = {});

  /// Likewise for any car, but makes none.
  /// @return  unreadable where there is none
  [[nodiscard]] static Result<Store> open_existing(const std::string& place);

  /// Copies what an existing bank holds now, to ask it as often as wanted: what anybody adds to it
  /// later is not seen, and `add` returns unwritable.
  /// @return  unreadable when there is no such bank; else as `open`
  [[nodiscard]] static Result<Store> snapshot(const std::string& place,
                                              std::vector<MadeWith> car = {});

  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;
  ~Store();

  /// Puts a case on the disk. When this returns an id, the case outlives a killed process and a
  /// lost power supply; when it returns an error, the bank is as it was before, but where the
  /// message says that this is not known: a server was lost at the end, and did not come back.
  ///
  /// @param one  its `id` is not looked at
  /// @return     the id given to it; unwritable when the disk is full or the bank read-only
  /// @throws ContractViolation  if the case or its scene breaks a rule
  [[nodiscard]] Result<match::CaseId> add(const Case& one);

  /// Adds what was met, as `add`, or merges it into the nearest stored case that is the same
  /// encounter of the same car and does not contradict it (`merged`). Where each of these
  /// contradicts it, it is added, and it and the nearest are marked unchecked. All of it happens or
  /// nothing; who is quarantined is the same as nothing.
  [[nodiscard]] Result<LearningResult> learn(const Case& one);

  /// Puts all of them on the disk, as `add`, or none. Where the bank is empty they keep their ids,
  /// if these are positive, leave room for new ones, and each comes once; else they get new ones.
  /// @return  the ids given, in their order
  [[nodiscard]] Result<std::vector<match::CaseId>> add_all(std::span<const Case> cases);

  /// As `add_all` where the bank is empty, and nothing where somebody has put a case into it.
  [[nodiscard]] std::optional<Error> begin_with(std::span<const Case> cases);

  /// As `add_all`, but leaves out what the bank has already when nobody else can write, and what
  /// comes twice.
  /// @param key_of  cases of the same key are the same case
  /// @return        the ids given to the others, in their order
  using KeyOf = std::function<std::string(const Case& one)>;
  [[nodiscard]] Result<std::vector<match::CaseId>> add_new(std::span<const Case> cases,
                                                           const KeyOf& key_of);

  /// Writes again what was learnt of a case since, as it is then; nobody else writes meanwhile.
  /// @param change  gets the case as it is now; its scene and id stay. False: it is left as it was.
  ///                May be asked again where the first try did not happen
  /// @return  what went wrong; nothing where somebody has deleted it
  /// @throws ContractViolation  as `add`
  using Change = std::function<bool(Case& one)>;
  [[nodiscard]] std::optional<Error> change(match::CaseId id, const Change& change);

  /// Forgets these cases, all or none, but for those that are not as they were read: somebody has
  /// learnt of them since. Who is not there is none to forget.
  /// @param as_read  as `all` or `find` gave them
  /// @return  how many stay; unwritable; or what `open` would say of what is left
  [[nodiscard]] Result<std::size_t> forget(std::span<const Case> as_read);

  /// All cases, oldest first.
  [[nodiscard]] Result<std::vector<Case>> all();

  /// @return  nullopt when there is no case of this id
  [[nodiscard]] Result<std::optional<Case>> find(match::CaseId id);

  /// What cases like this scene speak for (Experience::recall); nullopt when there is none. A
  /// search in memory, then one row is read. Where that is not as it was read before, it is asked
  /// as it is now; where somebody has quarantined or deleted it, it is passed over: then the search
  /// begins anew, at most 100 times, after which there is none.
  /// @throws ContractViolation  if the scene breaks a rule of `world::broken_rule`
  [[nodiscard]] Result<std::optional<Match>> recall(const world::Scene& scene);

  /// Looks at what was added since, by itself too; `recall` and `learn` begin with it.
  /// @return  what `open` would say of a new row that cannot be used
  [[nodiscard]] std::optional<Error> catch_up();

  /// What was met, as of when the file was last looked at; changes with the next call.
  [[nodiscard]] const Experience& experience() const noexcept;

  /// Of all cases, to the last bit: two memories with the same digest answer alike.
  [[nodiscard]] Result<std::uint64_t> digest() const;

  /// How many cases were in the file when it was last looked at.
  [[nodiscard]] std::size_t size() const noexcept;

  /// As people know it, for messages.
  [[nodiscard]] const std::string& name() const noexcept;

 private:
  struct State;
  explicit Store(std::unique_ptr<State> state);
  [[nodiscard]] static Result<Store> with(Result<std::unique_ptr<CaseTable>> table,
                                          std::vector<MadeWith> car);

  enum class Adding : std::uint8_t { new_ids, own_ids_where_empty, only_where_empty };
  [[nodiscard]] Result<std::vector<match::CaseId>> add_in_turn(std::span<const Case> cases,
                                                               Adding how);
  /// In a transaction; adds the ids given to them.
  [[nodiscard]] std::optional<Error> insert_all(std::span<const Case> cases, bool with_own_ids,
                                                std::vector<match::CaseId>& ids);
  /// In a transaction; as learn().
  [[nodiscard]] Result<LearningResult> learn_now(const Case& one);

  std::unique_ptr<State> state_;
};

}  // namespace saca::memory
