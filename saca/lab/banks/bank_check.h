#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/banks/bank_files.h"
#include "saca/lab/banks/case_tools.h"
#include "saca/lab/long_work/progress.h"
#include "saca/thinking/memory/case.h"

namespace saca::banks {

/// What checking a bank came to, in cases.
struct BankCheck {
  std::string bank;   ///< its name
  int confirmed = 0;  ///< trusted from now on
  int open = 0;       ///< as they were
  int refuted = 0;    ///< quarantined from now on
  // Of those that another car trusts, which stay as they are:
  int added = 0;             ///< confirmed; the bank has one for this car besides from now on
  int refuted_for_this = 0;  ///< refuted for this car alone
};

/// Which cases are looked at besides those that this car does not trust yet.
enum class Quarantined {
  left_alone,
  checked_too,  ///< what holds over draws is served again
};

struct BankCheckOptions {
  Quarantined quarantined = Quarantined::left_alone;
  int threads = 1;  ///< they do not change the result
  long_work::ProgressDisplay display = long_work::ProgressDisplay::shown;
};

/// Which of a bank's cases are to be checked. Of what another car trusts those are left out that
/// the bank has for this car already.
[[nodiscard]] std::vector<memory::Case> cases_to_check(std::vector<memory::Case> cases,
                                                       const CaseTools& tools,
                                                       Quarantined quarantined);

/// Rolls out what is not trusted (case_check.h) and keeps in the bank what is known from now on,
/// with progress on the error stream. It ends early at an interrupt; what was worked out is kept.
/// A case that another process has changed meanwhile stays as it is. So does a case that another
/// car trusts, whatever comes of it: where it is confirmed, one for this car is added in the end.
/// @return  what the bank could not do
[[nodiscard]] Result<BankCheck> check(ReadBank& bank, const CaseTools& tools,
                                      const BankCheckOptions& options);

/// What `saca memory check` prints: schema "saca.memory_check/1", and for people.
/// @param car  as the command line names it
[[nodiscard]] nlohmann::json json_of(const BankCheck& check, const std::string& car);
[[nodiscard]] std::string text_of(const BankCheck& check);

}  // namespace saca::banks
