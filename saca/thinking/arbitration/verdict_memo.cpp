#include "saca/thinking/arbitration/verdict_memo.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "saca/base/core/contract.h"

namespace saca::arbitration {
namespace {

/// One verdict, and what it was worked out from.
struct Entry {
  world::Scene scene;
  intent::Beliefs beliefs;
  std::optional<reflex::UnderWay> under_way;
  reflex::Verdict verdict;
};

}  // namespace

Judge memoised(Judge judge) {
  expects(static_cast<bool>(judge), "there is a judge");
  return [judge = std::move(judge), known = std::make_shared<std::vector<Entry>>()](
             const world::Scene& scene, const intent::Beliefs& beliefs,
             const std::optional<reflex::UnderWay>& under_way) {
    const auto found = std::find_if(known->begin(), known->end(), [&](const Entry& one) {
      return one.scene == scene && one.beliefs == beliefs && one.under_way == under_way;
    });
    if (found == known->end()) {
      known->push_back({scene, beliefs, under_way, judge(scene, beliefs, under_way)});
      return known->back().verdict;
    }
    return found->verdict;
  };
}

}  // namespace saca::arbitration
