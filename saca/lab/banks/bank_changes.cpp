#include "saca/lab/banks/bank_changes.h"

#include <fmt/core.h>

#include "saca/thinking/memory/scene_json.h"
#include "saca/thinking/memory/thinning.h"

namespace saca::banks {

std::string name_of_case(const memory::Case& one) {
  return one.source + '\n' + memory::to_json(one.scene).dump();
}

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
  const auto ids = bank.add_new(cases, name_of_case);
  if (!ids.has_value()) {
    return ids.error();
  }
  const std::size_t taken = ids.value().size();
  return CaseImport{bank.name(), taken, cases.size() - taken, trust};
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
  const std::vector<memory::Case> gone =
      memory::cases_of(memory::most_redundant(bank.cases, most), bank.cases);
  const auto changed = bank.store.forget(gone);
  if (!changed.has_value()) {
    return changed.error();
  }
  const std::size_t forgotten = gone.size() - changed.value();
  return Thinning{.bank = bank.store.name(),
                  .forgotten = forgotten,
                  .left = bank.cases.size() - forgotten,
                  .most = most,
                  .changed = changed.value()};
}

std::string text_of(const Thinning& thinning) {
  const bool all_tried = thinning.left > thinning.most + thinning.changed;
  return fmt::format(
      "{}: {} cases forgotten, {} left{}{}\n", thinning.bank, thinning.forgotten, thinning.left,
      thinning.changed > 0
          ? fmt::format(", {} of them since somebody learnt of them meanwhile", thinning.changed)
          : "",
      all_tried ? ": nothing else is stood for by another" : "");
}

}  // namespace saca::banks
