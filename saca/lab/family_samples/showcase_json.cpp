#include "saca/lab/family_samples/showcase_json.h"

#include "saca/lab/eval/oracle.h"

namespace saca::family_samples {

nlohmann::json json_of(const ShowcaseScene& one, manoeuvre::PolicyId policy) {
  const eval::Margin margin = margin_of_best(one.oracle);
  return {{"policy", manoeuvre::index(policy)},
          {"scenario", one.scenario.name},
          {"margin", margin.mean},
          {"margin_low", margin.low},
          {"why", one.scenario.why}};
}

}  // namespace saca::family_samples
