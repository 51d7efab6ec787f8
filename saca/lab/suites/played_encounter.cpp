#include "saca/lab/suites/played_encounter.h"

#include "saca/base/core/contract.h"

namespace saca::suites {

encounter::Stage PlayedEncounter::stage(const Perceiver& perceiver) const {
  return {.scenario = &world,
          .car = perceiver.car,
          .harm = perceiver.harm,
          .intent = perceiver.intent,
          .thresholds = {},
          .chance = chance};
}

encounter::Stage PlayedEncounter::twin_stage(const Perceiver& perceiver) const {
  expects(twin.has_value(), "there is a twin");
  encounter::Stage as_twin = stage(perceiver);
  as_twin.scenario = &twin.value();
  return as_twin;
}

Result<PlayedEncounter> played_encounter(const EncounterAt& at, const PlayOptions& options,
                                         std::uint64_t number) {
  const eval::SuiteOptions played{.methods = {}, .seed = options.seed, .exact = options.exact};
  const auto found = at(number);
  if (!found.has_value()) {
    return found.error();
  }
  const eval::SuiteEncounter& encounter = found.value();
  return PlayedEncounter{.family = encounter.family,
                         .world = eval::as_played(encounter.scenario, played),
                         .chance = eval::chance_of(played, number),
                         .twin = encounter.twin
                                     ? std::optional(eval::as_played(*encounter.twin, played))
                                     : std::nullopt};
}

}  // namespace saca::suites
