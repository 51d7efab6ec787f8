#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include "saca/sim/family.h"
#include "saca/sim/family_stage.h"

namespace saca::sim {

/// One cue, or in three of ten encounters two, of the family's kinds; what each stands for comes
/// with the probability of the law. It is drawn once for an encounter, however often its places
/// have to be drawn: so it comes as often as the law says.
[[nodiscard]] std::vector<DrawnCue> draw_cues(const FamilyCues& cues, std::mt19937_64& rng);

/// Puts cues into an encounter, and what comes of them.
///
/// A cue lies beside our outermost lane, 8 m before to 12 m behind the place of the conflict, in
/// seven of ten cases to the right; what hides people there (vans, a bus, a hoarding, a car) stands
/// there with or without somebody behind it. Who comes does so when an ego that just goes on would
/// be there: he is then anywhere between the middle of our lane and the edge of the road on his
/// side. Whom nothing hides (glare; a siren from a side street) is in the scenario from 1.5 s
/// before that on. Where it is slippery the ego believes that the grip is what it had been.
/// All numbers here are assumptions. Call it after the conflict was made, before the surroundings.
/// @return  who came, by index into Scenario::actors
[[nodiscard]] std::vector<std::size_t> add_cues(Stage& stage, const std::vector<DrawnCue>& cues,
                                                const intent::CueLaw& law);

/// Takes away who came, and gives the grip back.
void take_away(Scenario& scenario, const std::vector<std::size_t>& came);

}  // namespace saca::sim
