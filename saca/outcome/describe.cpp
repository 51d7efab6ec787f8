#include "saca/outcome/describe.h"

#include <fmt/core.h>

namespace saca::outcome {
namespace {

// What is met with which face, e.g. "car1 with its front at 4.2 m/s".
std::string meeting(const Contact& contact, std::span<const world::Actor> actors,
                    std::string_view edge) {
  return fmt::format("{} with its {} at {:.1f} m/s",
                     contact.actor ? actor_name(actors[*contact.actor]) : std::string(edge),
                     name(contact.ego_face), contact.relative_speed);
}

}  // namespace

std::string describe(const Outcome& outcome, std::span<const world::Actor> actors) {
  if (!outcome.contact) {
    return fmt::format("clear by {:.1f} m", outcome.clearance);
  }
  std::string text = outcome.contact->actor ? "hits " : "leaves ";
  text += meeting(*outcome.contact, actors, "the road");
  for (const Contact& contact : outcome.later) {
    text += ", then " + meeting(contact, actors, "the road's edge");
  }
  return text;
}

std::string describe(const Outcome& outcome, const world::Scene& scene) {
  return describe(outcome,
                  std::span<const world::Actor>(scene.actors.begin(), scene.actors.size()));
}

}  // namespace saca::outcome
