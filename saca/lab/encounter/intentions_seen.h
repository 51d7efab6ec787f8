#pragma once

#include <cstdint>
#include <vector>

#include "saca/base/world/scene.h"
#include "saca/thinking/intent/observer.h"

namespace saca::encounter {

/// What one road user was thought to intend while it was perceived, every 0.1 s.
struct IntentionsSeen {
  world::ActorKind kind = world::ActorKind::car;  ///< no obstacle
  std::uint8_t id = 0;
  std::vector<double> times;  ///< of the scene [s]
  std::vector<intent::Belief> beliefs;
};

/// Adds what is believed of the scene's road users, each to its own; who is new comes last.
/// @param beliefs  one per actor
/// @throws ContractViolation  if beliefs and actors differ in number
void note(const world::Scene& scene, const intent::Beliefs& beliefs,
          std::vector<IntentionsSeen>& all);

}  // namespace saca::encounter
