#include "saca/lab/encounter/intentions_seen.h"

#include <algorithm>

#include "saca/base/core/contract.h"

namespace saca::encounter {

void note(const world::Scene& scene, const intent::Beliefs& beliefs,
          std::vector<IntentionsSeen>& all) {
  expects(beliefs.size() == scene.actors.size(), "one belief per actor");
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    const world::Actor& actor = scene.actors[i];
    if (actor.kind == world::ActorKind::obstacle) {
      continue;
    }
    auto found = std::find_if(all.begin(), all.end(), [&](const IntentionsSeen& one) {
      return one.kind == actor.kind && one.id == actor.id;
    });
    if (found == all.end()) {
      found =
          all.insert(all.end(), {.kind = actor.kind, .id = actor.id, .times = {}, .beliefs = {}});
    }
    found->times.push_back(scene.time);
    found->beliefs.push_back(beliefs[i]);
  }
}

}  // namespace saca::encounter
