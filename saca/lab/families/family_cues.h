#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include "saca/lab/families/family.h"
#include "saca/lab/families/family_stage.h"

namespace saca::families {

/// One cue, or in three of ten encounters two, of the family's kinds; what each stands for comes
/// with the probability of the law. It is drawn once for an encounter, however often its places
/// have to be drawn: so it comes as often as the law says.
[[nodiscard]] std::vector<DrawnCue> draw_cues(const FamilyCues& cues, std::mt19937_64& rng);

/// Somebody whom a cue stands for.
struct Comer {
  std::size_t actor = 0;  ///< index into Scenario::actors
  bool comes = false;     ///< else he is to be taken away again
};

/// Puts cues into an encounter, and what may come of them.
///
/// A cue lies beside our outermost lane, 8 m before to 12 m behind the place of the conflict, in
/// seven of ten cases to the right; what hides people there (vans, a bus, a hoarding, a car) stands
/// there with or without somebody behind it. Who comes crosses at 0.8 to 1.2 times the speed of the
/// law, and is anywhere between the middle of our lane and the edge of that outermost one when an
/// ego that just goes on is there. Whom nothing hides (glare; a siren from a side street) is in the
/// scenario from 1.5 s before that on. Where it is slippery the whole road is, the ego believes
/// that the grip is what it had been, and nobody brakes harder than the road allows. All numbers
/// here are assumptions.
///
/// Whoever may come is put in, so that places are as likely where he comes as where he does not;
/// see take_absent_away. Call it after the conflict was made, before the surroundings.
[[nodiscard]] std::vector<Comer> add_cues(Stage& stage, const std::vector<DrawnCue>& cues,
                                          const intent::CueLaw& law);

/// Takes away who may come, and does not.
void take_absent_away(scenario::Scenario& scenario, const std::vector<Comer>& all);
/// Takes away who may come, all of them.
void take_all_away(scenario::Scenario& scenario, const std::vector<Comer>& all);

/// Gives the grip back where it is slippery and nobody knows.
void take_leaves_away(scenario::Scenario& scenario);

}  // namespace saca::families
