#include "saca/thinking/intent/intention.h"

#include <algorithm>

#include "saca/base/core/names.h"

namespace saca::intent {
namespace {

constexpr std::array<std::string_view, num_intentions> names{"M",  "LC", "RC",   "FB",
                                                             "LB", "RB", "stop", "cross"};

}  // namespace

bool is_vru(world::ActorKind kind) {
  return kind == world::ActorKind::pedestrian || kind == world::ActorKind::bicycle;
}

std::span<const Intention> intentions_of(world::ActorKind kind) {
  if (is_vru(kind)) {
    return vru_intentions;
  }
  const std::span<const Intention> all = vehicle_intentions;
  return kind == world::ActorKind::obstacle ? all.first(1) : all;
}

bool is_braking(Intention intention) {
  return intention == Intention::brake || intention == Intention::brake_left ||
         intention == Intention::brake_right || intention == Intention::stop;
}

std::string_view name(Intention intention) {
  return name_of(intention, names);
}

Intention likeliest(const IntentPosterior& posterior) {
  return static_cast<Intention>(std::max_element(posterior.begin(), posterior.end()) -
                                posterior.begin());
}

}  // namespace saca::intent
