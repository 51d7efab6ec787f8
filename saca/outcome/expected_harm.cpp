#include "saca/outcome/expected_harm.h"

#include <array>

namespace saca::outcome {
namespace {

// Each of the people of one body.
struct Victims {
  Injury injury;
  bool met = false;
};

}  // namespace

double expected_harm(std::span<const Impact> impacts, const world::Scene& scene,
                     const HarmModel& harm) {
  Victims ego;
  std::array<Victims, world::max_actors> others;
  double chance = 1.0;    // that the chain comes so far
  double expected = 0.0;  // each step adds what it makes worse
  const auto hurt = [&](Victims& victims, double people, const Injury& injury) {
    const Injury both = combined(victims.injury, injury);
    expected += chance * people * (weighted(harm, both) - weighted(harm, victims.injury));
    victims.injury = both;
  };
  for (const Impact& impact : impacts) {
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

}  // namespace saca::outcome
