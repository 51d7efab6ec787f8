#include "saca/lab/encounter/outcome_json.h"

#include <cmath>

#include "saca/base/core/units.h"
#include "saca/thinking/rollout/describe.h"

namespace saca::encounter {

using nlohmann::json;

json contact_json(const collision::Contact& contact, std::span<const world::Actor> actors) {
  return {{"time_s", contact.time},
          {"with", contact.actor ? actor_name(actors[*contact.actor]) : "edge"},
          {"ego_face", name(contact.ego_face)},
          {"other_face", contact.actor ? json(name(contact.other_face)) : json(nullptr)},
          {"relative_speed_mps", contact.relative_speed},
          {"x_m", contact.p_W.x},
          {"y_m", contact.p_W.y},
          {"normal_deg", to_degrees(std::atan2(contact.n_W.y, contact.n_W.x))},
          {"v_rel_x_mps", contact.v_rel_W.x},
          {"v_rel_y_mps", contact.v_rel_W.y},
          {"ego_delta_v_mps", contact.ego_delta_v},
          {"other_delta_v_mps", contact.other_delta_v}};
}

json first_contact_json(const collision::Outcome& outcome, std::span<const world::Actor> actors) {
  return outcome.contact ? contact_json(*outcome.contact, actors) : json(nullptr);
}

json nearest_json(const collision::Outcome& outcome, std::span<const world::Actor> actors) {
  if (!outcome.nearest) {
    return nullptr;
  }
  return {{"to", rollout::nearest_name(*outcome.nearest, actors)},
          {"time_s", outcome.nearest->time}};
}

json outcome_json(const collision::Outcome& outcome, std::span<const world::Actor> actors) {
  return {{"contact", first_contact_json(outcome, actors)},
          {"collision_loss", outcome.collision_loss},
          {"harm", outcome.harm},
          {"clearance_m", outcome.clearance},
          {"nearest", nearest_json(outcome, actors)},
          {"text", rollout::describe(outcome, actors)}};
}

}  // namespace saca::encounter
