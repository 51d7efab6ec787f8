#include "saca/onboard/forecast/chain_harm.h"

#include <array>

namespace saca::forecast {
namespace {

// Each of the people of one body.
struct Victims {
  collision::Injury injury;
  bool met = false;
};

}  // namespace

double expected_harm(std::span<const collision::Impact> impacts, const world::Scene& scene,
                     const collision::HarmModel& harm) {
  Victims ego;
  std::array<Victims, world::max_actors> others;
  double chance = 1.0;    // that the chain comes so far
  double expected = 0.0;  // each step adds what it makes worse
  const auto hurt = [&](Victims& victims, double people, const collision::Injury& injury) {
    const collision::Injury both = collision::combined(victims.injury, injury);
    expected += chance * people *
                (collision::weighted(harm, both) - collision::weighted(harm, victims.injury));
    victims.injury = both;
  };
  for (const collision::Impact& impact : impacts) {
    if (impact.contact.actor) {
      const world::Actor& actor = scene.actors[*impact.contact.actor];
      Victims& other = others[*impact.contact.actor];
      chance *= other.met ? 1.0 : actor.existence;
      other.met = true;
      hurt(other, harm.people[static_cast<std::size_t>(actor.kind)], impact.other);
    }
    hurt(ego, harm.ego_people, impact.ego);
  }
  return expected;
}

}  // namespace saca::forecast
