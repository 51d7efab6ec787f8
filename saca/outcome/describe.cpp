#include "saca/outcome/describe.h"

#include <fmt/core.h>

namespace saca::outcome {

std::string describe(const Outcome& outcome, std::span<const world::Actor> actors) {
  if (!outcome.contact) {
    return fmt::format("clear by {:.1f} m", outcome.clearance);
  }
  const Contact& contact = *outcome.contact;
  if (!contact.actor) {
    return fmt::format("leaves the road with its {} at {:.1f} m/s", name(contact.ego_face),
                       contact.relative_speed);
  }
  return fmt::format("hits {} with its {} at {:.1f} m/s", actor_name(actors[*contact.actor]),
                     name(contact.ego_face), contact.relative_speed);
}

std::string describe(const Outcome& outcome, const world::Scene& scene) {
  return describe(outcome, std::span<const world::Actor>(scene.actors.begin(), scene.actors.size()));
}

}  // namespace saca::outcome
