#include "saca/lab/cases/case_stage.h"

#include "saca/base/core/fnv.h"
#include "saca/lab/eval/suite.h"

namespace saca::cases {

std::uint64_t number_of_record(const std::string& name) {
  return fnv1a(name);
}

scenario::Scenario case_world(const scenario::Scenario& drawn, std::uint64_t seed) {
  return eval::as_played(drawn, {.methods = {}, .seed = seed});
}

encounter::Stage case_stage(const scenario::Scenario& world, const CaseTools& tools,
                            std::uint64_t seed, const std::string& name) {
  return {.scenario = &world,
          .car = tools.forecast.car,
          .harm = tools.forecast.harm,
          .intent = tools.intent,
          .thresholds = {},
          .chance = eval::chance_of({.methods = {}, .seed = seed}, number_of_record(name))};
}

}  // namespace saca::cases
