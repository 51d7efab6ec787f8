#include "saca/thinking/rollout/describe.h"

#include <fmt/core.h>

#include "saca/base/core/contract.h"

namespace saca::rollout {
namespace {

std::string called(std::size_t actor, std::span<const world::Actor> actors) {
  expects(actor < actors.size(), "the outcome counts in these actors");
  return actor_name(actors[actor]);
}

// What is met with which face, e.g. "car1 with its front at 4.2 m/s".
std::string forecast(const collision::Contact& contact, std::span<const world::Actor> actors,
                     std::string_view edge) {
  return fmt::format("{} with its {} at {:.1f} m/s",
                     contact.actor ? called(*contact.actor, actors) : std::string(edge),
                     collision::name(contact.ego_face), contact.relative_speed);
}

std::string staying_clear(const collision::Outcome& outcome, std::span<const world::Actor> actors) {
  if (!(outcome.clearance < collision::far_away)) {
    return fmt::format("clear: nobody within {:.0f} m", collision::far_away);
  }
  std::string by = fmt::format("clear by {:.1f} m", outcome.clearance);
  if (!outcome.nearest) {
    return by;
  }
  return fmt::format("{} (nearest: {} at {:.1f} s)", by, nearest_name(*outcome.nearest, actors),
                     outcome.nearest->time);
}

}  // namespace

std::string nearest_name(const collision::Nearest& nearest, std::span<const world::Actor> actors) {
  return nearest.actor                            ? called(*nearest.actor, actors)
         : *nearest.edge == collision::Side::left ? "the road's left edge"
                                                  : "the road's right edge";
}

std::string describe(const collision::Outcome& outcome, std::span<const world::Actor> actors) {
  if (!outcome.contact) {
    return staying_clear(outcome, actors);
  }
  std::string text = outcome.contact->actor ? "hits " : "leaves ";
  text += forecast(*outcome.contact, actors, "the road");
  for (const collision::Contact& contact : outcome.later) {
    text += ", then " + forecast(contact, actors, "the road's edge");
  }
  return text;
}

std::string describe(const collision::Outcome& outcome, const world::Scene& scene) {
  return describe(outcome,
                  std::span<const world::Actor>(scene.actors.begin(), scene.actors.size()));
}

}  // namespace saca::rollout
