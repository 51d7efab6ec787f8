#include "saca/lab/banks/bank_check.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "saca/base/core/clock.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/banks/bank_changes.h"
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

/// Is a case in the bank as it was read?
Result<bool> is_unchanged(memory::Store& store, const memory::Case& before) {
  const auto now = store.find(before.id);
  if (!now.has_value()) {
    return now.error();
  }
  return now.value() && memory::to_json(*now.value()) == memory::to_json(before);
}

/// What this car has found out about cases that another trusts.
class CasesOfAnother {
 public:
  /// @param checked  nullopt: nothing new
  /// @return         what the bank could not do
  [[nodiscard]] std::optional<Error> take(memory::Store& store, const memory::Case& before,
                                          const std::optional<memory::Case>& checked,
                                          BankCheck& check) {
    const auto unchanged = checked ? is_unchanged(store, before) : Result(false);
    if (!unchanged.has_value()) {
      return unchanged.error();
    }
    if (!unchanged.value()) {
      ++check.open;
    } else if (checked->trust == memory::Trust::quarantined) {
      ++check.refuted_for_this;
    } else {
      confirmed_.push_back(*checked);
      if (checked->origin == memory::Origin::own) {
        confirmed_.back().origin = memory::Origin::simulation;  // this car has not driven it
      }
    }
    return std::nullopt;
  }

  /// Puts into the bank what is confirmed, unless somebody was faster.
  /// @return  what it could not do
  [[nodiscard]] std::optional<Error> add_confirmed(memory::Store& store, BankCheck& check) const {
    if (confirmed_.empty()) {
      return std::nullopt;
    }
    const auto added = store.add_new(confirmed_, [](const memory::Case& one) {
      return memory::car_and_harm(one.made_with) + '\n' + name_of_case(one);
    });
    if (!added.has_value()) {
      return added.error();
    }
    check.added = static_cast<int>(added.value().size());
    return std::nullopt;
  }

 private:
  std::vector<memory::Case> confirmed_;
};

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
  std::set<std::string> of_this_car;
  for (const memory::Case& one : cases) {
    if (memory::same_car_and_harm(one.made_with, tools.made_with)) {
      of_this_car.insert(name_of_case(one));
    }
  }
  std::erase_if(cases, [&](const memory::Case& one) {
    if (memory::is_trusted_by_another(tools.made_with, one)) {
      return of_this_car.count(name_of_case(one)) > 0;
    }
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
  CasesOfAnother of_another;
  for (std::size_t first = 0; first < cases.size() && !long_work::interrupted();
       first += checked_at_once) {
    std::vector<std::optional<memory::Case>> results(
        std::min(checked_at_once, cases.size() - first));
    in_parallel(results.size(), options.threads, [&](std::size_t i) {
      results[i] =
          checked(cases[first + i], tools.forecast, *tools.intent, tools.draws, tools.made_with);
    });
    for (std::size_t i = 0; i < results.size(); ++i) {
      const memory::Case& before = cases[first + i];
      if (memory::is_trusted_by_another(tools.made_with, before)) {
        if (auto problem = of_another.take(bank.store, before, results[i], counts)) {
          return *std::move(problem);
        }
        continue;
      }
      const auto trust = keep_checked(bank.store, before, results[i]);
      if (!trust.has_value()) {
        return trust.error();
      }
      count_trust(counts, trust.value());
    }
    progress.show(static_cast<int>(first + results.size()), 0, " cases");
  }
  if (auto problem = of_another.add_confirmed(bank.store, counts)) {
    return *std::move(problem);
  }
  return counts;
}

nlohmann::json json_of(const BankCheck& check, const std::string& car) {
  return {{"schema", "saca.memory_check/1"},
          {"file", check.bank},
          {"car", car},
          {"confirmed", check.confirmed},
          {"open", check.open},
          {"refuted", check.refuted},
          {"added", check.added},
          {"refuted_for_this_car", check.refuted_for_this}};
}

std::string text_of(const BankCheck& check) {
  return fmt::format(
      "{}: {} cases confirmed and trusted, {} stay as they were, {} refuted and quarantined{}\n",
      check.bank, check.confirmed, check.open, check.refuted,
      check.added + check.refuted_for_this > 0
          ? fmt::format(
                "; of those that another car trusts, which stay, {} are confirmed and added "
                "for this car, {} refuted for it",
                check.added, check.refuted_for_this)
          : "");
}

}  // namespace saca::banks
