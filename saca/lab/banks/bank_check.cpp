#include "saca/lab/banks/bank_check.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "saca/base/core/clock.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/banks/case_check.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/thinking/memory/case_json.h"

namespace saca::banks {
namespace {

constexpr std::size_t checked_at_once = 32;

/// Puts into the bank what is now known of a case, unless another process has learnt of it
/// meanwhile: it is checked the next time.
/// @return  what the case now is worth
Result<memory::Trust> keep_checked(memory::Store& store, const memory::Case& before,
                                   const std::optional<memory::Case>& checked) {
  auto trust = memory::Trust::unchecked;
  if (!checked) {
    return trust;
  }
  const auto keep = [&](memory::Case& now) {
    if (memory::to_json(now) != memory::to_json(before)) {
      return false;
    }
    now = *checked;
    trust = now.trust;
    return true;
  };
  if (auto problem = store.change(checked->id, keep)) {
    return *std::move(problem);
  }
  return trust;
}

void count_trust(BankCheck& check, memory::Trust trust) {
  switch (trust) {
    case memory::Trust::trusted:
      ++check.confirmed;
      break;
    case memory::Trust::unchecked:
      ++check.open;
      break;
    case memory::Trust::quarantined:
      ++check.refuted;
      break;
  }
}

}  // namespace

std::vector<memory::Case> cases_to_check(std::vector<memory::Case> cases, const CaseTools& tools,
                                         Quarantined quarantined) {
  std::erase_if(cases, [&](const memory::Case& one) {
    return one.trust == memory::Trust::quarantined ? quarantined == Quarantined::left_alone
                                                   : memory::is_trusted_by(tools.made_with, one);
  });
  return cases;
}

Result<BankCheck> check(ReadBank& bank, const CaseTools& tools, const BankCheckOptions& options) {
  const std::vector<memory::Case> cases =
      cases_to_check(std::move(bank.cases), tools, options.quarantined);
  SteadyClock clock;
  long_work::ProgressLine progress("cases", static_cast<int>(cases.size()), clock, options.display);
  BankCheck counts{.bank = bank.store.name()};
  for (std::size_t first = 0; first < cases.size() && !long_work::interrupted();
       first += checked_at_once) {
    std::vector<std::optional<memory::Case>> results(
        std::min(checked_at_once, cases.size() - first));
    in_parallel(results.size(), options.threads, [&](std::size_t i) {
      results[i] =
          checked(cases[first + i], tools.forecast, *tools.intent, tools.draws, tools.made_with);
    });
    for (std::size_t i = 0; i < results.size(); ++i) {
      const auto trust = keep_checked(bank.store, cases[first + i], results[i]);
      if (!trust.has_value()) {
        return trust.error();
      }
      count_trust(counts, trust.value());
    }
    progress.show(static_cast<int>(first + results.size()), 0, " cases");
  }
  return counts;
}

nlohmann::json json_of(const BankCheck& check, const std::string& car) {
  return {{"schema", "saca.memory_check/1"}, {"file", check.bank}, {"car", car},
          {"confirmed", check.confirmed},    {"open", check.open}, {"refuted", check.refuted}};
}

std::string text_of(const BankCheck& check) {
  return fmt::format(
      "{}: {} cases confirmed and trusted, {} stay as they were, {} refuted and quarantined\n",
      check.bank, check.confirmed, check.open, check.refuted);
}

}  // namespace saca::banks
