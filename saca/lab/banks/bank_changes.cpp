#include "saca/lab/banks/bank_changes.h"

#include <fmt/core.h>

#include <set>

#include "saca/thinking/memory/scene_json.h"
#include "saca/thinking/memory/thinning.h"

namespace saca::banks {
namespace {

/// The same scene of the same source: it is the same case, whatever else is said of it.
std::string name_of_case(const memory::Case& one) {
  return one.source + '\n' + memory::to_json(one.scene).dump();
}

/// Leaves out what the bank has already, and what comes twice.
/// @return  how many
std::size_t leave_out_known(std::vector<memory::Case>& cases,
                            const std::vector<memory::Case>& known) {
  std::set<std::string> keys;
  for (const memory::Case& one : known) {
    keys.insert(name_of_case(one));
  }
  return std::erase_if(
      cases, [&](const memory::Case& one) { return !keys.insert(name_of_case(one)).second; });
}

}  // namespace

memory::Case expert_case(const world::Scene& scene, const ExpertWord& word) {
  memory::Case one{.scene = scene,
                   .best = word.policy,
                   .review = word.why,
                   .source = word.source,
                   .origin = memory::Origin::expert,
                   .trust = memory::Trust::unchecked};
  one.plan = manoeuvre::default_plan(word.policy, scene.ego.v_B.x);
  return one;
}

std::string text_of(const memory::LearningResult& learnt, const std::string& bank) {
  using How = memory::LearningResult::How;
  return fmt::format("{}: case {}{}; it is used where a rollout confirms it\n", bank, learnt.id,
                     learnt.how == How::merged ? " stands for it already"
                     : learnt.how == How::contradicted
                         ? fmt::format(", which contradicts case {}", learnt.other)
                         : "");
}

Result<CaseImport> import_cases(memory::Store& bank, std::vector<memory::Case> cases,
                                ImportedTrust trust) {
  for (memory::Case& one : cases) {
    if (trust == ImportedTrust::withdrawn && one.trust == memory::Trust::trusted) {
      one.trust = memory::Trust::unchecked;
    }
  }
  const auto known = bank.all();
  if (!known.has_value()) {
    return known.error();
  }
  const std::size_t left_out = leave_out_known(cases, known.value());
  const auto ids = bank.add_all(cases);
  if (!ids.has_value()) {
    return ids.error();
  }
  return CaseImport{bank.name(), cases.size(), left_out, trust};
}

std::string text_of(const CaseImport& import) {
  return fmt::format(
      "{}: {} cases taken over{}{}\n", import.bank, import.taken,
      import.left_out > 0 ? fmt::format(", {} were there already", import.left_out) : "",
      import.taken == 0 || import.trust == ImportedTrust::kept
          ? ""
          : ": each is used only where a rollout confirms it");
}

Result<Thinning> thin(ReadBank& bank, std::size_t most) {
  const std::vector<match::CaseId> ids = memory::most_redundant(bank.cases, most);
  if (const auto problem = bank.store.forget(ids)) {
    return *problem;
  }
  return Thinning{bank.store.name(), ids.size(), bank.cases.size() - ids.size(), most};
}

std::string text_of(const Thinning& thinning) {
  return fmt::format("{}: {} cases forgotten, {} left{}\n", thinning.bank, thinning.forgotten,
                     thinning.left,
                     thinning.left > thinning.most ? ": nothing else is stood for by another" : "");
}

}  // namespace saca::banks
