#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "saca/base/core/result.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/memory/case_row.h"

namespace saca::memory {

/// How long an operation on a bank waits for other processes, disk or network before it gives up.
constexpr std::chrono::milliseconds usual_patience{5'000};
/// Likewise where a decision waits for the answer: longer than another's commit takes.
constexpr std::chrono::milliseconds short_patience{200};

/// What failed.
enum class Access : std::uint8_t { read, write };

/// Where the rows of a memory bank lie: a file, or a server's table. One thread at a time.
///
/// Every error names the bank as people know it. Whoever else adds to the bank does it in the order
/// of ids: who has read all ids after one misses none.
class CaseTable {
 public:
  CaseTable() = default;
  CaseTable(const CaseTable&) = delete;
  CaseTable& operator=(const CaseTable&) = delete;
  virtual ~CaseTable() = default;

  /// As people know it: without a password.
  [[nodiscard]] virtual const std::string& name() const noexcept = 0;

  /// From now on no operation waits for longer; at first usual_patience.
  virtual void wait_at_most(std::chrono::milliseconds patience) = 0;

  /// What is done with a row; an error ends the reading.
  using Take = std::function<std::optional<Error>(match::CaseId, Cells)>;
  /// Every row whose id is greater, in the order of ids.
  [[nodiscard]] virtual std::optional<Error> each_after(match::CaseId last, const Take& take) = 0;
  /// @return  nullopt: there is no row of this id
  [[nodiscard]] virtual Result<std::optional<Cells>> find(match::CaseId id) = 0;

  using Work = std::function<std::optional<Error>()>;
  /// All that `work` does happens, or nothing; meanwhile nobody else writes. When this returns
  /// nothing, all of it outlives a killed process and a lost power supply.
  /// @param work  returns what went wrong; may be done again where the first try did not happen
  [[nodiscard]] virtual std::optional<Error> in_one_transaction(const Work& work) = 0;

  // In a transaction only.

  [[nodiscard]] virtual Result<bool> is_empty() = 0;
  /// @param id  nullopt: a new one, greater than all before
  /// @return    the id
  [[nodiscard]] virtual Result<match::CaseId> insert(const Cells& cells,
                                                     std::optional<match::CaseId> id) = 0;
  /// @return  false: there is no row of this id
  [[nodiscard]] virtual Result<bool> rewrite(match::CaseId id, const Cells& cells) = 0;
  /// Whether there is a row of this id or not.
  [[nodiscard]] virtual std::optional<Error> remove(match::CaseId id) = 0;
};

}  // namespace saca::memory
